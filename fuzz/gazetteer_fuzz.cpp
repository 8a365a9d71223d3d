// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/gazetteer.hpp"

#include <cstdint>
#include <cstdlib>

// The first line is a name that was read, the others are a gazetteer. Any text gives names, or an error; the
// nearest name is one of them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace vision = palpable::vision;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return 0;
  const auto names = vision::parse_gazetteer(text.substr(end + 1));
  if (!names) {
    if (names.error().message.empty()) std::abort();
    return 0;
  }
  for (const std::string& name : *names)
    if (name.empty() || name.size() > vision::kMaxNameBytes) std::abort();
  const std::string_view read = text.substr(0, end).substr(0, vision::kMaxNameBytes);
  const auto nearest = vision::nearest_name(read, *names, 0.5);
  if (nearest && vision::similarity_of(vision::compared_form(read), vision::compared_form(*nearest)) < 0.5)
    std::abort();
  return 0;
}
