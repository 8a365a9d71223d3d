// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/qr_code.hpp"

#include <cstddef>
#include <memory>

#include <qrencode.h>

namespace palpable::page {
namespace {

constexpr int kMargin = 4;

struct FreeCode {
  void operator()(QRcode* code) const { QRcode_free(code); }
};

}  // namespace

Result<QrCode> qr_code(std::string_view text) {
  const std::unique_ptr<QRcode, FreeCode> made(
      text.empty() ? nullptr : QRcode_encodeString(std::string(text).c_str(), 0, QR_ECLEVEL_M, QR_MODE_8, 1));
  if (made == nullptr) return invalid_input("a QR code cannot hold this text");
  QrCode code;
  code.side = made->width;
  const auto count = static_cast<std::size_t>(code.side) * static_cast<std::size_t>(code.side);
  // The lowest bit of a module: whether it is dark.
  for (std::size_t k = 0; k < count; ++k) code.modules.push_back((made->data[k] & 1U) != 0 ? '1' : '0');
  return code;
}

std::string terminal_text(const QrCode& code) {
  std::string text;
  for (int row = -kMargin; row < code.side + kMargin; row += 2) {
    text += "\x1b[38;5;16;48;5;231m";
    for (int column = -kMargin; column < code.side + kMargin; ++column) {
      const bool upper = code.is_dark(column, row);
      const bool lower = code.is_dark(column, row + 1);
      text += upper ? (lower ? "█" : "▀") : (lower ? "▄" : " ");
    }
    text += "\x1b[0m\n";
  }
  return text;
}

}  // namespace palpable::page
