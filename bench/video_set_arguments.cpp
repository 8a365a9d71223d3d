// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "video_set_arguments.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace palpable::bench {
namespace {

bool set_one(VideoSetArguments& arguments, const std::string& name, double value) {
  std::vector<Parameter> all = recipes::parameters_of(arguments.recipe);
  append_parameters(all, "fusion", sculpt::parameters_of(arguments.recipe.fusion));
  for (const Parameter& p : all)
    if (p.name == name) return set_parameter(p, value).has_value();
  return false;
}

bool read_switch(std::string_view word, VideoSetArguments& out) {
  const auto at_least = [&](Surfaces surfaces) { out.surfaces = std::max(out.surfaces, surfaces); };
  if (word == "--no-depth")
    out.depth = false;
  else if (word == "--filter")
    out.recipe.motion_method = recipes::VideoMotion::filter;
  else if (word == "--fused")
    at_least(Surfaces::fused);
  else if (word == "--surfaces")
    at_least(Surfaces::corrected);
  else if (word == "--steps")
    at_least(Surfaces::corrected), out.steps = true;
  else if (word == "--true-depth")
    at_least(Surfaces::corrected), out.true_depth = true;
  else
    return false;
  return true;
}

}  // namespace

bool read(int count, char** words, VideoSetArguments& out) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (read_switch(word, out)) continue;
    if (i + 1 >= count) return false;
    const std::string value = words[++i];
    if (word == "--write") {
      out.folder = value;
    } else if (word == "--read") {
      out.written = value;
    } else if (word == "--errors") {
      out.errors = value;
    } else if (word == "--set") {
      const auto sign = value.find('=');
      if (sign == std::string::npos ||
          !set_one(out, value.substr(0, sign), std::strtod(value.c_str() + sign + 1, nullptr)))
        return false;
    } else {
      const int number = static_cast<int>(std::strtol(value.c_str(), nullptr, 10));
      if (word == "--seeds")
        out.seeds = number;
      else if (word == "--first")
        out.first = number;
      else if (word == "--frames")
        out.frames = number;
      else if (word == "--marker")
        out.marker_mm = number;
      else if (word == "--hand")
        out.hand_percent = number;
      else if (word == "--smooth-hand")
        out.hand_percent = number, out.hand_contrast = 0;
      else if (word == "--defocus")
        out.defocus_px = number;
      else if (word == "--threads")
        out.threads = static_cast<unsigned>(number);
      else
        return false;
    }
  }
  return true;
}

}  // namespace palpable::bench
