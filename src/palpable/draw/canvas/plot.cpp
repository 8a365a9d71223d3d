// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/plot.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace palpable::draw {
namespace {

constexpr double kLabel_px = 13.0;
constexpr double kTick_px = 6.0;

double round_step(double span, int most) {
  const double raw = span / std::max(most - 1, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

double step_of(const std::vector<double>& ticks) { return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0; }

}  // namespace

std::vector<double> round_ticks(double low, double high, int most) {
  std::vector<double> ticks;
  if (!(high > low) || most < 2) return ticks;
  const double step = round_step(high - low, most);
  const auto first = static_cast<long long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high / step + 1e-9));
  for (long long k = first; k <= last; ++k) ticks.push_back(static_cast<double>(k) * step);
  return ticks;
}

std::string label_of(double value, double step) {
  // A range of one value gives a step of 0: no decimals.
  const int decimals =
      step > 0.0 ? std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 12) : 0;
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return value < 0.0 && !zero ? "\u2212" + text : text;
}

void draw_axes(Canvas& canvas, const Plot& plot, const std::string& x_name, const std::string& y_name) {
  const StrokeStyle style{{70, 70, 70}, 1.2};
  canvas.frame(plot.area, style);
  const auto xs = round_ticks(std::min(plot.left, plot.right), std::max(plot.left, plot.right),
                              std::max(3, static_cast<int>(plot.area.width / 75.0)));
  for (const double value : xs) {
    canvas.line({plot.x(value), plot.area.bottom()}, {plot.x(value), plot.area.bottom() + kTick_px}, style);
    canvas.text(label_of(value, step_of(xs)), {plot.x(value), plot.area.bottom() + kTick_px + 2.0},
                {.size_px = kLabel_px, .align = Align::centre});
  }
  const auto ys = round_ticks(std::min(plot.bottom, plot.top), std::max(plot.bottom, plot.top),
                              std::max(4, static_cast<int>(plot.area.height / 50.0)));
  for (const double value : ys) {
    canvas.line({plot.area.x - kTick_px, plot.y(value)}, {plot.area.x, plot.y(value)}, style);
    canvas.text(label_of(value, step_of(ys)),
                {plot.area.x - kTick_px - 3.0, plot.y(value) - 0.62 * kLabel_px},
                {.size_px = kLabel_px, .align = Align::right});
  }
  canvas.text(x_name, {plot.area.x + plot.area.width / 2.0, plot.area.bottom() + 28.0},
              {.size_px = 14.0, .align = Align::centre});
  canvas.text(y_name, {plot.area.x - 62.0, plot.area.y + plot.area.height / 2.0},
              {.size_px = 14.0, .align = Align::centre, .upward = true});
}

void draw_colour_bar(Canvas& canvas, Rect area, double low, double high, const std::string& name,
                     Rgb8 (*colour)(double)) {
  constexpr int kSteps = 256;
  Raster<Rgb8> bar(1, kSteps);
  for (int i = 0; i < kSteps; ++i) bar(0, i) = colour(1.0 - static_cast<double>(i) / (kSteps - 1));
  canvas.picture(bar, area);
  const StrokeStyle style{{70, 70, 70}, 1.2};
  canvas.frame(area, style);
  canvas.text(name, {area.x, area.y - 46.0}, {.size_px = 14.0, .wrap_px = 150.0});
  const Plot plot{area, 0.0, 1.0, low, high};
  const auto ticks = round_ticks(low, high, std::max(3, static_cast<int>(area.height / 55.0)));
  for (const double value : ticks) {
    canvas.line({area.right(), plot.y(value)}, {area.right() + kTick_px, plot.y(value)}, style);
    canvas.text(label_of(value, step_of(ticks)),
                {area.right() + kTick_px + 4.0, plot.y(value) - 0.62 * kLabel_px}, {.size_px = kLabel_px});
  }
}

void draw_scale_bar(Canvas& canvas, const Plot& plot) {
  const double span = plot.right - plot.left;
  const double length = round_step(span / 5.0 * 0.75, 2);
  const double px = length / span * plot.area.width;
  const Rect bar{plot.area.x + 16.0, plot.area.bottom() - 24.0, px, 6.0};
  canvas.fill({bar.x - 2.0, bar.y - 2.0, bar.width + 4.0, bar.height + 4.0}, {255, 255, 255}, 0.9);
  canvas.fill(bar, {26, 26, 26});
  canvas.text(fmt::format("{} mm", label_of(length, length)), {bar.x + px / 2.0, bar.y - 21.0},
              {.size_px = 13.0, .bold = true, .align = Align::centre, .rim = true});
}

}  // namespace palpable::draw
