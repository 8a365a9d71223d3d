// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/colours/map_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <unordered_map>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// The histogram's bins: 64 values a channel.
constexpr int kShift = 2;
constexpr int kBins = 256 >> kShift;

std::size_t bin_of(int r, int g, int b) { return static_cast<std::size_t>((r * kBins + g) * kBins + b); }

int difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The pixels of a picture that lie in a frame: 255 there.
cv::Mat inside_of(const MapFrame& frame, int width, int height) {
  if (!frame.on_page) return {height, width, CV_8U, cv::Scalar(255)};
  cv::Mat mask = cv::Mat::zeros(height, width, CV_8U);
  std::vector<cv::Point> corners;
  for (const MapPoint c : frame.corners)
    corners.emplace_back(static_cast<int>(std::lround(c.x)), static_cast<int>(std::lround(c.y)));
  cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  return mask;
}

/// The differences of horizontal neighbours that are no edges.
struct SmallDifferences {
  /// From 0 to the least difference of an edge.
  std::vector<std::size_t> counts;
  std::size_t all = 0;

  /// The least difference that `part` of those from `first` on do not exceed.
  int quantile(double part, std::size_t first) const {
    std::size_t below = 0;
    for (std::size_t d = 0; d < first; ++d) below += counts[d];
    const double wanted = part * static_cast<double>(all - below);
    std::size_t sum = 0;
    for (std::size_t d = first; d < counts.size(); ++d)
      if (static_cast<double>(sum += counts[d]) >= wanted) return static_cast<int>(d);
    return static_cast<int>(counts.size()) - 1;
  }
};

SmallDifferences small_differences(const Raster<Rgb8>& picture, const MapColourOptions& options) {
  SmallDifferences out;
  out.counts.resize(static_cast<std::size_t>(std::max(2, options.least_edge)) + 1);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 1; x < picture.width(); ++x) {
      const int d = difference(picture(x, y), picture(x - 1, y));
      if (d > options.least_edge) continue;
      ++out.counts[static_cast<std::size_t>(d)];
      ++out.all;
    }
  return out;
}

/// Typical difference between neighbours inside flat areas: the median difference. 0 for a clean drawing.
double noise_of(const Raster<Rgb8>& picture, const MapColourOptions& options) {
  return small_differences(picture, options).quantile(0.5, 0);
}

/// Whether a picture has the noise of a scan or of lossy compression, which may be near edges only: many
/// neighbours differ, and most of these by little.
bool is_noisy(const Raster<Rgb8>& picture, const MapColourOptions& options) {
  const SmallDifferences differences = small_differences(picture, options);
  const auto same = static_cast<double>(differences.counts[0]);
  return same < (1.0 - options.noisy_part) * static_cast<double>(differences.all) &&
         differences.quantile(0.5, 1) <= options.most_noise;
}

/// Whether a picture is a drawing that was never compressed with loss: hardly any neighbours differ by one or
/// two levels.
bool is_clean(const Raster<Rgb8>& picture, const MapColourOptions& options) {
  const SmallDifferences differences = small_differences(picture, options);
  const auto least = static_cast<double>(differences.counts[1] + differences.counts[2]);
  const auto differing = static_cast<double>(differences.all - differences.counts[0]);
  return differences.quantile(0.5, 0) == 0 && least <= options.lossy_part * differing;
}

/// Without noise; edges stay.
Raster<Rgb8> without_noise(const Raster<Rgb8>& picture, const MapColourOptions& options) {
  const cv::Mat view(picture.height(), picture.width(), CV_8UC3,
                     const_cast<void*>(static_cast<const void*>(picture.data())));
  Raster<Rgb8> out(picture.width(), picture.height());
  cv::Mat smooth(picture.height(), picture.width(), CV_8UC3, out.data());
  cv::Mat before = view;
  for (int round = 0; round < options.noise_rounds; ++round) {
    cv::Mat after;
    cv::bilateralFilter(before, after, 0, options.noise_difference, options.noise_reach_px);
    before = after;
  }
  before.copyTo(smooth);
  return out;
}

