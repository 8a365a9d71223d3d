// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contours.hpp"

#include "palpable/vision/contours/contours_standard.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::vision {
namespace {

/// Otsu always splits, even nothing: strength below this is less than one grey level of 8 bits.
constexpr double kFaintest = 0.02;

Result<void> check(const Image& image, const ContourOptions& options) {
  if (image.width < 8 || image.height < 8)
    return invalid_input("the picture is smaller than 8 x 8 pixels: there is no contour to follow");
  if (!(options.threshold < 0.0 || options.threshold <= 1.0))
    return Error{ErrorCode::usage, "the threshold must be 0 to 1", {}};
  if (!std::all_of(image.samples.begin(), image.samples.end(), [](float v) { return std::isfinite(v); }))
    return invalid_input("the picture has samples that are not finite numbers");
  return {};
}

EdgeMap edges_by(ContourMethod method, const Image& image, const Work& work) {
  switch (method) {
    case ContourMethod::paper:
      return paper_edges(image, work);
    case ContourMethod::best:
      return best_edges(image, work);
    case ContourMethod::standard:
      break;
  }
  return standard_edges(image, work);
}

}  // namespace

Result<Contours> find_contours(const Image& image, const ContourOptions& options, const Work& work) {
  if (auto fine = check(image, options); !fine) return fine.error();
  EdgeMap edges = edges_by(options.method, image, work);
  if (work.cancelled()) return Work::interrupted();
  Contours out;
  out.threshold = options.threshold >= 0.0
                      ? options.threshold
                      : std::max({kFaintest, double{edges.faintest}, otsu_threshold(edges.strength)});
  std::size_t boundary = 0;
  for (const float s : edges.strength.values())
    boundary += s > 0.0F && s >= static_cast<float>(out.threshold) ? 1U : 0U;
  out.boundary_fraction = static_cast<double>(boundary) / static_cast<double>(edges.strength.count());
  out.line = ridge_lines(edges.strength, edges.tangent_x, edges.tangent_y, kFollowedShare * out.threshold,
                         out.threshold, work);
  for (float& s : edges.strength.values())
    if (s < static_cast<float>(kFollowedShare * out.threshold)) s = 0.0F;
  out.tangent_x = std::move(edges.tangent_x);
  out.tangent_y = std::move(edges.tangent_y);
  out.strength = std::move(edges.strength);
  if (boundary == 0)
    out.notes.emplace_back("there is no boundary in this picture: it is of one tone throughout");
  return out;
}

}  // namespace palpable::vision
