// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace palpable::sources {

/// Whether a file that begins with this text is CityJSON, by the names of its members.
inline bool is_city_json(std::string_view start) {
  return start.starts_with('{') && (start.find("\"CityJSON\"") != std::string_view::npos ||
                                    start.find("\"CityObjects\"") != std::string_view::npos);
}

}  // namespace palpable::sources
