// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/street_map_from_picture.hpp"

#include "palpable/core/geometry/segment.hpp"
#include "palpable/vision/streets/drawn_map.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

double distance_to_map(const StreetMap& map, MapPoint p) {
  double least = 1e9;
  for (const MapStreet& street : map.streets)
    for (std::size_t i = 1; i < street.points.size(); ++i)
      least = std::min(least, distance_to_segment(p, street.points[i - 1], street.points[i]));
  return least;
}

const std::vector<DrawnStreet>& crossing() {
  static const std::vector<DrawnStreet> streets{
      {{{0, 120}, {399, 150}}}, {{{200, 0}, {190, 399}}}, {{{195, 250}, {330, 320}}}};
  return streets;
}

/// Part of the drawn streets' length whose centre line was found within two pixels.
double found_part(const StreetMap& map, const std::vector<DrawnStreet>& streets) {
  int found = 0;
  int all = 0;
  for (const DrawnStreet& s : streets)
    for (std::size_t i = 1; i < s.points.size(); ++i)
      for (int k = 0; k <= 100; ++k) {
        const double t = k / 100.0;
        const MapPoint p{s.points[i - 1].x + t * (s.points[i].x - s.points[i - 1].x),
                         s.points[i - 1].y + t * (s.points[i].y - s.points[i - 1].y)};
        ++all;
        found += distance_to_map(map, p) <= 2.0 ? 1 : 0;
      }
  return static_cast<double>(found) / all;
}

TEST(StreetMapFromPicture, FindsCentreLinesAndJunctionsInStylesThatDifferInColour) {
  const std::vector<DrawnStyle> styles{{},
                                       {{255, 255, 255}, {255, 220, 120}, {190, 140, 60}, {225, 225, 225}},
                                       {{40, 44, 52}, {110, 110, 120}, {70, 70, 80}, {58, 62, 70}},
                                       {{232, 232, 228}, {250, 160, 130}, {200, 100, 80}, {200, 190, 210}}};
  for (const DrawnStyle& style : styles) {
    const auto found = street_map_from_picture(drawn_map(crossing(), style), {}, Work{});
    ASSERT_TRUE(found) << style.street;
    const StreetMap* map = &found->map;
    EXPECT_GT(found_part(*map, crossing()), 0.97) << style.street;
    ASSERT_EQ(map->junctions.size(), 2U) << style.street;
    std::vector<int> degrees{map->junctions[0].degree, map->junctions[1].degree};
    std::sort(degrees.begin(), degrees.end());
    EXPECT_EQ(degrees, (std::vector<int>{3, 4})) << style.street;
    for (const MapStreet& street : map->streets) EXPECT_NEAR(street.width_px, 15.0, 3.0);
  }
}

TEST(StreetMapFromPicture, ClosesTheGapThatLetteringLeaves) {
  Image picture = drawn_map({{{{0, 200}, {399, 200}}, 8}});
  cv::Mat canvas(400, 400, CV_32FC3, picture.samples.data());
  cv::putText(canvas, "Some Street", {120, 204}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {1, 1, 1}, 3, cv::LINE_AA);
  cv::putText(canvas, "Some Street", {120, 204}, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0.1, 0.1, 0.1}, 1,
              cv::LINE_AA);
  const auto found = street_map_from_picture(picture, {}, Work{});
  ASSERT_TRUE(found);
  EXPECT_GT(found_part(found->map, {{{{0, 200}, {399, 200}}}}), 0.95);
}

