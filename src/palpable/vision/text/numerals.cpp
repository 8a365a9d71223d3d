// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/numerals.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace palpable::vision {
namespace {

/// Whether a word has two or three upright strokes and nothing else.
bool has_strokes_only(std::string_view word) {
  constexpr std::string_view kStrokes = "Ili1|";
  return (word.size() == 2 || word.size() == 3) &&
         std::all_of(word.begin(), word.end(), [&](char c) { return kStrokes.find(c) != kStrokes.npos; }) &&
         word.find_first_of("Ili") != word.npos;
}

/// Number of dark strokes that a row of a picture crosses.
int strokes_in_row(const cv::Mat& picture, int y, double most_dark) {
  int strokes = 0;
  bool was_dark = false;
  for (int x = 0; x < picture.cols; ++x) {
    const bool is_dark = picture.at<std::uint8_t>(y, x) <= most_dark;
    strokes += is_dark && !was_dark ? 1 : 0;
    was_dark = is_dark;
  }
  return strokes;
}

}  // namespace

std::string numeral_or(const std::string& word, const cv::Mat& picture) {
  constexpr std::string_view kAlike = "IlLiHhfFtTUuNn1!|[]";
  constexpr std::size_t kMostLetters = 3;
  constexpr int kLeastHeight_px = 8, kMostStrokes = 3;
  const bool may_be =
      word.size() <= kMostLetters && word.find_first_of("IlH1|f") != word.npos &&
      std::all_of(word.begin(), word.end(), [&](char c) { return kAlike.find(c) != kAlike.npos; });
  if (!may_be || picture.rows < kLeastHeight_px) return word;
  double darkest = 0.0, lightest = 0.0;
  cv::minMaxLoc(picture, &darkest, &lightest);
  // The same strokes at every height, but for the ends of the letters.
  int strokes = 0;
  for (const double part : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    const int here =
        strokes_in_row(picture, static_cast<int>(part * picture.rows), 0.5 * (darkest + lightest));
    if (strokes != 0 && here != strokes) return word;
    strokes = here;
  }
  return strokes >= 1 && strokes <= kMostStrokes ? std::string(static_cast<std::size_t>(strokes), 'I') : word;
}

std::string with_numerals(std::string_view words) {
  const std::size_t blank = words.rfind(' ');
  if (blank == words.npos || blank == 0) return std::string(words);
  const std::size_t before = words.substr(0, blank).rfind(' ');
  const auto first = static_cast<unsigned char>(words[before == words.npos ? 0 : before + 1]);
  const std::string_view last = words.substr(blank + 1);
  const std::string start(words.substr(0, blank + 1));
  if (std::isupper(first) != 0 && has_strokes_only(last)) return start + std::string(last.size(), 'I');
  if (std::isupper(first) != 0 && (last == "ler" || last == "Ler" || last == "Ier")) return start + "1er";
  return std::string(words);
}

}  // namespace palpable::vision
