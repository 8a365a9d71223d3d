// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The address of a live source (the first line), and the names of a folder's files (the others).
#include "palpable/session/touch/live_address.hpp"
#include "palpable/sources/live/frame_folder.hpp"

#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <variant>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string address(rest.substr(0, rest.find('\n')));
  rest.remove_prefix(std::min(rest.size(), address.size() + 1));
  static_cast<void>(session::is_live_address(address));
  if (const auto parsed = session::parse_live_address(address)) {
    const auto* frames = std::get_if<session::FramesAddress>(&*parsed);
    if (frames != nullptr && !(frames->rate_hz >= 0.1 && frames->rate_hz <= 240.0)) std::abort();
    const auto* network = std::get_if<session::HttpCameras>(&*parsed);
    // What would be a second line of the request.
    if (network != nullptr && network->left.target.find_first_of("\r\n ") != std::string::npos) std::abort();
  } else if (parsed.error().message.empty()) {
    std::abort();
  }
  std::set<std::string> names;
  while (!rest.empty()) {
    const std::string_view name = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), name.size() + 1));
    names.emplace(name);
  }
  const auto frames = sources::frames_among(names);
  if (frames.size() > names.size()) std::abort();
  for (const sources::FrameNames& frame : frames) {
    const bool is_pair = frame.depth.empty();
    if (is_pair != !frame.right.empty() || (is_pair && frame.colour.empty())) std::abort();
    for (const std::string& name : {frame.depth, frame.colour, frame.right})
      if (!name.empty() && !names.contains(name)) std::abort();
  }
  return 0;
}
