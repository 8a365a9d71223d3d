// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contours.hpp"

#include "palpable/vision/contours/contour_steps.hpp"
#include "palpable/vision/contours/edge_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::vision {
namespace {

Result<void> check_input(const Image& image, const ContourOptions& options) {
  if (auto valid = check(options); !valid) return valid;
  if (image.width < 8 || image.height < 8)
    return invalid_input("the picture is smaller than 8 x 8 pixels: there is no contour to follow");
  if (!std::all_of(image.samples.begin(), image.samples.end(), [](float v) { return std::isfinite(v); }))
    return invalid_input("the picture has samples that are not finite numbers");
  return {};
}

EdgeResponse edges_by(const Image& image, const ContourOptions& options, const Work& work) {
  switch (options.method) {
    case ContourMethod::paper:
      return paper_edges(image, work);
    case ContourMethod::best:
      return best_edges(image, options, work);
    case ContourMethod::standard:
      break;
  }
  return standard_edges(image, options, work);
}

}  // namespace

Result<ContourMap> find_contours(const Image& image, const ContourOptions& options, const Work& work) {
  if (auto valid = check_input(image, options); !valid) return valid.error();
  EdgeResponse edges = edges_by(image, options, work);
  if (work.cancelled()) return Work::interrupted();
  ContourMap out;
  out.threshold = options.threshold ? *options.threshold
                                    : std::max({options.least_threshold, double{edges.least_threshold},
                                                otsu_threshold(edges.strength)});
  std::size_t boundary = 0;
  for (const float s : edges.strength.values())
    boundary += s > 0.0F && s >= static_cast<float>(out.threshold) ? 1U : 0U;
  out.boundary_fraction = static_cast<double>(boundary) / static_cast<double>(edges.strength.count());
  out.line =
      ridge_lines(edges.strength, edges.tangent_x, edges.tangent_y, out.threshold, options.lines, work);
  const auto followed = static_cast<float>(options.lines.followed_share * out.threshold);
  for (float& s : edges.strength.values())
    if (s < followed) s = 0.0F;
  out.tangent_x = std::move(edges.tangent_x);
  out.tangent_y = std::move(edges.tangent_y);
  out.strength = std::move(edges.strength);
  if (boundary == 0)
    out.notes.emplace_back(
        "No boundary was found in this picture: it has only one tone, so there is no line to touch.");
  return out;
}

}  // namespace palpable::vision
