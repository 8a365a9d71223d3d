// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace palpable::draw {

/// Title and subtitle above a figure, which make it readable on its own.
struct FigureTitle {
  std::string title;
  std::string subtitle;
};

}  // namespace palpable::draw
