// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/video_segments.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

// CIELAB, smoothed but not across edges (Tomasi & Manduchi 1998): mixed colours along an edge would be a
// segment of their own.
cv::Mat lab_of(const Raster<Rgb8>& picture, const VideoSegmentOptions& options) {
  cv::Mat colours(picture.height(), picture.width(), CV_32FC3);
  for (int y = 0; y < colours.rows; ++y)
    for (int x = 0; x < colours.cols; ++x) {
      const Rgb8 p = picture(x, y);
      colours.at<cv::Vec3f>(y, x) = cv::Vec3f(p.r, p.g, p.b) / 255.0F;
    }
  cv::Mat lab;
  cv::cvtColor(colours, lab, cv::COLOR_RGB2Lab);
  if (options.smooth_px <= 0) return lab;
  cv::Mat out;
  cv::bilateralFilter(lab, out, -1, options.colour_levels, options.smooth_px);
  return out;
}

// Cells without a value get that of the nearest cell that has one, in steps to neighbours.
template <class T>
void fill_from_nearest(Raster<T>& values, Raster<std::uint8_t>& known) {
  std::deque<Pixel> open;
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x)
      if (known(x, y) != 0) open.push_back({x, y});
  while (!open.empty()) {
    const Pixel at = open.front();
    open.pop_front();
    for (const Pixel next :
         {Pixel{at.x + 1, at.y}, Pixel{at.x - 1, at.y}, Pixel{at.x, at.y + 1}, Pixel{at.x, at.y - 1}}) {
      if (!values.contains(next.x, next.y) || known(next.x, next.y) != 0) continue;
      values(next.x, next.y) = values(at.x, at.y);
      known(next.x, next.y) = 1;
      open.push_back(next);
    }
  }
}

struct HeightSum {
  float sum = 0.0F;
  int count = 0;
};

// Features of a frame's cells.
class CellFeatures {
 public:
  CellFeatures(const SegmentFrame& frame, const VideoSegmentOptions& options)
      : frame_(frame),
        options_(options),
        cells_((frame.picture.width() + options.cell_px - 1) / options.cell_px,
               (frame.picture.height() + options.cell_px - 1) / options.cell_px) {
    add_colours();
    if (!frame.motion.empty()) add_motion();
    if (!frame.height.empty()) add_height();
  }
  Raster<SegmentFeature> take() { return std::move(cells_); }

 private:
  void add_colours();
  void add_motion();
  void add_height();
  template <class Visit>
  void visit_pixels(Visit&& visit) const {
    for (int y = 0; y < frame_.picture.height(); ++y)
      for (int x = 0; x < frame_.picture.width(); ++x)
        visit(x, y, x / options_.cell_px, y / options_.cell_px);
  }

  const SegmentFrame& frame_;
  const VideoSegmentOptions& options_;
  Raster<SegmentFeature> cells_;
};

void CellFeatures::add_colours() {
  const cv::Mat lab = lab_of(frame_.picture, options_);
  Raster<int> pixels(cells_.width(), cells_.height(), 0);
  visit_pixels([&](int x, int y, int cx, int cy) {
    const cv::Vec3f colour = lab.at<cv::Vec3f>(y, x);
    for (std::size_t i = 0; i < 3; ++i) cells_(cx, cy).appearance[i] += colour[static_cast<int>(i)];
    ++pixels(cx, cy);
  });
  const auto one = static_cast<float>(options_.colour_levels);
  const auto scale =
      static_cast<float>(options_.position_share *
                         std::hypot(frame_.picture.width(), frame_.picture.height()) / options_.cell_px);
  for (int y = 0; y < cells_.height(); ++y)
    for (int x = 0; x < cells_.width(); ++x) {
      for (std::size_t i = 0; i < 3; ++i)
        cells_(x, y).appearance[i] /= one * static_cast<float>(pixels(x, y));
      cells_(x, y).position = {static_cast<float>(x) / scale, static_cast<float>(y) / scale};
    }
}

// Without the tails, which may be errors. At least one value.
template <class T>
T value_range(std::vector<T> values) {
  constexpr double kTail = 0.01;
  const T most = quantile_of(values, 1 - kTail);
  return most - quantile_of(values, kTail);
}

