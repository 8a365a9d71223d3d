// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace palpable::page {

/// One file of the built page, embedded in the program.
struct Asset {
  std::string_view path;
  std::string_view media_type;
  std::string_view bytes;
};

/// The file at `path` ("/" means "/index.html"), or null. Vite makes the files at build time.
const Asset* find_asset(std::string_view path);

}  // namespace palpable::page
