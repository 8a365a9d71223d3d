// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contours.hpp"

#include "palpable/vision/contours/contour_steps.hpp"
#include "palpable/vision/contours/drawn_shape.hpp"
#include "palpable/vision/image/reduced_picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Exact area of a unit pixel beyond a straight edge at signed distance t, whose normal has the components a
/// >= b >= 0.
double area_beyond(double t, double a, double b) {
  if (b < 1e-9) return std::clamp(t / a + 0.5, 0.0, 1.0);
  const auto half_square = [](double v) { return v > 0.0 ? 0.5 * v * v : 0.0; };
  return (half_square(t + (a + b) / 2) - half_square(t + (a - b) / 2) - half_square(t - (a - b) / 2) +
          half_square(t - (a + b) / 2)) /
         (a * b);
}

/// An ideal step: 0.8 where cos(angle) x + sin(angle) y > offset about the picture's centre, 0.2 elsewhere. 0
/// <= angle <= 90.
Image step(int size, double angle_deg, double offset_px) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double middle = 0.5 * (size - 1);
  Image image{size, size, 1, 16, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      image.samples.push_back(
          static_cast<float>(0.2 + 0.6 * area_beyond(c * (x - middle) + s * (y - middle) - offset_px,
                                                     std::max(c, s), std::min(c, s))));
  return image;
}

struct Errors {
  double max_deg = 0.0;
  double mean_deg = 0.0;
  double rms_deg = 0.0;
  int pixels = 0;
};

/// Tangent errors where the strength is above 0.8 of its greatest, 12 px from the border.
Errors direction_errors(const ContourMap& c, const std::function<double(double, double)>& tangent_deg) {
  const float top = *std::max_element(c.strength.values().begin(), c.strength.values().end());
  Errors e;
  for (int y = 12; y < c.strength.height() - 12; ++y) {
    for (int x = 12; x < c.strength.width() - 12; ++x) {
      if (c.strength(x, y) <= 0.8F * top) continue;
      const double got = std::atan2(c.tangent_y(x, y), c.tangent_x(x, y)) * 180.0 / std::numbers::pi;
      const double error = std::abs(std::remainder(got - tangent_deg(x, y), 180.0));
      e.max_deg = std::max(e.max_deg, error);
      e.mean_deg += error;
      e.rms_deg += error * error;
      ++e.pixels;
    }
  }
  e.mean_deg /= e.pixels;
  e.rms_deg = std::sqrt(e.rms_deg / e.pixels);
  return e;
}

ContourMap found(const Image& image, ContourMethod method = ContourMethod::standard) {
  ContourOptions options;
  options.method = method;
  auto result = find_contours(image, options, Work{});
  EXPECT_TRUE(result) << (result ? "" : result.error().sentence());
  return std::move(*result);
}

TEST(Contours, FollowStepEdgesOfAnyAngleAndOffset) {
  double mean = 0.0;
  int cases = 0;
  for (const double angle : {3.0, 11.0, 27.0, 35.5, 45.0, 52.0, 78.0, 86.0}) {
    for (const double offset : {-0.4, 0.0, 0.3}) {
      const Errors e =
          direction_errors(found(step(64, angle, offset)), [&](double, double) { return angle + 90.0; });
      EXPECT_GT(e.pixels, 50);
      EXPECT_LE(e.max_deg, 0.12) << angle << " " << offset;
      mean += e.mean_deg;
      ++cases;
    }
  }
  EXPECT_LE(mean / cases, 0.04);
}

TEST(Contours, KeepTheirDirectionUnderFivePercentNoise) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0F, 0.05F * 0.6F);
  for (const double angle : {3.0, 27.0, 52.0, 86.0}) {
    Image image = step(64, angle, 0.2);
    for (float& s : image.samples) s += noise(random);
    EXPECT_LE(direction_errors(found(image), [&](double, double) { return angle + 90.0; }).rms_deg, 0.7)
        << angle;
  }
}