void CellFeatures::add_motion() {
  std::vector<double> along_x, along_y;
  for (const MovedPoint& point : frame_.motion) along_x.push_back(point.dx), along_y.push_back(point.dy);
  const double range = std::max(value_range(std::move(along_x)), value_range(std::move(along_y)));
  const double one = std::max(options_.motion_px, options_.motion_share * range);
  Raster<std::array<float, 2>> motion(cells_.width(), cells_.height());
  Raster<std::uint8_t> known(cells_.width(), cells_.height(), 0);
  for (const MovedPoint& point : frame_.motion) {
    const int x = static_cast<int>(std::floor((point.x + 0.5) / options_.cell_px)),
              y = static_cast<int>(std::floor((point.y + 0.5) / options_.cell_px));
    if (!motion.contains(x, y)) continue;
    motion(x, y) = {static_cast<float>(point.dx / one), static_cast<float>(point.dy / one)};
    known(x, y) = 1;
  }
  fill_from_nearest(motion, known);
  for (std::size_t i = 0; i < cells_.count(); ++i)
    for (std::size_t k = 0; k < 2; ++k) cells_.values()[i].appearance[3 + k] = motion.values()[i][k];
}

void CellFeatures::add_height() {
  std::vector<float> all;
  Raster<HeightSum> sums(cells_.width(), cells_.height());
  visit_pixels([&](int x, int y, int cx, int cy) {
    const float h = frame_.height(x, y);
    if (!std::isfinite(h)) return;
    all.push_back(h);
    sums(cx, cy).sum += h, ++sums(cx, cy).count;
  });
  if (all.empty()) return;
  const float range = value_range(std::move(all));
  if (!(range > 0)) return;
  Raster<float> heights(cells_.width(), cells_.height());
  Raster<std::uint8_t> known(cells_.width(), cells_.height(), 0);
  const float one = range * static_cast<float>(options_.height_share);
  for (std::size_t i = 0; i < heights.count(); ++i) {
    const HeightSum& mean = sums.values()[i];
    known.values()[i] = mean.count > 0 ? 1 : 0;
    if (mean.count > 0) heights.values()[i] = mean.sum / static_cast<float>(mean.count) / one;
  }
  fill_from_nearest(heights, known);
  for (std::size_t i = 0; i < cells_.count(); ++i) cells_.values()[i].appearance[5] = heights.values()[i];
}

// Centres far from each other (max-min distance): the cell farthest from all of them is the next one.
std::vector<SegmentCentre> first_centres(const Raster<SegmentFeature>& cells,
                                         const VideoSegmentOptions& options) {
  std::vector<SegmentCentre> out{{0, cells(cells.width() / 2, cells.height() / 2), 1}};
  std::vector<float> nearest(cells.count(), std::numeric_limits<float>::infinity());
  while (static_cast<int>(out.size()) < options.most_segments) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      nearest[i] = std::min(nearest[i], squared_difference(cells.values()[i], out.back().mean));
      if (nearest[i] > nearest[farthest]) farthest = i;
    }
    if (nearest[farthest] < options.new_distance * options.new_distance) break;
    out.push_back({static_cast<int>(out.size()), cells.values()[farthest], 1});
  }
  return out;
}

// The position counts less for larger segments: a large one reaches farther.
float position_difference(const SegmentFeature& cell, const SegmentCentre& centre, float mean_cells) {
  const float dx = cell.position[0] - centre.mean.position[0],
              dy = cell.position[1] - centre.mean.position[1];
  return (dx * dx + dy * dy) * mean_cells / static_cast<float>(std::max(1, centre.cells));
}

constexpr int kUnlikeAll = -1;

// Each cell's centre (its index); kUnlikeAll where it looks like none. Without positions for new centres,
// which have none yet.
Raster<int> nearest_centres(const Raster<SegmentFeature>& cells, const std::vector<SegmentCentre>& centres,
                            bool with_position, double new_distance) {
  Raster<int> out(cells.width(), cells.height(), kUnlikeAll);
  const float mean_cells = static_cast<float>(cells.count()) / static_cast<float>(centres.size());
  const auto limit = static_cast<float>(new_distance * new_distance);
  for (std::size_t i = 0; i < cells.count(); ++i) {
    float least = std::numeric_limits<float>::infinity(), least_look = least;
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const float look = squared_difference(cells.values()[i], centres[k].mean);
      least_look = std::min(least_look, look);
      const float d =
          look + (with_position ? position_difference(cells.values()[i], centres[k], mean_cells) : 0.0F);
      if (d < least) least = d, out.values()[i] = static_cast<int>(k);
    }
    if (least_look > limit) out.values()[i] = kUnlikeAll;
  }
  return out;
}

