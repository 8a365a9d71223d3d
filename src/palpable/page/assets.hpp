// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace palpable::page {

/// One file of the built page, kept in the program.
struct Asset {
  std::string_view path;
  std::string_view media_type;
  std::string_view bytes;
};

/// The file at `path` ("/index.html"; "/" is that one too), or null. The files are made by Vite at build
/// time.
const Asset* find_asset(std::string_view path);

}  // namespace palpable::page
