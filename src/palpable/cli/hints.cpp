// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/hints.hpp"

#include "palpable/core/text/passwords.hpp"

namespace palpable::cli {

std::string_view hint_for(Reason reason) {
  switch (reason) {
    case Reason::unspecified:
      return "";
    case Reason::needs_calibration:
      return "--calibration FILE";
    case Reason::needs_camera_movement:
      return "--moved MM";
    case Reason::depth_scale_assumed:
      return "--depth-scale METRES";
    case Reason::depth_meaning_assumed:
      return "--depth-as MEANING";
    case Reason::depth_numbers_assumed:
      return "--depth-scale METRES, --depth-as MEANING";
    case Reason::needs_clip_planes:
      return "--near-plane, --far-plane";
    case Reason::needs_plane_marks:
      return "--corners or --lines";
    case Reason::unexpected_input_kind:
      return "where it was recognised wrongly, --kind KIND, as --kind depth";
    case Reason::photo_depth_used:
      return "--kind picture for its contours";
    case Reason::needs_field:
      return "--as field; --dense and --paper are ways to store one";
    case Reason::no_ground_found:
      return "--ground has no effect";
    case Reason::no_regions_in_input:
      return "--ground and --background have no effect";
    case Reason::labels_without_pixels:
      return "--labels";
    case Reason::port_in_use:
      return "another --port, or none for any free one";
    case Reason::rate_not_kept:
      return "--rate, or palpable doctor for the reason";
    case Reason::device_silent:
      return "palpable doctor";
    case Reason::map_too_dense:
      return "--width of an extract, --size";
    case Reason::map_part_chosen:
      return "--center and --width";
  }
  return "";
}

std::string sentence_of(const Error& error) {
  const std::string_view hint = hint_for(error.reason);
  // An address that is not understood is still shown as the place.
  const std::string sentence = without_passwords(error.sentence());
  return hint.empty() ? sentence : sentence + " (" + std::string(hint) + ")";
}

std::string sentence_of(const Note& note) {
  const std::string_view hint = hint_for(note.reason);
  if (hint.empty()) return note.sentence;
  std::string sentence = note.sentence;
  const bool ended = sentence.ends_with('.');
  if (ended) sentence.pop_back();
  return sentence + " (" + std::string(hint) + ")" + (ended ? "." : "");
}

std::vector<std::string> sentences_of(const std::vector<Note>& notes) {
  std::vector<std::string> sentences;
  sentences.reserve(notes.size());
  for (const Note& note : notes) sentences.push_back(sentence_of(note));
  return sentences;
}

}  // namespace palpable::cli
