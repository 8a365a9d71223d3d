// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/text/read_text.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

// Inside vision's sources only: the program `tesseract`.
namespace palpable::vision {

/// What a picture of one line says to one language. `text` is empty if it says nothing.
struct Reading {
  std::string text;
  double confidence = 0.0;
};

struct Reader {
  std::filesystem::path program;
  /// At least one.
  std::vector<std::string> languages;
};

/// The program and the wanted languages ("eng+deu"), or all that are installed if it is empty; nullopt if
/// there is none.
std::optional<Reader> installed_reader(const std::string& languages);

/// Reads pictures of one line each (grey levels, dark on white) in several processes, with each language by
/// itself: languages err differently. One Reading for each language and picture. Errors: interrupted; failed.
Result<std::vector<std::vector<Reading>>> read_pictures(std::span<const cv::Mat> pictures,
                                                        const Reader& reader, const ReadTextOptions& options,
                                                        const Work& work);

}  // namespace palpable::vision
