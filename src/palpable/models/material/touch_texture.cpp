// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/material/touch_texture.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace palpable::models {
namespace {

struct Name {
  TouchTexture::Kind kind;
  std::string_view name;
};
constexpr std::array kNames{Name{TouchTexture::Kind::none, "none"}, Name{TouchTexture::Kind::grain, "grain"},
                            Name{TouchTexture::Kind::ridges, "ridges"},
                            Name{TouchTexture::Kind::bumps, "bumps"},
                            Name{TouchTexture::Kind::picture, "picture"}};

constexpr int kTileSide = kTextureSide;
/// Periods per side of the square: 16 samples each, which a cubic B-spline attenuates by 1/40.
constexpr int kForms = 4;
constexpr int kStride = kTileSide + 3;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Waves in all directions with lengths near the pitch: an isotropic noise.
class Grain {
 public:
  Grain() {
    std::mt19937 random(1);
    for (int x = -kForms - 1; x <= kForms + 1; ++x)
      for (int y = 0; y <= kForms + 1; ++y) {
        const double forms = std::hypot(x, y);
        if (forms < kForms - 0.75 || forms > kForms + 0.75 || (y == 0 && x < 0)) continue;
        waves_.push_back({x, y, kTurn * static_cast<double>(random()) * 0x1.0p-32});
      }
  }
  double at(double u, double v) const {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += std::cos(kTurn * (w.x * u + w.y * v) + w.phase);
    return sum;
  }

 private:
  struct Wave {
    int x;
    int y;
    double phase;
  };
  std::vector<Wave> waves_;
};

int forms_of(TouchTexture::Kind kind) { return kind == TouchTexture::Kind::picture ? kPictureForms : kForms; }

/// The pattern over the unit square, -1 to 1.
std::vector<double> pattern_of(TouchTexture::Kind kind) {
  const Grain grain;
  std::vector<double> values;
  values.reserve(std::size_t{kTileSide} * kTileSide);
  for (int j = 0; j < kTileSide; ++j)
    for (int i = 0; i < kTileSide; ++i) {
      const double u = static_cast<double>(i) / kTileSide;
      const double v = static_cast<double>(j) / kTileSide;
      const double across = std::cos(kTurn * kForms * u);
      const double along = std::cos(kTurn * kForms * v);
      values.push_back(kind == TouchTexture::Kind::grain    ? grain.at(u, v)
                       : kind == TouchTexture::Kind::ridges ? across
                                                            : 0.5 * (1.0 + across) * (1.0 + along) - 1.0);
    }
  const double highest = std::abs(*std::max_element(
      values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (double& value : values) value /= highest;
  return values;
}

/// The control value before a position (in samples, up to 1e9), modulo the square's side, and the fraction
/// beyond it, 0 ... 1.
struct Wrapped {
  explicit Wrapped(double place) noexcept {
    // Shifted by whole squares to positive values, where truncation rounds down.
    constexpr double kFarOn = 0x1p31;
    static_assert((std::int64_t{1} << 31) % kTileSide == 0 && (kTileSide & (kTileSide - 1)) == 0);
    const double positive = place + kFarOn;
    const auto whole = static_cast<std::int64_t>(positive);
    index = static_cast<std::size_t>(whole & (kTileSide - 1));
    beyond = positive - static_cast<double>(whole);
  }
  std::size_t index;
  double beyond;
};

}  // namespace

std::string_view name_of(TouchTexture::Kind kind) {
  return std::find_if(kNames.begin(), kNames.end(), [kind](const Name& n) { return n.kind == kind; })->name;
}

std::optional<TouchTexture::Kind> texture_kind_from(std::string_view name) {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [name](const Name& n) { return n.name == name; });
  return found != kNames.end() ? std::optional(found->kind) : std::nullopt;
}

bool is_valid(const TouchTexture& t) {
  const bool has_tile =
      t.tile.size() == std::size_t{kTileSide} * kTileSide &&
      std::all_of(t.tile.begin(), t.tile.end(), [](float v) { return v >= -1.001F && v <= 1.001F; });
  return (has_tile || (t.tile.empty() && t.kind != TouchTexture::Kind::picture)) && t.pitch_m >= 0.0999e-3 &&
         t.pitch_m <= 20.001e-3 && t.height_m >= 0.0 && t.height_m <= 1.001e-3 && std::isfinite(t.angle_rad);
}

TexturePattern::TexturePattern(const TouchTexture& texture)
    : values_(std::size_t{kStride} * kStride),
      pitch_m_(texture.pitch_m),
      cos_(std::cos(texture.angle_rad)),
      sin_(std::sin(texture.angle_rad)),
      samples_per_m_(static_cast<double>(kTileSide) / forms_of(texture.kind) / texture.pitch_m) {
  PALPABLE_CHECK(is_valid(texture) && texture.kind != TouchTexture::Kind::none);
  const bool is_picture = texture.kind == TouchTexture::Kind::picture;
  const auto pattern =
      is_picture ? std::vector<double>(texture.tile.begin(), texture.tile.end()) : pattern_of(texture.kind);
  for (int j = 0; j < kStride; ++j)
    for (int i = 0; i < kStride; ++i) {
      // A picture's rows go down, the pattern's up.
      const int row = (j + kTileSide - 1) % kTileSide;
      const int from = (is_picture ? kTileSide - 1 - row : row) * kTileSide + (i + kTileSide - 1) % kTileSide;
      values_[static_cast<std::size_t>(j) * kStride + static_cast<std::size_t>(i)] =
          static_cast<float>(texture.height_m * pattern[static_cast<std::size_t>(from)]);
    }
}

HeightSample TexturePattern::sample(double x_m, double y_m) const noexcept {
  const Wrapped u((cos_ * x_m + sin_ * y_m) * samples_per_m_);
  const Wrapped v((cos_ * y_m - sin_ * x_m) * samples_per_m_);
  const SplineValue value =
      SplineBlock({values_.data() + v.index * kStride + u.index, kStride, Pair{u.beyond, v.beyond}})
          .evaluate();
  const double du = value.right * samples_per_m_;
  const double dv = value.down * samples_per_m_;
  return {value.z, cos_ * du - sin_ * dv, sin_ * du + cos_ * dv};
}

}  // namespace palpable::models