/// Finds the most frequent colours, the most frequent first; each takes the pixels around it.
std::vector<MapColour> peaks_of(const Raster<Rgb8>& picture, const cv::Mat& inside, double tolerance,
                                const MapColourOptions& options) {
  std::vector<int> histogram(bin_of(kBins - 1, kBins - 1, kBins - 1) + 1, 0);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      if (const Rgb8 c = picture(x, y); inside.at<std::uint8_t>(y, x) != 0)
        ++histogram[bin_of(c.r >> kShift, c.g >> kShift, c.b >> kShift)];
  const double least = options.least_part * static_cast<double>(picture.count());
  const int reach = std::max(1, static_cast<int>(std::ceil(tolerance)) >> kShift);
  std::vector<MapColour> found;
  while (found.size() < static_cast<std::size_t>(options.most_colours)) {
    const auto top = std::max_element(histogram.begin(), histogram.end());
    const int at = static_cast<int>(top - histogram.begin());
    const int r = at / (kBins * kBins);
    const int g = (at / kBins) % kBins;
    const int b = at % kBins;
    double sum = 0.0;
    std::array<double, 3> mean{};
    const auto around = [&](auto&& use) {
      for (int i = std::max(0, r - reach); i <= std::min(kBins - 1, r + reach); ++i)
        for (int j = std::max(0, g - reach); j <= std::min(kBins - 1, g + reach); ++j)
          for (int k = std::max(0, b - reach); k <= std::min(kBins - 1, b + reach); ++k)
            use(i, j, k, histogram[bin_of(i, j, k)]);
    };
    around([&](int i, int j, int k, int n) {
      sum += n;
      mean[0] += n * (i + 0.5);
      mean[1] += n * (j + 0.5);
      mean[2] += n * (k + 0.5);
    });
    if (sum < least) break;
    const auto level = [&](double m) {
      return static_cast<std::uint8_t>(std::clamp(std::lround(m / sum * (1 << kShift) - 0.5), 0L, 255L));
    };
    found.push_back({{level(mean[0]), level(mean[1]), level(mean[2])}, 0});
    around([&](int i, int j, int k, int) { histogram[bin_of(i, j, k)] = 0; });
  }
  return found;
}

/// Finds the colours of the flat places of a clean drawing, the most frequent first: pixels that have the
/// colour of their neighbours, so that the blends at edges count for nothing.
std::vector<MapColour> flat_colours_of(const Raster<Rgb8>& picture, const cv::Mat& inside,
                                       const MapColourOptions& options) {
  const auto key = [](Rgb8 c) { return (c.r << 16) | (c.g << 8) | c.b; };
  std::unordered_map<int, int> counts;
  for (int y = 1; y + 1 < picture.height(); ++y)
    for (int x = 1; x + 1 < picture.width(); ++x) {
      const Rgb8 c = picture(x, y);
      const auto is_same = [&](int dx, int dy) { return difference(c, picture(x + dx, y + dy)) <= 1; };
      if (inside.at<std::uint8_t>(y, x) != 0 && is_same(-1, 0) && is_same(1, 0) && is_same(0, -1) &&
          is_same(0, 1))
        ++counts[key(c)];
    }
  std::vector<std::pair<int, int>> sorted;
  for (const auto& [colour, n] : counts) sorted.emplace_back(-n, colour);
  std::sort(sorted.begin(), sorted.end());
  const double least = options.least_part * static_cast<double>(picture.count());
  std::vector<MapColour> found;
  for (const auto& [n, colour] : sorted) {
    const Rgb8 value{static_cast<std::uint8_t>(colour >> 16), static_cast<std::uint8_t>(colour >> 8 & 255),
                     static_cast<std::uint8_t>(colour & 255)};
    const bool is_known = std::any_of(found.begin(), found.end(), [&](const MapColour& other) {
      return difference(value, other.value) <= options.least_apart;
    });
    if (is_known) continue;
    if (-n < least || found.size() == static_cast<std::size_t>(options.most_colours)) break;
    found.push_back({value, 0});
  }
  return found;
}

/// Area of the largest connected piece, pixels.
int largest_piece(const cv::Mat& mask) {
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  int most = 0;
  for (int i = 1; i < n; ++i) most = std::max(most, stats.at<int>(i, cv::CC_STAT_AREA));
  return most;
}