TEST(StreetMapFromPicture, GivesAStreetItsNameAndItsStraightContinuation) {
  Image picture = drawn_map({{{{0, 200}, {699, 200}}, 24}, {{{450, 0}, {450, 699}}, 24}}, {}, 700);
  cv::Mat canvas(700, 700, CV_32FC3, picture.samples.data());
  cv::putText(canvas, "Station Road", {120, 206}, cv::FONT_HERSHEY_DUPLEX, 0.6, {0.1, 0.1, 0.1}, 1,
              cv::LINE_AA);
  const auto found = street_map_from_picture(picture, {}, Work{});
  ASSERT_TRUE(found);
  if (!found->notes.empty()) GTEST_SKIP() << found->notes.front().sentence;
  int named = 0;
  for (const MapStreet& street : found->map.streets) {
    const bool across = std::abs(street.points.front().y - street.points.back().y) < 40;
    EXPECT_EQ(street.name, across ? "Station Road" : "") << street.points.front().x;
    named += across ? 1 : 0;
  }
  EXPECT_EQ(named, 2);
  ASSERT_EQ(found->map.labels.size(), 1U);
  EXPECT_TRUE(found->map.labels[0].names_street);
  EXPECT_NEAR(found->map.labels[0].angle_deg, 0.0, 3.0);
}

TEST(StreetMapFromPicture, RefusesStripesInAPhotograph) {
  Image picture = drawn_map({{{{0, 200}, {399, 230}}}, {{{200, 0}, {190, 399}}}});
  ASSERT_TRUE(street_map_from_picture(picture, {}, Work{}));
  std::mt19937 random(7);
  std::normal_distribution<float> grain(0.0F, 0.012F);
  // With the shades of a photograph.
  for (std::size_t i = 0; i < picture.samples.size(); ++i) {
    const auto x = static_cast<float>(i / 3 % 400);
    const float shade = 0.5F + 0.4F * x / 400.0F;
    picture.samples[i] = std::clamp(shade * picture.samples[i] + grain(random), 0.0F, 1.0F);
  }
  EXPECT_FALSE(street_map_from_picture(picture, {}, Work{}));
}

TEST(StreetMapFromPicture, FindsStreetsInANoisyScan) {
  Image picture = drawn_map(crossing());
  std::mt19937 random(7);
  std::normal_distribution<float> grain(0.0F, 0.015F);
  for (float& v : picture.samples) v = std::clamp(v + grain(random), 0.0F, 1.0F);
  const auto found = street_map_from_picture(picture, {}, Work{});
  ASSERT_TRUE(found);
  EXPECT_GT(found_part(found->map, crossing()), 0.95);
}

TEST(StreetMapFromPicture, FindsBlueStreetsOnAMapForTheNight) {
  const DrawnStyle night{{29, 44, 77}, {70, 92, 132}, {20, 32, 60}, {38, 54, 90}};
  const auto found = street_map_from_picture(drawn_map(crossing(), night), {}, Work{});
  ASSERT_TRUE(found);
  EXPECT_GT(found_part(found->map, crossing()), 0.97);
}

TEST(StreetMapFromPicture, RefusesRampsStripesAndRings) {
  constexpr int kCleanSide = 300;
  const auto grey = [](auto&& value) {
    Image image{kCleanSide, kCleanSide, 1, 8, {}};
    for (int y = 0; y < kCleanSide; ++y)
      for (int x = 0; x < kCleanSide; ++x) image.samples.push_back(static_cast<float>(value(x, y)));
    return image;
  };
  const Image ramp = grey([](int x, int) { return (x / 12) / 25.0; });
  const Image stripes = grey([](int x, int y) { return (x + y) / 12 % 3 / 2.0; });
  const Image rings =
      grey([](int x, int y) { return static_cast<int>(std::hypot(x - 150, y - 150)) / 10 % 2; });
  for (const Image& image : {ramp, stripes, rings}) EXPECT_FALSE(street_map_from_picture(image, {}, Work{}));
}

/// Of a canvas with channels r, g, b.
Image image_of(const cv::Mat& canvas) {
  Image out{canvas.cols, canvas.rows, 3, 8, {}};
  for (int y = 0; y < canvas.rows; ++y)
    for (int x = 0; x < canvas.cols; ++x)
      for (int c = 0; c < 3; ++c)
        out.samples.push_back(static_cast<float>(canvas.at<cv::Vec3b>(y, x)[c]) / 255.0F);
  return out;
}

