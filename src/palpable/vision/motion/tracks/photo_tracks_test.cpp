// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/photo_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

// Smoothed noise as a camera sees it that is turned by `angle` about its axis and `zoom` times nearer.
Raster<std::uint8_t> seen(double angle, double zoom) {
  cv::Mat noise(480, 480, CV_8U);
  std::mt19937 random(9);
  for (int y = 0; y < noise.rows; ++y)
    for (int x = 0; x < noise.cols; ++x)
      noise.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random() % 256U);
  cv::GaussianBlur(noise, noise, {}, 3.0);
  cv::normalize(noise, noise, 0, 255, cv::NORM_MINMAX);
  Raster<std::uint8_t> out(480, 480);
  cv::Mat view(480, 480, CV_8U, out.data());
  cv::warpAffine(noise, view, cv::getRotationMatrix2D({239.5F, 239.5F}, angle, zoom), view.size());
  return out;
}

ImagePoint moved(ImagePoint p, double angle, double zoom) {
  const cv::Mat m = cv::getRotationMatrix2D({239.5F, 239.5F}, angle, zoom);
  return {m.at<double>(0, 0) * p.x + m.at<double>(0, 1) * p.y + m.at<double>(0, 2),
          m.at<double>(1, 0) * p.x + m.at<double>(1, 1) * p.y + m.at<double>(1, 2)};
}

TEST(PhotoTracks, MatchesPicturesThatAreTurnedAndNearer) {
  const std::vector<Raster<std::uint8_t>> pictures{seen(0, 1), seen(40, 1.2), seen(85, 1.4)};
  const auto tracks = match_photos(pictures, {}, {});
  ASSERT_TRUE(tracks);
  int checked = 0, right = 0;
  for (const PointTrack& track : *tracks) {
    if (!track.in_frame(0) || !track.in_frame(2)) continue;
    const ImagePoint there = moved(track.in(0), 85, 1.4);
    ++checked, right += std::hypot(there.x - track.in(2).x, there.y - track.in(2).y) < 1.5 ? 1 : 0;
  }
  EXPECT_GT(checked, 50);
  EXPECT_GT(right, 95 * checked / 100);
}

TEST(PhotoTracks, SaysWhichPicturesDoNotShowAPoint) {
  // The middle picture shows something else.
  Raster<std::uint8_t> other(480, 480);
  std::fill(other.values().begin(), other.values().end(), std::uint8_t{90});
  const std::vector<Raster<std::uint8_t>> pictures{seen(0, 1), other, seen(20, 1)};
  const auto tracks = match_photos(pictures, {}, {});
  ASSERT_TRUE(tracks);
  ASSERT_FALSE(tracks->empty());
  for (const PointTrack& track : *tracks) {
    EXPECT_TRUE(track.in_frame(0));
    EXPECT_FALSE(track.in_frame(1));
    EXPECT_TRUE(track.in_frame(2));
  }
}

TEST(PhotoTracks, FindsNothingInEmptyPictures) {
  std::vector<Raster<std::uint8_t>> pictures(2, Raster<std::uint8_t>(64, 64));
  const auto tracks = match_photos(pictures, {}, {});
  ASSERT_TRUE(tracks);
  EXPECT_TRUE(tracks->empty());
}

}  // namespace
}  // namespace palpable::vision