TEST(Contours, FollowArcsOfSixToFortyPixels) {
  for (const double radius : {6.0, 8.0, 12.0, 20.0, 40.0}) {
    const Errors e = direction_errors(
        found(drawn(112, [&](double x, double y) { return std::hypot(x - 55.3, y - 55.8) < radius; })),
        [](double x, double y) { return std::atan2(y - 55.8, x - 55.3) * 180.0 / std::numbers::pi + 90.0; });
    EXPECT_GT(e.pixels, 30);
    EXPECT_LE(e.max_deg, 1.0) << radius;
  }
}

TEST(Contours, FollowBarsOfThreeToSixPixels) {
  for (const double width : {3.0, 4.0, 6.0}) {
    const double a = 17.0 * std::numbers::pi / 180.0;
    const Errors e = direction_errors(
        found(drawn(64,
                    [&](double x, double y) {
                      return std::abs(std::cos(a) * (x - 31.3) + std::sin(a) * (y - 31.6)) < width / 2;
                    })),
        [](double, double) { return 107.0; });
    EXPECT_LE(e.max_deg, 1.0) << width;
  }
}

TEST(Contours, MakeOneLineOfAThinLine) {
  for (const double width : {1.0, 2.0}) {
    for (const double angle : {0.0, 17.0, 45.0}) {
      const double a = angle * std::numbers::pi / 180.0;
      const ContourMap c = found(drawn(64, [&](double x, double y) {
        return std::abs(std::cos(a) * (x - 31.3) + std::sin(a) * (y - 31.6)) < width / 2;
      }));
      int crossings = 0;
      bool before = false;
      for (int x = 20; x < 44; ++x) {
        const bool now = c.line(x, 32) > 0.0F;
        crossings += now && !before ? 1 : 0;
        before = now;
      }
      EXPECT_EQ(crossings, 1) << width << " px wide at " << angle;
    }
  }
}

TEST(Contours, OfThePaperHaveTheMeasuredErrorsOnCentredEdges) {
  // methods.md 6: Sobel with Climent's masks in both octants, centred ideal steps: max 0.49, mean 0.14
  // degrees. Read at the pixels through whose centre the edge passes, one per angle.
  double worst = 0.0;
  double sum = 0.0;
  int n = 0;
  for (int k = 1; k < 90; ++k) {
    const Image image = step(9, k, 0.0);
    ContourOptions options;
    options.method = ContourMethod::paper;
    options.threshold = 0.0;
    const auto c = find_contours(image, options, Work{});
    ASSERT_TRUE(c);
    const double got = std::atan2(c->tangent_y(4, 4), c->tangent_x(4, 4)) * 180.0 / std::numbers::pi;
    const double error = std::abs(std::remainder(got - k - 90.0, 180.0));
    worst = std::max(worst, error);
    sum += error;
    ++n;
  }
  EXPECT_NEAR(worst, 0.49, 0.05);
  EXPECT_NEAR(sum / n, 0.14, 0.05);
}

/// A dark disc in multiplicative speckle with a standard deviation of half its mean and grains of 2 px.
Image speckled_disc() {
  std::mt19937 random(5);
  std::gamma_distribution<float> speckle(4.0F, 0.25F);
  Raster<float> grain(80, 80);
  for (float& v : grain.values()) v = speckle(random);
  Image image{160, 160, 1, 8, {}};
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x) {
      const float tone = std::hypot(x - 80.0, y - 80.0) < 45.0 ? 0.12F : 0.35F;
      image.samples.push_back(std::min(1.0F, tone * grain(x / 2, y / 2)));
    }
  return image;
}

TEST(Contours, OfMethodBestFindADiscInSpeckle) {
  ContourOptions options;
  options.method = ContourMethod::best;
  const auto c = find_contours(speckled_disc(), options, Work{});
  ASSERT_TRUE(c);
  int near = 0;
  int far = 0;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x)
      if (c->line(x, y) > 0.0F) ++(std::abs(std::hypot(x - 80.0, y - 80.0) - 45.0) < 6.0 ? near : far);
  EXPECT_GT(near, 180);  // of about 280
  EXPECT_LT(far, near / 2);
}

