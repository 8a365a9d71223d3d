// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

namespace palpable::vision {

std::vector<Parameter> parameters_of(TextLineOptions& o) {
  return {
      {"contrast", &o.contrast, {1, 255}, "levels", "least contrast of lettering"},
      {"separation", &o.separation, {0, 1}, "", "least part of the strongest contrast nearby"},
      {"separation_margin_px", &o.separation_margin_px, {0, 50}, "px", "how far beyond a stroke that is"},
      {"most_colour_difference", &o.most_colour_difference, {0, 442}, "levels", "between letters of a line"},
      {"smallest_letter_px", &o.smallest_letter_px, {1, 100}, "px", "least size of a letter"},
      {"largest_letter_px", &o.largest_letter_px, {2, 1000}, "px", "greatest size of a letter"},
      {"thickest_stroke_px", &o.thickest_stroke_px, {1, 99}, "px", "strokes are thinner"},
      {"thin_line_length_px", &o.thin_line_length_px, {1, 1000}, "px", "longer thin ink is a border"},
      {"thin_line_px", &o.thin_line_px, {0, 20}, "px", "mean thickness of thin ink"},
      {"largest_gap", &o.largest_gap, {0.1, 10}, "letters", "largest gap between letters"},
      {"gap_size_part",
       &o.gap_size_part,
       {0, 1},
       "",
       "least size of the smaller letter in that, of the larger"},
      {"most_distance", &o.most_distance, {0.5, 10}, "letters", "distance of neighbouring letters' middles"},
      {"most_size_ratio", &o.most_size_ratio, {1, 20}, "", "sizes of neighbouring letters"},
      {"mark_size", &o.mark_size, {0, 1}, "letters", "size of dots and accents"},
      {"mark_distance", &o.mark_distance, {0, 5}, "letters", "their distance from their letter's middle"},
      {"most_turn_deg", &o.most_turn_deg, {0, 90}, "degrees", "turn between letters of a line"},
      {"height_outliers",
       &o.height_outliers,
       {0, 0.2},
       "",
       "share of ink on each side left out of the height"},
      {"bending_length", &o.bending_length, {0, 100}, "heights", "longer lines may bend both ways"},
      {"largest_word_gap", &o.largest_word_gap, {0, 10}, "heights", "largest gap between words"},
      {"word_height_ratio", &o.word_height_ratio, {1, 10}, "", "heights of words of a line"},
      {"word_end_heights",
       &o.word_end_heights,
       {0.1, 10},
       "heights",
       "length of a word's end, for its direction"},
      {"word_aside", &o.word_aside, {0, 5}, "heights", "how far the next word is from that direction"},
      {"word_overlap", &o.word_overlap, {0, 5}, "heights", "how far words may overlap"},
      {"short_word_heights",
       &o.short_word_heights,
       {0, 5},
       "heights",
       "words without a direction of their own"},
      {"short_word_part", &o.short_word_part, {0, 1}, "heights", "least height of these"},
      {"short_word_beyond", &o.short_word_beyond, {0, 1}, "heights", "how far they reach beyond the line"},
      {"lone_letter", &o.lone_letter, {0, 10}, "", "least single piece of ink, in smallest letters"},
      {"least_word_height", &o.least_word_height, {0, 10}, "", "least height of a word, in smallest letters"},
      {"fewest_letters", &o.fewest_letters, {1, 100}, "", "fewest pieces of ink of a line"},
      {"least_length", &o.least_length, {0, 100}, "heights", "least length of a line"}};
}

std::vector<Parameter> parameters_of(ReadTextOptions& o) {
  return {
      {"thickest_stroke_px", &o.thickest_stroke_px, {1, 99}, "px", "strokes are thinner"},
      {"contrast_window_px", &o.contrast_window_px, {1, 99}, "px", "window of the darkest stroke"},
      {"full_contrast", &o.full_contrast, {1, 255}, "levels", "strokes of less contrast are not black"},
      {"ground_difference", &o.ground_difference, {1, 255}, "levels", "of the ground from a line's colour"},
      {"ground_tolerance", &o.ground_tolerance, {1, 128}, "levels", "of a pixel from its area's colour"},
      {"letter_px", &o.letter_px, {12, 200}, "px", "height of the enlarged letters"},
      {"least_height_px", &o.least_height_px, {1, 100}, "px", "lower lines are enlarged as this height"},
      {"margin", &o.margin, {0, 2}, "heights", "space around the letters"},
      {"border_px", &o.border_px, {0, 100}, "px", "white around that"},
      {"smoothing", &o.smoothing, {0, 0.5}, "heights", "blur of the enlarged letters"},
      {"ink_part", &o.ink_part, {0, 1}, "", "part of a line's pixels that is black"},
      {"ground_part", &o.ground_part, {0, 1}, "", "part that is not white"},
      {"sharpening", &o.sharpening, {0, 5}, "", "of the edges in the second picture"},
      {"sharpening_radius", &o.sharpening_radius, {0.01, 1}, "heights", "its reach"},
      {"stretch", &o.stretch, {1, 3}, "", "of the third picture, along the line"},
      {"agreeing_part", &o.agreeing_part, {0, 1}, "", "of the readings; lines with less are read again"},
      {"most_colour_difference", &o.most_colour_difference, {1, 442}, "levels", "of a line's ink, then"},
      {"fewest_letters", &o.fewest_letters, {1, 20}, "", "fewest letters in what is read"},
      {"letter_part", &o.letter_part, {0, 1}, "", "least part of it that is letters"},
      {"least_confidence", &o.least_confidence, {0, 1}, "", "lines read with less are dropped"},
      {"sure", &o.sure, {0, 1}, "", "lines read with less are also read upside down"},
      {"level_deg", &o.level_deg, {0, 90}, "degrees", "slope of lines that are not"},
      {"most_seconds", &o.most_seconds, {1, 3600}, "s", "most processor time of a reader"}};
}

}  // namespace palpable::vision
