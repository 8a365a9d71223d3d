// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/as_published.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

using haptics::Law;
using haptics::LawParameters;

bool is_given(const MakeArguments& make, std::string_view option) {
  const auto given = make.given ? make.given() : std::vector<std::string>{};
  return std::find(given.begin(), given.end(), option) != given.end();
}

/// Sets an option that the user has not given.
void preset(const MakeArguments& make, std::string_view option, std::string& target, std::string_view value) {
  if (!is_given(make, option)) target = value;
}

// Shi & Pai 1997: the 5 x 5 Sobel operator is convolved with the disparity image; front view; 10 x 15 cm.
void make_as_shi(MakeArguments& make) {
  preset(make, "--method", make.stereo.method, "scanline");
  preset(make, "--size", make.size, "150x100x15");
  preset(make, "--height-of", make.height_of, "disparity");
  preset(make, "--detail", make.detail, "linear");
  preset(make, "--texture", make.texture, "front");
  if (!is_given(make, "--steepest")) make.steepest_slope = 100.0;
}

// Park & Howard 2012, 4 and 5: graph cuts; ground and background are removed; the surface points are
// projected by the camera's matrix and the volume behind them is filled.
void make_as_park(MakeArguments& make) {
  preset(make, "--method", make.stereo.method, "graph-cut");
  preset(make, "--ground", make.ground, "remove");
  preset(make, "--background", make.background, "remove");
  preset(make, "--grid-filling", make.grid_filling, "camera");
}

// Gomez 2012: pyramid, the bilateral operator of Durand & Dorsey (the thesis' final choice), bicubic
// interpolation, 4 x 4 inches.
void make_as_gomez(MakeArguments& make) {
  preset(make, "--method", make.stereo.method, "pyramid");
  preset(make, "--size", make.size, "101.6x101.6x15");
  preset(make, "--detail", make.detail, "bilateral");
  preset(make, "--resample", make.resample, "bicubic");
  if (!is_given(make, "--steepest")) make.steepest_slope = 100.0;
}

// Graphic-haptic display 2006: Sobel, Otsu and Climent; 140 x 100 mm.
void make_as_ghd(MakeArguments& make) {
  preset(make, "--contour-method", make.contour_method, "paper");
  preset(make, "--size", make.size, "140x100x15");
}

// Moustakas et al. 2007: superquadrics, corrected by the measured surface; distance and force at every
// lattice point, by fast marching.
void make_as_moustakas(MakeArguments& make) {
  if (!make.dense) make.paper = true;
  if (!make.resolution) make.resolution = 400;
  preset(make, "--surface", make.surface, "corrected");
}

LawParameters point(Law law) {
  LawParameters parameters;
  parameters.law = law;
  parameters.radius_m = 0.0;
  return parameters;
}

LawParameters shaded_penalty() {
  LawParameters parameters = point(Law::penalty);
  parameters.force_shading = 1.0;
  return parameters;
}

// Eq. 8 alone, without limits and without a damper.
LawParameters printed_tracing() {
  LawParameters parameters = point(Law::tracing);
  parameters.tracing_bounds = 0.0;
  parameters.damping_Ns_per_m = 0.0;
  return parameters;
}

// Loop rates: Shi & Pai 1997, Gomez 2012 and GHD 2006 state 500, 997 and 400 Hz. Park & Howard 2012 state the
// time per force, but no rate.
const std::array<Published, 5> kPublished{
    Published{
        "shi", point(Law::sobel), 500.0,
        "The paper does not state the height: it is 15 mm. Of a pair of pictures, the half percent of the "
        "wildest disparities is held at the ends of the range, and holes are closed; other inputs have no "
        "disparity, so their heights are used. The force image has half the relief's resolution, as in the "
        "paper.",
        session::MakeAs::relief, make_as_shi},
    Published{
        "park", point(Law::grid), std::nullopt,
        "The paper does not state the number of grid points: --grid-points sets it. The convolution of "
        "eq. 6 is a product, and depth and normal are interpolated between the points. The half percent of "
        "the nearest and of the farthest points is left out. One camera with a moving arm (4.2) is not "
        "offered.",
        session::MakeAs::grid, make_as_park},
    Published{
        "gomez", point(Law::averaged), 997.0,
        "The weights of the average are corrected; the offset is 1 mm. The curve for the base of the detail "
        "operator, which was drawn by hand, is a power of 0.8, and base and detail are added where the "
        "paper multiplies.",
        session::MakeAs::relief, make_as_gomez},
    Published{
        "ghd", printed_tracing(), 400.0,
        "Eq. 8 is rendered as printed, without our speed gate and tank: it also pushes a resting hand, and "
        "outside of a simulation the passivity controller weakens it. A light wall holds the hand in front "
        "of the picture. Eq. 4 is used with its mirror, and eq. 7 averages structure tensors. The field is "
        "interpolated between pixels (the paper takes pixel i,j), and the epsilon of eq. 5 is fixed at "
        "0.5 mm (the paper: according to the resolution).",
        session::MakeAs::by_input, make_as_ghd},
    Published{"moustakas", shaded_penalty(), std::nullopt,
              "The sign of the force is corrected. Other inputs than videos have no segments or frames: "
              "superquadrics are fitted to the whole surface, which then corrects them. Unless "
              "--resolution is given, the lattice has 400 places along the longest side (the paper: 512).",
              session::MakeAs::field, make_as_moustakas}};

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

session::MakeAs made_for(const Published& published) {
  const haptics::ModelKinds models = haptics::description_of(published.law.law).models;
  const bool only_contours = models.contours && !models.relief && !models.field;
  return only_contours ? session::MakeAs::contours : published.as;
}

Error without_its_scene(Error error, const Published& published) {
  if (error.code != ErrorCode::usage) return error;
  // The user named the paper, not its law.
  if (error.place == "--law") error.place = "--as-published";
  error.message += fmt::format(
      "; palpable make --as-published {} makes a scene for this paper from its inputs", published.name);
  return error;
}

void apply_published(const Published& published, MakeArguments& arguments) { published.make(arguments); }

void apply_published(const Published& published, haptics::LawParameters& parameters) {
  for (const haptics::LawParameter& parameter : haptics::description_of(published.law.law).parameters) {
    auto& value = parameters.*parameter.value;
    if (!value) value = published.law.*parameter.value;
  }
}

}  // namespace palpable::cli
