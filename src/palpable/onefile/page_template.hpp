// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace palpable::onefile {

/// The one-file page without a scene, made at build time by web/scripts/one_file.mjs; empty if there was no
/// emscripten then.
std::string_view page_template();

/// The words in it that a scene's values replace.
inline constexpr std::string_view kTitleMark = "%PALPABLE_TITLE%";
inline constexpr std::string_view kSceneMark = "%PALPABLE_SCENE%";
inline constexpr std::string_view kPictureMark = "%PALPABLE_PICTURE%";
inline constexpr std::string_view kSecondMark = "%PALPABLE_SECOND%";

}  // namespace palpable::onefile
