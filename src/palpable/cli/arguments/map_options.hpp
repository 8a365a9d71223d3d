// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/options.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/map/extract_window.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// The options of street maps as typed.
struct MapArguments {
  /// LATITUDE,LONGITUDE; empty: not given.
  std::string center;
  std::optional<double> window_m;
  /// Names of layers with commas between them; empty: not given.
  std::string layers;
  /// Path of a file of names; empty: none.
  std::string gazetteer;
};
void add_map_options(Options& options, MapArguments& arguments);

/// The part of an extract that is asked for. Errors: usage for a centre that is no place, and for an unknown
/// layer.
Result<sources::ExtractWindow> window_of(const MapArguments& arguments);

/// The names in a file (vision/streets/names/gazetteer.hpp). Errors: as read_text_file(); invalid_input as
/// parse_gazetteer().
Result<std::vector<std::string>> gazetteer_of(const std::string& path);

}  // namespace palpable::cli
