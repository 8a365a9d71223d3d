// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/zbuffer.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

constexpr double kNear = 0.1;
constexpr double kFar = 40.0;

/// The value that a renderer writes for depth Z, computed from the projection matrices: clip coordinates,
/// then division.
double opengl_ndc(double z) {
  const double a = -(kFar + kNear) / (kFar - kNear);
  const double b = -2.0 * kFar * kNear / (kFar - kNear);
  return (a * -z + b) / z;
}
double direct3d(double z) { return (kFar / (kFar - kNear) * z - kFar * kNear / (kFar - kNear)) / z; }
double reversed(double z) { return (-kNear / (kFar - kNear) * z + kFar * kNear / (kFar - kNear)) / z; }

TEST(ZBuffer, IsLinearisedAsTheProjectionsWroteIt) {
  ZBuffer buffer;
  buffer.near_m = kNear;
  buffer.far_m = kFar;
  for (const double z : {0.1001, 0.2, 1.0, 7.5, 39.0}) {
    const auto one = [&](double value, const ZBuffer& b) {
      return static_cast<double>(
          (*linearise_zbuffer(Raster<float>(1, 1, static_cast<float>(value)), b))(0, 0));
    };
    // The resolution of floats near the far plane is low: the tolerance follows from dZ/dz.
    const double tolerance = 2e-7 * z * z * (kFar - kNear) / (kNear * kFar) + 1e-6;
    EXPECT_NEAR(one(direct3d(z), buffer), z, tolerance);
    EXPECT_NEAR(one(0.5 * opengl_ndc(z) + 0.5, buffer), z, tolerance) << "OpenGL's window depth";
    ZBuffer other = buffer;
    other.range = ZBuffer::Range::minus_one_to_one;
    EXPECT_NEAR(one(opengl_ndc(z), other), z, 2 * tolerance);
    other = buffer;
    other.order = ZBuffer::Order::near_is_large;
    EXPECT_NEAR(one(reversed(z), other), z, tolerance);
    other = buffer;
    other.far_m = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(one(1.0 - kNear / z, other), z, tolerance * 1.1);
    other = buffer;
    other.projection = ZBuffer::Projection::orthographic;
    EXPECT_NEAR(one((z - kNear) / (kFar - kNear), other), z, 1e-5);
  }
}

TEST(ZBuffer, KnowsNothingWhereNothingWasDrawn) {
  ZBuffer buffer;
  buffer.near_m = kNear;
  buffer.far_m = kFar;
  Raster<float> values(4, 1);
  values(0, 0) = 1.0F;
  values(1, 0) = 1.5F;
  values(2, 0) = -0.5F;
  values(3, 0) = std::numeric_limits<float>::quiet_NaN();
  const auto empty = linearise_zbuffer(values, buffer);
  for (const float z : empty->values()) EXPECT_TRUE(std::isnan(z));
  buffer.far_plane = ZBuffer::FarPlane::is_a_surface;
  EXPECT_NEAR((*linearise_zbuffer(values, buffer))(0, 0), kFar, 1e-4);
}

TEST(ZBuffer, WithImpossiblePlanesIsRefused) {
  const Raster<float> values(1, 1, 0.5F);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [near, far] :
       {std::pair{0.0, 1.0}, {-1.0, 1.0}, {2.0, 1.0}, {1.0, 1.0}, {nan, 1.0}, {1.0, nan}}) {
    ZBuffer buffer;
    buffer.near_m = near;
    buffer.far_m = far;
    const auto depth = linearise_zbuffer(values, buffer);
    ASSERT_FALSE(depth) << near << " " << far;
    EXPECT_EQ(depth.error().code, ErrorCode::usage);
  }
  ZBuffer flat;
  flat.near_m = 1.0;
  flat.far_m = infinite;
  flat.projection = ZBuffer::Projection::orthographic;
  EXPECT_FALSE(linearise_zbuffer(values, flat));
}

}  // namespace
}  // namespace palpable::sources
