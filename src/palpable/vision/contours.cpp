// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours.hpp"

#include "palpable/vision/contours_standard.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace palpable::vision {
namespace {

/// A boundary, once begun, is followed down to this share of the threshold.
constexpr double kFollow = 0.5;
/// Otsu always splits, even nothing: strength below this is less than one grey level of 8 bits.
constexpr double kFaintest = 0.02;

Result<void> check(const Image& image, const ContourOptions& options) {
  if (image.width < 8 || image.height < 8)
    return invalid_input("the picture is smaller than 8 x 8 pixels: there is no contour to follow");
  if (!(options.neighbourhood_px >= 1.0 && options.neighbourhood_px <= 32.0))
    return Error{ErrorCode::usage, "the neighbourhood must be 1 to 32 pixels", {}};
  if (!(options.threshold < 0.0 || options.threshold <= 1.0))
    return Error{ErrorCode::usage, "the threshold must be 0 to 1", {}};
  if (!std::all_of(image.samples.begin(), image.samples.end(), [](float v) { return std::isfinite(v); }))
    return invalid_input("the picture has samples that are not finite numbers");
  return {};
}

}  // namespace

Result<Contours> find_contours(const Image& image, const ContourOptions& options, const Work& work) {
  if (auto fine = check(image, options); !fine) return fine.error();
  EdgeMap edges =
      options.method == ContourMethod::paper ? paper_edges(image, work) : standard_edges(image, work);
  if (work.cancelled()) return Work::interrupted();
  Contours out;
  out.threshold =
      options.threshold >= 0.0 ? options.threshold : std::max(kFaintest, otsu_threshold(edges.strength));
  std::size_t boundary = 0;
  for (const float s : edges.strength.values())
    boundary += s > 0.0F && s >= static_cast<float>(out.threshold) ? 1U : 0U;
  out.boundary_fraction = static_cast<double>(boundary) / static_cast<double>(edges.strength.count());
  out.line =
      ridge_lines(edges.strength, edges.tangent_x, edges.tangent_y, kFollow * out.threshold, out.threshold);
  for (float& s : edges.strength.values())
    if (s < static_cast<float>(kFollow * out.threshold)) s = 0.0F;
  average_neighbourhood(edges.tangent_x, edges.tangent_y, edges.strength, options.neighbourhood_px, work);
  out.tangent_x = std::move(edges.tangent_x);
  out.tangent_y = std::move(edges.tangent_y);
  out.strength = std::move(edges.strength);
  if (boundary == 0)
    out.notes.emplace_back("there is no boundary in this picture: it is of one tone throughout");
  return out;
}

void average_neighbourhood(Raster<float>& tangent_x, Raster<float>& tangent_y, Raster<float>& strength,
                           double radius_px, const Work& work) {
  struct Tap {
    int dx, dy;
    float weight;
  };
  const int r = static_cast<int>(std::ceil(radius_px));
  std::vector<Tap> taps;
  float total = 0.0F;
  for (int dy = -r; dy <= r; ++dy) {
    for (int dx = -r; dx <= r; ++dx) {
      const double weight = 1.0 - std::hypot(dx, dy) / radius_px;
      if (weight <= 0.0) continue;
      taps.push_back({dx, dy, static_cast<float>(weight)});
      total += taps.back().weight;
    }
  }
  const int w = strength.width();
  const int h = strength.height();
  Raster<float> c2(w, h);
  Raster<float> s2(w, h);
  for (std::size_t i = 0; i < strength.count(); ++i) {
    const float tx = tangent_x.values()[i];
    const float ty = tangent_y.values()[i];
    c2.values()[i] = strength.values()[i] * (tx * tx - ty * ty);
    s2.values()[i] = strength.values()[i] * 2.0F * tx * ty;
  }
  parallel_for(work, h, 16, [&](int begin, int end) {
    std::vector<float> c(static_cast<std::size_t>(w));
    std::vector<float> s(static_cast<std::size_t>(w));
    for (int y = begin; y < end; ++y) {
      std::fill(c.begin(), c.end(), 0.0F);
      std::fill(s.begin(), s.end(), 0.0F);
      for (const Tap& tap : taps) {
        const auto c_row = c2.row(std::clamp(y + tap.dy, 0, h - 1));
        const auto s_row = s2.row(std::clamp(y + tap.dy, 0, h - 1));
        for (int x = std::max(0, -tap.dx); x < std::min(w, w - tap.dx); ++x) {
          c[static_cast<std::size_t>(x)] += tap.weight * c_row[static_cast<std::size_t>(x + tap.dx)];
          s[static_cast<std::size_t>(x)] += tap.weight * s_row[static_cast<std::size_t>(x + tap.dx)];
        }
      }
      for (int x = 0; x < w; ++x) {
        const float cx = c[static_cast<std::size_t>(x)];
        const float sx = s[static_cast<std::size_t>(x)];
        const float length = std::sqrt(cx * cx + sx * sx);
        strength(x, y) = std::min(1.0F, length / total);
        std::tie(tangent_x(x, y), tangent_y(x, y)) = halve_angle(cx, sx);
      }
    }
  });
}

}  // namespace palpable::vision
