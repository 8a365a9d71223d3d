// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/url.hpp"

#include <cstdint>
#include <cstdlib>

// Any text is an address whose options are taken out or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto url = palpable::device::DeviceUrl::parse({reinterpret_cast<const char*>(data), size});
  if (!url) return 0;
  if (url->scheme().empty()) std::abort();
  const double mass = url->take_number("mass", 1.0, 0.1, 5.0);
  if (!(mass >= 0.1 && mass <= 5.0)) std::abort();
  static_cast<void>(url->take_word("dof", {"3", "2"}));
  static_cast<void>(url->finish());
  return 0;
}