TEST(StreetMapFromPicture, RefusesTablesBoxesAndSmoothRamps) {
  cv::Mat table(400, 500, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int y = 20; y <= 380; y += 45) cv::line(table, {30, y}, {450, y}, {0, 0, 0}, 2);
  for (int x = 30; x <= 450; x += 70) cv::line(table, {x, 20}, {x, 380}, {0, 0, 0}, 2);
  EXPECT_FALSE(street_map_from_picture(image_of(table), {}, Work{}));
  cv::Mat boxes(400, 500, CV_8UC3, cv::Scalar(255, 255, 255));
  const std::vector<cv::Point> places{{20, 30}, {300, 20}, {150, 130}, {350, 200}, {40, 260}, {240, 320}};
  for (std::size_t i = 1; i < places.size(); ++i)
    cv::line(boxes, places[i - 1] + cv::Point(50, 20), places[i] + cv::Point(50, 20), {0, 0, 0}, 3,
             cv::LINE_AA);
  for (const cv::Point p : places) {
    cv::rectangle(boxes, {p.x, p.y, 100, 40}, {255, 255, 255}, cv::FILLED);
    cv::rectangle(boxes, {p.x, p.y, 100, 40}, {0, 0, 0}, 3);
  }
  EXPECT_FALSE(street_map_from_picture(image_of(boxes), {}, Work{}));
  for (const int side : {200, 256, 512}) {
    Image ramp{side, side, 1, 8, {}};
    for (int i = 0; i < side * side; ++i)
      ramp.samples.push_back(static_cast<float>(255 * (i % side) / (side - 1)) / 255.0F);
    EXPECT_FALSE(street_map_from_picture(ramp, {}, Work{})) << side;
  }
}

TEST(StreetMapFromPicture, FindsAMapThatIsTurnedOnAPage) {
  const Image upright = drawn_map(crossing());
  cv::Mat canvas(400, 400, CV_32FC3, const_cast<float*>(upright.samples.data()));
  cv::Mat turn = cv::getRotationMatrix2D({199.5F, 199.5F}, 25.0, 1.0);
  turn.at<double>(0, 2) += 100.0;
  turn.at<double>(1, 2) += 100.0;
  cv::Mat page;
  cv::warpAffine(canvas, page, turn, {600, 600}, cv::INTER_CUBIC, cv::BORDER_CONSTANT, {1.0, 1.0, 1.0});
  page.convertTo(page, CV_8UC3, 255.0);
  const auto found = street_map_from_picture(image_of(page), {}, Work{});
  ASSERT_TRUE(found);
  std::vector<DrawnStreet> streets = crossing();
  for (DrawnStreet& street : streets)
    for (cv::Point& p : street.points)
      p = {static_cast<int>(std::lround(turn.at<double>(0, 0) * p.x + turn.at<double>(0, 1) * p.y +
                                        turn.at<double>(0, 2))),
           static_cast<int>(std::lround(turn.at<double>(1, 0) * p.x + turn.at<double>(1, 1) * p.y +
                                        turn.at<double>(1, 2)))};
  EXPECT_GT(found_part(found->map, streets), 0.95);
  EXPECT_EQ(found->map.junctions.size(), 2U);
}

TEST(StreetMapFromPicture, SeparatesBuildingsFromStreets) {
  const auto found = street_map_from_picture(drawn_map(crossing()), {}, Work{});
  ASSERT_TRUE(found);
  const auto buildings = std::count_if(found->map.areas.begin(), found->map.areas.end(),
                                       [](const MapArea& a) { return a.kind == MapArea::Kind::building; });
  EXPECT_GT(buildings, 50);
}

TEST(StreetMapFromPicture, RefusesPicturesWithoutStreets) {
  Image empty{200, 150, 3, 8, std::vector<float>(std::size_t{200} * 150 * 3, 1.0F)};
  EXPECT_FALSE(street_map_from_picture(empty, {}, Work{}));
  Image one{1, 1, 1, 8, {0.5F}};
  EXPECT_FALSE(street_map_from_picture(one, {}, Work{}));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> level(0.0F, 1.0F);
  Image noise = empty;
  for (float& v : noise.samples) v = level(random);
  const auto found = street_map_from_picture(noise, {}, Work{});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::vision
