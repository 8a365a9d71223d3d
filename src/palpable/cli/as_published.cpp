// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/as_published.hpp"

#include <algorithm>
#include <array>

namespace palpable::cli {
namespace {

using haptics::Law;

// Loop rates: Shi & Pai 1997, Gomez 2012 and GHD 2006 state 500, 997 and 400 Hz; Park & Howard 2012 state how
// long a force took, and no rate.
constexpr std::array kPublished{
    Published{"shi", Law::sobel, 0.0, 500.0, "scanline", "", "150x100x15", "",
              "The paper does not state the height: it is 15 mm."},
    Published{"park", Law::grid, 1.0, std::nullopt, "graph-cut", "", "", "",
              "The paper does not state the number of grid points: --grid-points sets it.",
              session::MakeAs::grid},
    Published{"gomez", Law::averaged, 1.0, 997.0, "pyramid", "", "101.6x101.6x15", "bicubic",
              "The weights of the average are corrected; the offset is 1 mm."},
    Published{"ghd", Law::tracing, 0.0, 400.0, "", "paper", "140x100x15", "",
              "Eq. 8 is corrected so that it does not push a resting hand."},
    Published{"moustakas", Law::penalty, 0.0, std::nullopt, "", "", "", "",
              "The sign of the force is corrected, and the field is built from the exact surface, not from "
              "superquadrics.",
              session::MakeAs::field, true}};

}  // namespace

void add_as_published(Options& options, std::string& name) {
  options.choice("--as-published", name, {"shi", "park", "gomez", "ghd", "moustakas"},
                 "One paper's method, law and loop rate together");
}

Result<std::optional<Published>> published_as(const std::string& name) {
  if (name.empty()) return std::optional<Published>{};
  const auto* found = std::find_if(kPublished.begin(), kPublished.end(),
                                   [&name](const Published& p) { return p.name == name; });
  if (found == kPublished.end())
    return Error{ErrorCode::usage, "there is no paper called " + name, "--as-published"};
  return std::optional(*found);
}

void apply_published(const Published& published, MakeArguments& arguments) {
  if (arguments.stereo.method.empty()) arguments.stereo.method = published.stereo_method;
  if (arguments.contour_method.empty()) arguments.contour_method = published.contour_method;
  if (arguments.size.empty()) arguments.size = published.size;
  if (arguments.resample == "none" && !published.resampling.empty())
    arguments.resample = published.resampling;
  if (published.keeps_forces && !arguments.dense) arguments.paper = true;
}

}  // namespace palpable::cli