/// Adds to `mask`, the thick parts of `all`, its thin parts that are long: narrow streets, not lettering.
void add_thin_lines(const cv::Mat& all, cv::Mat& mask, const MapColourOptions& options) {
  cv::Mat thick;
  cv::dilate(mask, thick, cv::Mat());
  const cv::Mat thin = all & ~thick;
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(thin, labels, stats, centres, 8);
  std::vector<bool> is_long(static_cast<std::size_t>(n), false);
  for (int i = 1; i < n; ++i)
    is_long[static_cast<std::size_t>(i)] =
        std::hypot(stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)) >=
        options.thin_length_px;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (is_long[static_cast<std::size_t>(labels.at<int>(y, x))]) mask.at<std::uint8_t>(y, x) = 255;
}

}  // namespace

MapColours find_map_colours(const Raster<Rgb8>& given, const MapColourOptions& options) {
  MapColours out;
  const bool has_noise = is_noisy(given, options);
  out.picture = has_noise ? without_noise(given, options) : given;
  const Raster<Rgb8>& picture = out.picture;
  const bool is_drawing = !has_noise && is_clean(given, options);
  const double tolerance = options.tolerance + options.noise_tolerance * noise_of(picture, options);
  const int width = picture.width();
  const int height = picture.height();
  out.frame = find_map_frame(given, options.frame);
  const cv::Mat inside = inside_of(out.frame, width, height);
  std::vector<MapColour> peaks =
      is_drawing ? flat_colours_of(picture, inside, options) : peaks_of(picture, inside, tolerance, options);
  cv::Mat nearest(height, width, CV_8U, cv::Scalar(MapColours::kNone));
  const int most = static_cast<int>(std::lround(tolerance));
  for (int y = 0; y < height; ++y) {
    auto* row = nearest.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x) {
      if (inside.at<std::uint8_t>(y, x) == 0) continue;
      int best = most + 1;
      for (std::size_t k = 0; k < peaks.size(); ++k)
        if (const int d = difference(picture(x, y), peaks[k].value); d < best) {
          best = d;
          row[x] = static_cast<std::uint8_t>(k);
        }
    }
  }
  out.seen = Raster<std::uint8_t>(width, height);
  cv::Mat seen(height, width, CV_8U, out.seen.data());
  std::array<std::uint8_t, 256> index{};
  const cv::Mat block = cv::getStructuringElement(cv::MORPH_RECT, {options.thinnest_px, options.thinnest_px});
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const cv::Mat all = nearest == static_cast<double>(k);
    cv::Mat mask;
    cv::morphologyEx(all, mask, cv::MORPH_OPEN, block);
    peaks[k].pixels = cv::countNonZero(mask);
    const double least = options.least_part * static_cast<double>(picture.count());
    if (peaks[k].pixels < std::max(least, options.least_thick_part * cv::countNonZero(all))) continue;
    if (largest_piece(mask) < options.symbol_part * static_cast<double>(picture.count())) continue;
    seen.setTo(MapColours::kArea, mask);
    add_thin_lines(all, mask, options);
    seen.setTo(MapColours::kThinLine, mask & (seen == 0));
    index[k] = static_cast<std::uint8_t>(out.colours.size());
    out.colours.push_back(peaks[k]);
  }
  out.of_pixel = Raster<std::uint8_t>(width, height, MapColours::kNone);
  if (out.colours.empty()) return out;
  constexpr std::uint8_t kPage = 254;
  if (out.frame.on_page) {
    out.page = static_cast<std::uint8_t>(out.colours.size());
    out.colours.push_back({picture(0, 0), 0});
    const cv::Mat outside = inside == 0;
    nearest.setTo(kPage, outside);
    seen.setTo(MapColours::kArea, outside);
    index[kPage] = out.page;
  }
  cv::Mat distance, label;
  cv::Mat away = seen == 0;
  cv::distanceTransform(away, distance, label, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<std::uint8_t> colour_of(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + 1,
                                      0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (seen.at<std::uint8_t>(y, x) != 0)
        colour_of[static_cast<std::size_t>(label.at<int>(y, x))] = index[nearest.at<std::uint8_t>(y, x)];
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.of_pixel(x, y) = colour_of[static_cast<std::size_t>(label.at<int>(y, x))];
  return out;
}

}  // namespace palpable::vision
