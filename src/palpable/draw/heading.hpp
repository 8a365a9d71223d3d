// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace palpable::draw {

/// What stands above a picture, so that it explains itself when it is sent on without a letter.
struct Heading {
  std::string title;
  std::string subtitle;
};

}  // namespace palpable::draw
