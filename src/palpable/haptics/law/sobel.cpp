// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/sobel.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace palpable::haptics {
namespace {

constexpr std::array<double, 5> kSmooth{1, 4, 6, 4, 1};
constexpr std::array<double, 5> kDerive{-1, -2, 0, 2, 1};
// The operator's response to a slope of one pixel height per pixel: 16 by smoothing times 8 by
// differentiation.
constexpr double kGain = 128.0;

Raster<double> halved(const Raster<float>& heights) {
  Raster<double> half(std::max(1, heights.width() / 2), std::max(1, heights.height() / 2));
  for (int y = 0; y < half.height(); ++y)
    for (int x = 0; x < half.width(); ++x) {
      const int x1 = std::min(2 * x + 1, heights.width() - 1);
      const int y1 = std::min(2 * y + 1, heights.height() - 1);
      half(x, y) = 0.25 * (double{heights(2 * x, 2 * y)} + double{heights(x1, 2 * y)} +
                           double{heights(2 * x, y1)} + double{heights(x1, y1)});
    }
  return half;
}

constexpr std::array kParameters{kSlopeForce, kPlaneDamping};

MadeLaw make(const LawInput& in) {
  const auto& relief = models::relief_of(in.scene);
  const LawParameters& p = in.parameters;
  return made_law(SobelLaw(relief, value_or_preset(p, kSlopeForce), value_or_preset(p, kPlaneDamping)),
                  mixed(static_cast<std::uint64_t>(p.law), content_hash(*relief)));
}

int nearest(double place, int count) noexcept {
  return place > 0.0 ? (place < count - 1 ? static_cast<int>(place) : count - 1) : 0;
}

}  // namespace

SobelSlopes::SobelSlopes(const models::Relief& relief) {
  const Raster<double> half = halved(relief.samples_m());
  const int w = half.width();
  const int h = half.height();
  slopes_ = Raster<ImageSlope>(w, h);
  pixels_per_m_x_ = w / relief.size_x_m();
  pixels_per_m_y_ = h / relief.size_y_m();
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      double right = 0.0;
      double down = 0.0;
      for (int b = -2; b <= 2; ++b)
        for (int a = -2; a <= 2; ++a) {
          const double z = half(std::clamp(x + a, 0, w - 1), std::clamp(y + b, 0, h - 1));
          const auto i = static_cast<std::size_t>(a + 2);
          const auto j = static_cast<std::size_t>(b + 2);
          right += kDerive[i] * kSmooth[j] * z;
          down += kSmooth[i] * kDerive[j] * z;
        }
      slopes_(x, y) = {static_cast<float>(right * pixels_per_m_x_ / kGain),
                       static_cast<float>(-down * pixels_per_m_y_ / kGain)};
    }
}

ImageSlope SobelSlopes::at(double x_m, double y_m) const noexcept {
  return slopes_(nearest(0.5 * slopes_.width() + x_m * pixels_per_m_x_, slopes_.width()),
                 nearest(0.5 * slopes_.height() - y_m * pixels_per_m_y_, slopes_.height()));
}

LawOutput SobelLaw::evaluate(const Hand& hand, State&) const noexcept {
  const ImageSlope s = slopes_.at(hand.position.v.x, hand.position.v.y);
  const Vec3 v = hand.velocity_m_per_s.v;
  LawOutput output;
  output.contact = true;
  output.stored_J = slope_force_N_ * relief_->sample(hand.position.v.x, hand.position.v.y).z_m;
  output.force_N.v = {-slope_force_N_ * double{s.dzdx} - damping_Ns_per_m_ * v.x,
                      -slope_force_N_ * double{s.dzdy} - damping_Ns_per_m_ * v.y, 0.0};
  return output;
}

constexpr LawDescription kSobelLaw{.law = Law::sobel,
                                   .name = "sobel",
                                   .title = "Rolling ball, as published",
                                   .paper = "Shi & Pai 1997",
                                   .models = {.relief = true},
                                   .parameters = kParameters,
                                   .strength = &LawParameters::slope_force_N,
                                   .degrees_of_freedom = 2,
                                   .make = make};

void read_pages(const SobelSlopes& slopes) noexcept {
  read_pages(slopes.slopes().data(), slopes.slopes().count() * sizeof(ImageSlope));
}

}  // namespace palpable::haptics
