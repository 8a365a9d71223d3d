// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/colour_segments.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

int difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

Raster<Rgb8> mean_shifted(const Raster<Rgb8>& picture, const SegmentOptions& options) {
  cv::Mat in(picture.height(), picture.width(), CV_8UC3);
  for (int y = 0; y < in.rows; ++y)
    for (int x = 0; x < in.cols; ++x)
      in.at<cv::Vec3b>(y, x) = {picture(x, y).r, picture(x, y).g, picture(x, y).b};
  cv::Mat out;
  cv::pyrMeanShiftFiltering(in, out, options.radius_px, options.colour_levels, 0);
  Raster<Rgb8> shifted(picture.width(), picture.height());
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) {
      const cv::Vec3b c = out.at<cv::Vec3b>(y, x);
      shifted(x, y) = {c[0], c[1], c[2]};
    }
  return shifted;
}

/// Union-find over pixels.
class Pieces {
 public:
  explicit Pieces(std::size_t pixels) : parent_(pixels), size_(pixels, 1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }
  int size(std::size_t i) { return size_[root(i)]; }

 private:
  std::vector<std::size_t> parent_;
  std::vector<int> size_;
};

void join_alike(const Raster<Rgb8>& colour, int same_levels, Pieces& pieces) {
  const auto width = static_cast<std::size_t>(colour.width());
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (colour.contains(x + 1, y) && difference(colour(x, y), colour(x + 1, y)) < same_levels)
        pieces.join(i, i + 1);
      if (colour.contains(x, y + 1) && difference(colour(x, y), colour(x, y + 1)) < same_levels)
        pieces.join(i, i + width);
    }
  }
}

/// One pass over the picture: each pixel of a small segment joins it to the neighbour of the most similar
/// colour.
void join_small(const Raster<Rgb8>& colour, int least_pixels, Pieces& pieces) {
  const auto width = static_cast<std::size_t>(colour.width());
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (pieces.size(i) >= least_pixels) continue;
      int nearest = std::numeric_limits<int>::max();
      std::size_t to = i;
      for (const auto [dx, dy] : kBeside) {
        if (!colour.contains(x + dx, y + dy)) continue;
        const std::size_t j = static_cast<std::size_t>(y + dy) * width + static_cast<std::size_t>(x + dx);
        const int apart = difference(colour(x, y), colour(x + dx, y + dy));
        if (pieces.root(j) != pieces.root(i) && apart < nearest) {
          nearest = apart;
          to = j;
        }
      }
      pieces.join(i, to);
    }
  }
}

}  // namespace

Result<ColourSegments> segment_by_colour(const Raster<Rgb8>& picture, const SegmentOptions& options) {
  try {
    const Raster<Rgb8> colour = mean_shifted(picture, options);
    Pieces pieces(picture.count());
    join_alike(colour, options.same_levels, pieces);
    join_small(colour, options.least_pixels, pieces);
    ColourSegments out{Raster<int>(picture.width(), picture.height()), 0};
    std::vector<int> number(picture.count(), -1);
    for (std::size_t i = 0; i < picture.count(); ++i) {
      int& n = number[pieces.root(i)];
      if (n < 0) n = out.count++;
      out.of_pixel.values()[i] = n;
    }
    return out;
  } catch (const cv::Exception& e) {
    return Error{
        ErrorCode::failed, std::string("the picture could not be cut into segments: ") + e.what(), {}};
  }
}

}  // namespace palpable::vision
