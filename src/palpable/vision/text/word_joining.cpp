// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/ink_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpable::vision {
namespace {

MapPoint line_end(const TextLine& line, bool last) { return last ? line.centre.back() : line.centre.front(); }

/// The direction out of a line at one of its ends.
cv::Point2d direction_at(const TextLine& line, bool last, const TextLineOptions& options) {
  const std::size_t back =
      std::min(line.centre.size() - 1, static_cast<std::size_t>(options.word_end_heights * line.height_px));
  const MapPoint inner = line.centre[last ? line.centre.size() - 1 - back : back];
  const MapPoint end = line_end(line, last);
  const cv::Point2d d(end.x - inner.x, end.y - inner.y);
  return d * (1.0 / std::max(1e-9, cv::norm(d)));
}

bool has_colour_of(const TextLine& a, const TextLine& b, const TextLineOptions& options) {
  return cv::norm(cv::Vec3d(a.colour.r - b.colour.r, a.colour.g - b.colour.g, a.colour.b - b.colour.b)) <=
         options.most_colour_difference;
}

/// Whether a word is too short, against the line `a`, to have a direction of its own.
bool is_short_word(const InkLine& word, const TextLine& a, const TextLineOptions& options) {
  return std::max(word.box.width, word.box.height) <= options.short_word_heights * a.height_px &&
         static_cast<double>(a.centre.size()) > options.short_word_heights * a.height_px;
}

/// The gap between an end of a line and a short word that belongs to it; negative if it does not.
double short_word_gap(const TextLine& a, bool a_last, const InkLine& word, const TextLineOptions& options) {
  const cv::Point2d along = direction_at(a, a_last, options),
                    from(line_end(a, a_last).x, line_end(a, a_last).y);
  const cv::Point2d middle = 0.5 * cv::Point2d(word.box.tl() + word.box.br());
  if (cv::norm(middle - from) > (options.largest_word_gap + options.short_word_heights) * a.height_px)
    return -1.0;
  double first = 1e9, left = 1e9, right = -1e9;
  for (const cv::Point p : word.pixels) {
    const cv::Point2d to = cv::Point2d(p) - from;
    first = std::min(first, to.dot(along));
    left = std::min(left, along.cross(to));
    right = std::max(right, along.cross(to));
  }
  const double most = (0.5 + options.short_word_beyond) * a.height_px;
  const bool is_in_line =
      left >= -most && right <= most && right - left + 1.0 >= options.short_word_part * a.height_px;
  const bool follows =
      first > -options.word_overlap * a.height_px && first <= options.largest_word_gap * a.height_px;
  return is_in_line && follows && has_colour_of(a, word.line, options) ? std::max(0.0, first) : -1.0;
}

/// The gap between two ends of lines that are words of one name; negative if they are not. The longer word
/// decides the direction, in which the shorter one must lie.
double word_gap(const InkLine& longer, bool a_last, const InkLine& shorter, bool b_last,
                const TextLineOptions& options) {
  const TextLine &a = longer.line, &b = shorter.line;
  if (a.centre.size() < b.centre.size()) return word_gap(shorter, b_last, longer, a_last, options);
  if (is_short_word(shorter, a, options)) return short_word_gap(a, a_last, shorter, options);
  const double height = std::max(a.height_px, b.height_px);
  const MapPoint from = line_end(a, a_last);
  const cv::Point2d gap(line_end(b, b_last).x - from.x, line_end(b, b_last).y - from.y);
  const cv::Point2d far(line_end(b, !b_last).x - from.x, line_end(b, !b_last).y - from.y);
  const double length = cv::norm(gap);
  const bool alike =
      height < options.word_height_ratio * std::min(a.height_px, b.height_px) && has_colour_of(a, b, options);
  if (!alike || length > options.largest_word_gap * height) return -1.0;
  const cv::Point2d along = direction_at(a, a_last, options);
  const double least = std::cos(options.most_turn_deg * std::numbers::pi / 180.0);
  const bool follows = along.dot(far) >= least * cv::norm(far) && along.dot(far) > along.dot(gap) &&
                       along.dot(gap) > -options.word_overlap * height;
  return follows && std::abs(along.cross(gap)) < options.word_aside * height ? length : -1.0;
}

}  // namespace

void join_words(std::vector<InkLine>& lines, const TextLineOptions& options) {
  for (;;) {
    double least = 1e9;
    std::array<std::size_t, 2> best{};
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = i + 1; j < lines.size(); ++j)
        for (const bool i_last : {false, true})
          for (const bool j_last : {false, true})
            if (const double gap = word_gap(lines[i], i_last, lines[j], j_last, options);
                gap >= 0.0 && gap < least) {
              least = gap;
              best = {i, j};
            }
    if (least >= 1e9) return;
    InkLine& a = lines[best[0]];
    const InkLine& b = lines[best[1]];
    a.pixels.insert(a.pixels.end(), b.pixels.begin(), b.pixels.end());
    a.line.letters += b.line.letters;
    fit_line(a, options);
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(best[1]));
  }
}

}  // namespace palpable::vision
