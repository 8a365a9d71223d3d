// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/tool_text.hpp"

#include <cstdint>
#include <cstdlib>

// Any text gives poses and tools that pass their own checks, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto path = cli::parse_tool_path(text);
  if (!path && path.error().message.empty()) std::abort();
  if (path && !haptics::check_poses(path->poses)) std::abort();
  const auto tool = cli::parse_tool(text);
  if (!tool && tool.error().message.empty()) std::abort();
  if (tool && !haptics::check_tool(*tool)) std::abort();
  return 0;
}