TEST(Contours, OfMethodBestEqualTheStandardOnesInAClearPicture) {
  const Image image = step(64, 30.0, 0.0);
  ContourOptions options;
  options.method = ContourMethod::best;
  const auto best = find_contours(image, options, Work{});
  ASSERT_TRUE(best);
  EXPECT_EQ(best->tangent_x, found(image).tangent_x);
  EXPECT_NEAR(best->strength(31, 31), found(image).strength(31, 31), 1e-3);
}

TEST(Contours, AreAbsentInAPictureOfOneTone) {
  const ContourMap c = found(drawn(32, [](double, double) { return true; }));
  EXPECT_EQ(c.boundary_fraction, 0.0);
  ASSERT_EQ(c.notes.size(), 1U);
  EXPECT_TRUE(
      std::all_of(c.strength.values().begin(), c.strength.values().end(), [](float s) { return s == 0.0F; }));
}

TEST(Contours, FindEdgesThatAreOnlyInTheColour) {
  Image image{64, 64, 3, 8, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const bool right = i % 64 >= 32;  // equal luma: 0.299 r + 0.587 g + 0.114 b
    for (const float v : right ? std::array{0.2F, 0.6F, 0.3F} : std::array{0.985F, 0.2F, 0.3F})
      image.samples.push_back(v);
  }
  const ContourMap c = found(image);
  EXPECT_GT(std::max(c.line(31, 30), c.line(32, 30)), 0.2F);
}

TEST(Contours, AreTheSameForAPictureInPartOfADeepRange) {
  // 12 bits in a 16-bit file: a sixteenth of the range.
  Image deep = step(64, 30.0, 0.0);
  const ContourMap wide = found(deep);
  for (float& s : deep.samples) s /= 16.0F;
  const ContourMap narrow = found(deep);
  EXPECT_NEAR(narrow.strength(31, 31), wide.strength(31, 31), 1e-3);
}

TEST(Contours, AreTheSameOnAnyNumberOfThreads) {
  const Image image = drawn(
      96, [](double x, double y) { return std::hypot(x - 40, y - 50) < 30.0; }, 8);
  Work one;
  one.threads = 1;
  Work three;
  three.threads = 3;
  EXPECT_EQ(find_contours(image, {}, one)->strength, find_contours(image, {}, three)->strength);
}

TEST(Contours, RefuseTooSmallPicturesAndInvalidSamples) {
  EXPECT_EQ(find_contours(drawn(4, [](double, double) { return true; }), {}, Work{}).error().code,
            ErrorCode::invalid_input);
  Image holed = step(16, 0.0, 0.0);
  holed.samples[20] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(find_contours(holed, {}, Work{}).error().code, ErrorCode::invalid_input);
  ContourOptions options;
  options.threshold = 1.5;
  EXPECT_EQ(find_contours(step(16, 0.0, 0.0), options, Work{}).error().code, ErrorCode::usage);
}

TEST(ReducedPicture, KeepsProportionsAndMeans) {
  Image ramp{400, 200, 2, 8, {}};
  for (int i = 0; i < 400 * 200; ++i)
    ramp.samples.insert(ramp.samples.end(), {static_cast<float>(i % 400) / 399.0F, 0.25F});
  const auto small = reduced(ramp, 20000);
  ASSERT_TRUE(small);
  EXPECT_EQ(small->width, 200);
  EXPECT_EQ(small->height, 100);
  EXPECT_NEAR(small->pixel(50, 70)[0], 100.5F / 399.0F, 1e-5F);
  EXPECT_NEAR(small->pixel(50, 70)[1], 0.25F, 1e-6F);
  EXPECT_FALSE(reduced(ramp, 80000)) << "it is small enough";
}

TEST(OtsuThreshold, SplitsTwoLevels) {
  Raster<float> values(10, 10, 0.1F);
  for (int y = 0; y < 4; ++y)
    for (float& v : values.row(y)) v = 0.8F;
  const double t = otsu_threshold(values);
  EXPECT_GT(t, 0.1);
  EXPECT_LE(t, 0.8);
}

}  // namespace
}  // namespace palpable::vision
