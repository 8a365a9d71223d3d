// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/figure.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/draw/canvas/sheet.hpp"
#include "palpable/draw/canvas/test_pixels.hpp"
#include "palpable/draw/view/force_view.hpp"
#include "palpable/draw/view/height_view.hpp"
#include "palpable/draw/view/section_view.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace palpable::draw {
namespace {

/// A temporary folder for each test, removed at the end.
class Figures : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("palpable-draw-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

/// A hill and a step: 100 x 75 mm, 15 mm high.
models::Relief hill() {
  Raster<float> height(160, 120);
  for (int y = 0; y < height.height(); ++y)
    for (int x = 0; x < height.width(); ++x) {
      const double r = std::hypot(x - 60.0, y - 50.0) / 35.0;
      height(x, y) = static_cast<float>(0.012 * std::exp(-r * r) + (x > 120 ? 0.005 : 0.0));
    }
  return *models::Relief::from_samples(std::move(height), 0.1 / 160);
}

TEST_F(Figures, AreWrittenInTheFormatOfTheExtension) {
  const auto relief = hill();
  const Figure figure = relief_figure(relief, {"A hill", "100 × 75 mm"});
  const std::pair<const char*, std::string> cases[] = {
      {"a.png", "\x89PNG"}, {"a.svg", "<?xml"}, {"a.pdf", "%PDF"}};
  for (const auto& [name, start] : cases) {
    ASSERT_TRUE(write_figure(figure, folder_ / name)) << name;
    const auto bytes = read_file_start(folder_ / name, start.size());
    ASSERT_TRUE(bytes);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), start);
  }
}

TEST_F(Figures, RefuseAnUnknownExtensionAndLeaveNoFile) {
  const auto relief = hill();
  const auto written = write_figure(relief_figure(relief, {}), folder_ / "a.xyz");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::usage);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Figures, NameAMissingFolderInTheError) {
  const auto relief = hill();
  const auto written = write_figure(relief_figure(relief, {}), folder_ / "none" / "a.png");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().sentence().find("none"), std::string::npos);
}

TEST(ReliefFigure, IsBrighterOnTheSlopeThatFacesTheLight) {
  const auto relief = hill();
  const Figure figure = relief_figure(relief, {});
  const Sheet sheet = sheet_for(relief.size_x_m() / relief.size_y_m());
  const auto place = [&sheet](double x, double y) {
    return CanvasPoint{sheet.plot.x + x / 160.0 * sheet.plot.width,
                       sheet.plot.y + y / 120.0 * sheet.plot.height};
  };
  EXPECT_GT(luma(colour_at(figure, place(47, 37))), luma(colour_at(figure, place(73, 63))) + 40.0);
}

TEST(HeightFigure, IsPaleWhereItIsHigh) {
  const auto relief = hill();
  const Figure figure = height_figure(relief, {});
  const Sheet sheet = sheet_for(relief.size_x_m() / relief.size_y_m());
  const CanvasPoint top{sheet.plot.x + 60.5 / 160.0 * sheet.plot.width,
                        sheet.plot.y + 50.5 / 120.0 * sheet.plot.height};
  const CanvasPoint flat{sheet.plot.x + 0.05 * sheet.plot.width, sheet.plot.y + 0.06 * sheet.plot.height};
  EXPECT_GT(luma(colour_at(figure, top)), luma(colour_at(figure, flat)) + 100.0);
}

TEST(ForceFigure, DrawsAnArrowOnlyWhereThereIsAForce) {
  const auto relief = hill();
  const std::vector<ForceArrow> arrows{{-0.02, 0.0, 1.0, 0.0}, {0.02, 0.0, 0.0, 0.0}};
  const Figure figure = force_figure(relief, Raster<Rgb8>(4, 3, {255, 255, 255}), arrows, 0.01, {});
  const Sheet sheet = sheet_for(relief.size_x_m() / relief.size_y_m());
  const auto place = [&sheet](double x_mm) {
    return CanvasPoint{sheet.plot.x + (x_mm + 50.0) / 100.0 * sheet.plot.width,
                       sheet.plot.y + sheet.plot.height / 2.0};
  };
  EXPECT_LT(luma(colour_at(figure, place(-20.0))), 150.0);
  EXPECT_GT(luma(colour_at(figure, place(20.0))), 250.0);
}

TEST(SectionFigure, FillsBelowTheProfileOnly) {
  const auto relief = hill();
  const Figure figure = section_figure(relief, 0.0125, {});
  const Rgb8 inside = colour_at(figure, {92.0 + 60.0 / 160.0 * 900.0, 300.0});
  const Rgb8 outside = colour_at(figure, {92.0 + 5.0 / 160.0 * 900.0, 150.0});
  EXPECT_LT(luma(inside), 200.0);
  EXPECT_GT(luma(outside), 210.0);
}

}  // namespace
}  // namespace palpable::draw
