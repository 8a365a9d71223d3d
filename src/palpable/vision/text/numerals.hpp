// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <opencv2/core.hpp>

namespace palpable::vision {

/// What was read, with the numbers of rulers in its last word that are read as letters: after a name (a word
/// with a capital), "Il" and "Ill" are "II" and "III", "ler" is "1er". UTF-8; blanks between words.
std::string with_numerals(std::string_view words);

/// "I", "II" or "III" for a word that may be made of upright strokes ("If", "HI", "11") and whose picture
/// (grey levels, dark on white) shows one to three of them, alone from top to bottom; else the word itself.
std::string numeral_or(const std::string& word, const cv::Mat& picture);

}  // namespace palpable::vision
