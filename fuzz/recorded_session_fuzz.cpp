// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The JSON texts of a recording: its header and the description of what was touched. Text that can be read is
// written and read again, with the same result.
#include "palpable/session/touch/recorded_touch.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace session = palpable::session;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto header = session::parse_header(text)) {
    if (!(header->rate_hz > 0.0)) std::abort();
    if (header->format == 2 && !session::parse_header(session::header_json(*header))) std::abort();
  }
  if (const auto touch = session::parse_touch(text);
      touch && !session::parse_touch(session::touch_json(*touch)))
    std::abort();
  return 0;
}
