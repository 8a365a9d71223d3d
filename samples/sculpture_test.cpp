// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "sculpture.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace palpable::samples {
namespace {

const std::filesystem::path kFolder(PALPABLE_SAMPLES);

/// Enough rows to include every object of the scene; rendering the whole pictures takes half a minute.
constexpr int kEvery = 48;

TEST(Sculpture, PicturesAreWhatTheCodeRenders) {
  const View view = sculpture_view();
  for (const auto& [eye, name] :
       {std::pair{Eye::left, "sculpture_left.png"}, {Eye::right, "sculpture_right.png"}}) {
    const auto image = sources::read_picture(kFolder / name);
    ASSERT_TRUE(image) << image.error().sentence();
    const Raster<Rgb8> committed = rgb8(*image);
    ASSERT_EQ(committed.height(), view.rig.left.height);
    for (int y = 20; y < committed.height(); y += kEvery)
      EXPECT_TRUE(std::ranges::equal(render_row(view, eye, y), committed.row(y))) << name << " row " << y;
  }
}

TEST(Sculpture, LabelsAreWhatTheCodeSees) {
  const View view = sculpture_view();
  const auto committed = sources::read_picture(kFolder / "sculpture_labels.png");
  ASSERT_TRUE(committed) << committed.error().sentence();
  ASSERT_EQ(committed->channels, 1);
  ASSERT_EQ(committed->height, view.rig.left.height);
  for (int y = 20; y < view.rig.left.height; y += kEvery) {
    const auto row = label_row(view, y);
    for (int x = 0; x < view.rig.left.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * row.size() + static_cast<std::size_t>(x);
      ASSERT_EQ(std::lround(255.0F * committed->samples[at]), row[static_cast<std::size_t>(x)])
          << x << " " << y;
    }
  }
}

TEST(Sculpture, DisparityIsWhatTheCodeFinds) {
  const View view = sculpture_view();
  const auto committed = sources::read_disparity(kFolder / "sculpture_disparity.png", 1.0 / 256,
                                                 sources::UnknownDisparity::zero_too);
  ASSERT_TRUE(committed) << committed.error().sentence();
  EXPECT_EQ(committed->unknown, 0U);
  for (int y = 20; y < view.rig.left.height; y += kEvery) {
    const auto row = disparity_row(view, y);
    for (int x = 0; x < view.rig.left.width; ++x)
      ASSERT_NEAR(row[static_cast<std::size_t>(x)], committed->disparity.disparity_px(x, y), 0.5001 / 256)
          << x << " " << y;
  }
}

TEST(Sculpture, CalibrationFileStatesTheCameraOfTheCode) {
  const auto calibration = sources::read_calibration(kFolder / "sculpture_calib.txt");
  ASSERT_TRUE(calibration) << calibration.error().sentence();
  const View view = sculpture_view();
  EXPECT_EQ(calibration->rig->left, view.rig.left);
  EXPECT_DOUBLE_EQ(calibration->rig->baseline_m, view.rig.baseline_m);
  EXPECT_EQ(calibration->rig->doffs_px, view.rig.doffs_px);
}

TEST(Sculpture, DisparityAgreesWithSolidsKnownInClosedForm) {
  const View view = sculpture_view();
  // The table without objects, at the lower left corner of the picture.
  EXPECT_NEAR(disparity_row(view, 470)[5], table_disparity_px(view, 5, 470), 1e-4);
  // The ball: centre and radius as the scene states them; its nearest point lies on the line to its centre.
  const Vec3 centre{-0.175, 0.105, 0.042};
  const Vec3 to_centre = centre - view.position;
  const double z = dot(to_centre, view.forward);
  const Pinhole& c = view.rig.left;
  const int x = static_cast<int>(std::lround(c.cx + c.fx * dot(to_centre, view.right) / z));
  const int y = static_cast<int>(std::lround(c.cy + c.fy * dot(to_centre, view.down) / z));
  const Vec3 ray = unit((x - c.cx) / c.fx * view.right + (y - c.cy) / c.fy * view.down + view.forward);
  const double along = dot(to_centre, ray);
  const double t = along - std::sqrt(along * along - squared_norm(to_centre) + 0.042 * 0.042);
  EXPECT_NEAR(disparity_row(view, y)[static_cast<std::size_t>(x)],
              view.rig.baseline_m * c.fx / (t * dot(ray, view.forward)), 1e-4);
}

TEST(Sculpture, ShowsTheSamePointInBothPictures) {
  const auto left = sources::read_picture(kFolder / "sculpture_left.png");
  const auto right = sources::read_picture(kFolder / "sculpture_right.png");
  ASSERT_TRUE(left && right);
  const auto truth = sources::read_disparity(kFolder / "sculpture_disparity.png", 1.0 / 256,
                                             sources::UnknownDisparity::zero_too);
  const Raster<float> l = grey(*left);
  const Raster<float> r = grey(*right);
  int compared = 0;
  int close = 0;
  for (int y = 0; y < l.height(); y += 3)
    for (int x = 80; x < l.width(); x += 3) {
      const float at = static_cast<float>(x) - truth->disparity.disparity_px(x, y);
      const int x0 = static_cast<int>(std::floor(at));
      if (x0 < 0) continue;
      const float f = at - static_cast<float>(x0);
      const float there = (1.0F - f) * r(x0, y) + f * r(std::min(x0 + 1, r.width() - 1), y);
      ++compared;
      close += std::abs(there - l(x, y)) < 0.08F ? 1 : 0;
    }
  EXPECT_GT(close, compared * 9 / 10);
}

}  // namespace
}  // namespace palpable::samples