// Of components with one identity the largest keeps it; the others, and those without, get new ones.
void give_identities(std::vector<SegmentCentre>& components, int& next_identity) {
  std::map<int, std::size_t> keeper;
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i].identity < 0) continue;
    const auto [at, fresh] = keeper.emplace(components[i].identity, i);
    if (!fresh && components[i].cells > components[at->second].cells) at->second = i;
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    const auto at = keeper.find(components[i].identity);
    if (at == keeper.end() || at->second != i) components[i].identity = next_identity++;
  }
}

}  // namespace

std::vector<Parameter> parameters_of(VideoSegmentOptions& o) {
  return {
      {"cell_px", &o.cell_px, {1, 16}, "px", "Side of the cells that pixels are grouped into"},
      {"smooth_px", &o.smooth_px, {0, 20}, "px", "Standard deviation of the smoothing of colours"},
      {"colour_levels", &o.colour_levels, {1, 100}, "", "Difference of CIELAB colours that counts as one"},
      {"position_share",
       &o.position_share,
       {0.01, 10},
       "",
       "Distance that counts as one, share of the diagonal"},
      {"motion_px", &o.motion_px, {0.1, 100}, "px", "Difference of motion that counts as one"},
      {"height_share", &o.height_share, {0.01, 10}, "", "Height that counts as one, share of the range"},
      {"new_distance", &o.new_distance, {0.1, 100}, "", "What differs more from all segments begins one"},
      {"merge_distance", &o.merge_distance, {0, 100}, "", "Neighbours that differ less become one"},
      {"least_share",
       &o.least_share,
       {0, 0.5},
       "",
       "Smaller fragments join a neighbour, share of the picture"},
      {"most_segments", &o.most_segments, {1, 255}, "", "Segments at the beginning"},
      {"iterations", &o.iterations, {1, 100}, "", "Rounds of assignment and new centres"}};
}

Result<FrameSegments> VideoSegmenter::add(const SegmentFrame& frame) {
  if (auto checked = check_ranges(options_); !checked) return checked.error();
  const int w = frame.picture.width(), h = frame.picture.height();
  if (w < 1 || h < 1) return invalid_input("a frame is empty");
  if (width_ == 0) width_ = w, height_ = h;
  if (w != width_ || h != height_) return invalid_input("the frames have different sizes");
  if (!frame.height.empty() && (frame.height.width() != w || frame.height.height() != h))
    return invalid_input("the heights are of another size than the picture");

  const Raster<SegmentFeature> cells = CellFeatures(frame, options_).take();
  const bool first = centres_.empty();
  if (first) centres_ = first_centres(cells, options_), next_identity_ = static_cast<int>(centres_.size());
  const SegmentMergeOptions merging{
      std::max(1, static_cast<int>(options_.least_share * static_cast<double>(cells.count()))),
      options_.merge_distance};
  SegmentComponents found;
  Raster<int> before;
  for (int i = 0; i < options_.iterations; ++i) {
    Raster<int> labels = nearest_centres(cells, centres_, !(first && i == 0), options_.new_distance);
    for (int& label : labels.values())
      if (label != kUnlikeAll) label = centres_[static_cast<std::size_t>(label)].identity;
    found = merged_components(labels, cells, merging);
    give_identities(found.components, next_identity_);
    centres_ = found.components;
    if (found.of_cell.values().size() == before.values().size() &&
        std::equal(before.values().begin(), before.values().end(), found.of_cell.values().begin()))
      break;
    before = found.of_cell;
  }
  FrameSegments out{Raster<int>(w, h), {}};
  for (const SegmentCentre& centre : centres_) out.segments.push_back({centre.identity, 0});
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      VideoSegment& segment =
          out.segments[static_cast<std::size_t>(found.of_cell(x / options_.cell_px, y / options_.cell_px))];
      out.of_pixel(x, y) = segment.identity;
      ++segment.pixels;
    }
  return out;
}

}  // namespace palpable::vision
