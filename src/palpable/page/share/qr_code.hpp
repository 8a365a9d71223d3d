// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>
#include <string_view>

namespace palpable::page {

/// A QR code without its margin, which must be light and four modules wide.
struct QrCode {
  /// Modules on each side.
  int side = 0;
  /// side × side characters, row by row: '1' is dark, '0' is light.
  std::string modules;

  /// False outside of the code, as in its margin.
  bool is_dark(int column, int row) const {
    return column >= 0 && row >= 0 && column < side && row < side &&
           modules[static_cast<std::size_t>(row * side + column)] == '1';
  }
};

/// The QR code of a text, with 15 % of redundancy (level M). Errors: invalid_input for a text that is empty
/// or too long.
Result<QrCode> qr_code(std::string_view text);

/// The code with its margin for a terminal, two rows of modules in each line, as half blocks in black on
/// white whatever the terminal's colours are (ECMA-48).
std::string terminal_text(const QrCode& code);

}  // namespace palpable::page
