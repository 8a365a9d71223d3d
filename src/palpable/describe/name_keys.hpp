// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace palpable::describe {

/// Keys of names on a tactile drawing: two small letters for each name, all different, the initials of its
/// words where these are free. One for one with `names`; with more than 676 names the later ones get none.
std::vector<std::string> name_keys(const std::vector<std::string>& names);

}  // namespace palpable::describe
