// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/dashed_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// A piece of ink of the size of a dash.
struct Dash {
  cv::Point2d middle;
  /// Its direction, and its extent along and across that, pixels.
  cv::Point2d along;
  double length_px = 0.0;
  double width_px = 0.0;
  /// Where it differs most from what is around it: colour and difference.
  cv::Vec3d colour;
  double contrast = 0.0;
};

/// How much darker each pixel is than what is around it, in the channel where that is most.
cv::Mat darkness_in_colour(const cv::Mat& picture, double stroke_px) {
  const int side = 2 * static_cast<int>(std::ceil(0.5 * stroke_px)) + 3;
  cv::Mat around;
  cv::morphologyEx(picture, around, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
  std::array<cv::Mat, 3> channels;
  cv::split(around - picture, channels.data());
  return cv::max(channels[0], cv::max(channels[1], channels[2]));
}

/// Extent of a piece along and across its direction of total least squares.
Dash dash_of(const std::vector<cv::Point>& pixels, const cv::Mat& picture, const cv::Mat& contrast) {
  Dash out;
  double sum = 0.0;
  for (const cv::Point p : pixels) {
    const double w = contrast.at<std::uint8_t>(p);
    out.middle += w * cv::Point2d(p);
    sum += w;
    if (w > out.contrast) {
      out.contrast = w;
      const auto c = picture.at<cv::Vec3b>(p);
      out.colour = {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
    }
  }
  out.middle *= 1.0 / sum;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const cv::Point p : pixels) {
    const cv::Point2d d = cv::Point2d(p) - out.middle;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  out.along = {std::cos(angle), std::sin(angle)};
  double first = 1e9, last = -1e9, left = 1e9, right = -1e9;
  for (const cv::Point p : pixels) {
    const cv::Point2d d = cv::Point2d(p) - out.middle;
    first = std::min(first, d.dot(out.along));
    last = std::max(last, d.dot(out.along));
    left = std::min(left, out.along.cross(d));
    right = std::max(right, out.along.cross(d));
  }
  out.length_px = last - first + 1.0;
  out.width_px = right - left + 1.0;
  return out;
}

std::vector<Dash> dashes_of(const cv::Mat& picture, const cv::Mat& contrast, std::span<const Rgb8> of_other,
                            const DashedLineOptions& options) {
  cv::Mat strongest, scaled;
  cv::dilate(contrast, strongest, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  strongest.convertTo(scaled, CV_8U, options.separation);
  const cv::Mat ink = (contrast >= options.contrast) & (contrast > scaled);
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(ink, labels, stats, centres, 8);
  std::vector<Dash> out;
  std::vector<cv::Point> pixels;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    if (std::max(box.width, box.height) > options.longest_px) continue;
    pixels.clear();
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x)
        if (labels.at<int>(y, x) == i) pixels.emplace_back(x, y);
    Dash dash = dash_of(pixels, picture, contrast);
    const auto is_like = [&](Rgb8 c) {
      return cv::norm(dash.colour - cv::Vec3d(c.r, c.g, c.b)) <= options.most_colour_difference;
    };
    if (dash.width_px <= options.widest_px && std::none_of(of_other.begin(), of_other.end(), is_like))
      out.push_back(dash);
  }
  return out;
}

/// Two dashes that may follow each other.
struct Step {
  std::size_t a = 0;
  std::size_t b = 0;
};

class DashLinker {
 public:
  DashLinker(const std::vector<Dash>& dashes, const cv::Mat& contrast, const DashedLineOptions& options)
      : dashes_(dashes), contrast_(contrast), options_(options) {
    const int side = std::max(1, static_cast<int>(options.most_step_px));
    columns_ = contrast.cols / side + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(contrast.rows / side + 1));
    for (std::size_t i = 0; i < dashes.size(); ++i) cells_[cell_of(dashes[i].middle)].push_back(i);
    for (std::size_t i = 0; i < dashes.size(); ++i)
      near(dashes[i].middle, [&](std::size_t k) {
        if (k > i && may_follow(i, k)) steps_.push_back({i, k});
      });
    at_.resize(dashes.size());
    for (std::size_t s = 0; s < steps_.size(); ++s) {
      at_[steps_[s].a].push_back(s);
      at_[steps_[s].b].push_back(s);
    }
  }

  /// Rows of dashes in order: each step is followed by the one that goes on best, if that is mutual.
  std::vector<std::vector<std::size_t>> rows() const {
    std::vector<std::vector<std::size_t>> out;
    std::vector<bool> used(steps_.size(), false);
    for (std::size_t s = 0; s < steps_.size(); ++s) {
      if (used[s]) continue;
      std::vector<std::size_t> row = followed(s, steps_[s].a, used);
      std::reverse(row.begin(), row.end());
      const std::vector<std::size_t> rest = followed(s, steps_[s].b, used);
      row.insert(row.end(), rest.begin(), rest.end());
      out.push_back(std::move(row));
    }
    return out;
  }

 private:
  std::size_t cell_of(cv::Point2d p) const {
    const double side = std::max(1.0, std::floor(options_.most_step_px));
    return static_cast<std::size_t>(p.y / side) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(p.x / side);
  }

  template <class Use>
  void near(cv::Point2d p, Use&& use) const {
    const double side = std::max(1.0, std::floor(options_.most_step_px));
    const int rows = static_cast<int>(cells_.size()) / columns_;
    const int x = static_cast<int>(p.x / side), y = static_cast<int>(p.y / side);
    for (int r = std::max(0, y - 1); r <= std::min(rows - 1, y + 1); ++r)
      for (int c = std::max(0, x - 1); c <= std::min(columns_ - 1, x + 1); ++c)
        for (const std::size_t k : cells_[static_cast<std::size_t>(r * columns_ + c)]) use(k);
  }

  bool are_alike(const Dash& a, const Dash& b) const {
    const double ratio = a.width_px / b.width_px;
    return std::max(ratio, 1.0 / ratio) <= options_.most_width_ratio &&
           cv::norm(a.colour - b.colour) <= options_.most_colour_difference;
  }

  /// Long dashes lie along the step; those that are about as wide as long have no direction.
  bool lies_along(const Dash& dash, cv::Point2d step) const {
    constexpr double kLong = 1.8;
    if (dash.length_px < kLong * dash.width_px) return true;
    const double least = std::cos(options_.most_turn_deg * std::numbers::pi / 180.0);
    return std::abs(dash.along.dot(step)) >= least * cv::norm(step);
  }

  /// Whether the picture shows a gap between two dashes: a thin line that is not horizontal falls into pieces
  /// of ink, but has none.
  bool is_gap_between(const Dash& a, const Dash& b) const {
    const int n = std::max(2, static_cast<int>(2.0 * cv::norm(b.middle - a.middle)));
    double least = 255.0;
    for (int i = 1; i < n; ++i) {
      const cv::Point2d p = a.middle + static_cast<double>(i) / n * (b.middle - a.middle);
      least = std::min<double>(least, contrast_.at<std::uint8_t>(cv::Point(cvRound(p.x), cvRound(p.y))));
    }
    return least <= options_.gap_part * std::min(a.contrast, b.contrast);
  }

  bool may_follow(std::size_t i, std::size_t k) const {
    const Dash &a = dashes_[i], &b = dashes_[k];
    const cv::Point2d step = b.middle - a.middle;
    const double length = cv::norm(step);
    if (length > options_.most_step_px || length < 1.0 || !are_alike(a, b)) return false;
    if (!lies_along(a, step) || !lies_along(b, step) || !is_gap_between(a, b)) return false;
    // No other dash between them (Gabriel & Sokal 1969).
    const cv::Point2d middle = 0.5 * (a.middle + b.middle);
    bool is_free = true;
    near(middle, [&](std::size_t m) {
      is_free = is_free && (m == i || m == k || cv::norm(dashes_[m].middle - middle) >= 0.5 * length ||
                            !are_alike(dashes_[m], a));
    });
    return is_free;
  }

  std::size_t other_end(std::size_t step, std::size_t dash) const {
    return steps_[step].a == dash ? steps_[step].b : steps_[step].a;
  }

  /// The step that continues another one best over a dash; nullopt if none does.
  std::optional<std::size_t> best_after(std::size_t step, std::size_t over) const {
    const cv::Point2d in = dashes_[over].middle - dashes_[other_end(step, over)].middle;
    const double least = std::cos(options_.most_turn_deg * std::numbers::pi / 180.0);
    std::optional<std::size_t> best;
    double most = -1.0;
    for (const std::size_t next : at_[over]) {
      if (next == step) continue;
      const cv::Point2d out = dashes_[other_end(next, over)].middle - dashes_[over].middle;
      const double ratio = cv::norm(in) / cv::norm(out);
      const double straight = in.dot(out) / (cv::norm(in) * cv::norm(out));
      const double even = std::min(ratio, 1.0 / ratio);
      if (straight < least || even * options_.most_step_ratio < 1.0 || straight + even <= most) continue;
      most = straight + even;
      best = next;
    }
    return best;
  }

  /// The dashes from one end of a step on, that end first.
  std::vector<std::size_t> followed(std::size_t step, std::size_t end, std::vector<bool>& used) const {
    std::vector<std::size_t> out{end};
    used[step] = true;
    for (;;) {
      const auto next = best_after(step, end);
      if (!next || used[*next] || best_after(*next, end) != step) return out;
      step = *next;
      used[step] = true;
      end = other_end(step, end);
      out.push_back(end);
    }
  }

  const std::vector<Dash>& dashes_;
  const cv::Mat& contrast_;
  DashedLineOptions options_;
  int columns_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
  std::vector<Step> steps_;
  std::vector<std::vector<std::size_t>> at_;
};

/// The middle of a row of dashes, from the beginning of the first to the end of the last one.
CentreLine line_of(const std::vector<Dash>& dashes, const std::vector<std::size_t>& row) {
  std::vector<cv::Point2d> corners;
  double width = 0.0;
  for (const std::size_t i : row) {
    corners.push_back(dashes[i].middle);
    width += dashes[i].width_px;
  }
  const auto extended = [&](std::size_t end, std::size_t inner) {
    const cv::Point2d out = corners[end] - corners[inner];
    return corners[end] + 0.5 * dashes[row[end]].length_px / cv::norm(out) * out;
  };
  const cv::Point2d first = extended(0, 1), last = extended(row.size() - 1, row.size() - 2);
  corners.front() = first;
  corners.back() = last;
  CentreLine line;
  line.kind = MapStreet::Kind::path;
  line.radius_px = 0.5 * width / static_cast<double>(row.size());
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const cv::Point2d d = corners[k] - corners[k - 1];
    const int n = std::max(1, static_cast<int>(cv::norm(d)));
    for (int i = 0; i < n; ++i) {
      const cv::Point2d p = corners[k - 1] + static_cast<double>(i) / n * d;
      line.points.push_back({p.x, p.y});
    }
  }
  line.points.push_back({last.x, last.y});
  return line;
}

/// Whether a row of dashes is the edge of an area, or lies within a wide line, as borders are drawn.
bool is_edge(const cv::Mat& picture, const std::vector<Dash>& dashes, const std::vector<std::size_t>& row,
             const DashedLineOptions& options) {
  const auto colour_at = [&](cv::Point2d p) {
    const cv::Vec3b c = picture.at<cv::Vec3b>(std::clamp(cvRound(p.y), 0, picture.rows - 1),
                                              std::clamp(cvRound(p.x), 0, picture.cols - 1));
    return cv::Vec3i(c[0], c[1], c[2]);
  };
  const auto differ = [&](const cv::Vec3i& a, const cv::Vec3i& b) {
    const cv::Vec3i d = a - b;
    return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > options.same_colour;
  };
  std::size_t edges = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Dash& dash = dashes[row[k]];
    const cv::Point2d along = dashes[row[std::min(k + 1, row.size() - 1)]].middle -
                              dashes[row[k - std::min<std::size_t>(k, 1)]].middle;
    const cv::Point2d across = 1.0 / std::max(1e-9, cv::norm(along)) * cv::Point2d(-along.y, along.x);
    const double near = 0.5 * dash.width_px + options.beside_px, far = near + options.farther_px;
    const cv::Vec3i left = colour_at(dash.middle - near * across),
                    right = colour_at(dash.middle + near * across);
    const bool in_wide_line = differ(left, colour_at(dash.middle - far * across)) &&
                              differ(right, colour_at(dash.middle + far * across));
    edges += differ(left, right) || in_wide_line ? 1 : 0;
  }
  return static_cast<double>(edges) > options.most_edge_part * static_cast<double>(row.size());
}

double part_on(const Raster<std::uint8_t>& street, const CentreLine& line) {
  int on = 0;
  for (const MapPoint p : line.points) {
    const int x = cvRound(p.x), y = cvRound(p.y);
    on += street.contains(x, y) && street(x, y) != 0 ? 1 : 0;
  }
  return on / static_cast<double>(line.points.size());
}

}  // namespace

std::vector<Parameter> parameters_of(DashedLineOptions& o) {
  return {
      {"contrast", &o.contrast, {1, 255}, "levels", "least contrast of a dash"},
      {"separation", &o.separation, {0, 1}, "", "least part of the strongest contrast nearby"},
      {"widest_px", &o.widest_px, {1, 20}, "px", "widest dash"},
      {"longest_px", &o.longest_px, {2, 100}, "px", "longest dash"},
      {"most_step_px", &o.most_step_px, {2, 100}, "px", "farthest middles of dashes that follow each other"},
      {"gap_part", &o.gap_part, {0, 1}, "", "contrast of the gap, as a part of the dashes'"},
      {"most_colour_difference", &o.most_colour_difference, {0, 442}, "levels", "between dashes"},
      {"most_width_ratio", &o.most_width_ratio, {1, 10}, "", "between dashes"},
      {"most_turn_deg", &o.most_turn_deg, {0, 90}, "degrees", "from one step to the next"},
      {"most_step_ratio", &o.most_step_ratio, {1, 10}, "", "of two steps that follow each other"},
      {"fewest_dashes", &o.fewest_dashes, {3, 100}, "", "of a line"},
      {"least_length_px", &o.least_length_px, {0, 1000}, "px", "of a line"},
      {"beside_px", &o.beside_px, {0.5, 20}, "px", "where what is beside a line is seen"},
      {"farther_px", &o.farther_px, {1, 50}, "px", "where what is farther away is seen"},
      {"same_colour", &o.same_colour, {0, 255}, "levels", "smaller differences of these count as none"},
      {"most_edge_part", &o.most_edge_part, {0, 1}, "", "part of a line that may be the edge of an area"},
      {"most_on_street", &o.most_on_street, {0, 1}, "", "part of a line that may lie on streets"}};
}

CentreLines dashed_lines(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& street,
                         std::span<const Rgb8> of_other, const DashedLineOptions& options) {
  const cv::Mat view(picture.height(), picture.width(), CV_8UC3,
                     const_cast<void*>(static_cast<const void*>(picture.data())));
  const cv::Mat contrast = darkness_in_colour(view, options.widest_px);
  const std::vector<Dash> dashes = dashes_of(view, contrast, of_other, options);
  CentreLines out;
  for (const auto& row : DashLinker(dashes, contrast, options).rows()) {
    if (static_cast<int>(row.size()) < options.fewest_dashes || is_edge(view, dashes, row, options)) continue;
    CentreLine line = line_of(dashes, row);
    if (length_px(line.points) < options.least_length_px || part_on(street, line) > options.most_on_street)
      continue;
    line.first = static_cast<int>(out.nodes.size());
    line.last = line.first + 1;
    out.nodes.push_back(line.points.front());
    out.nodes.push_back(line.points.back());
    out.lines.push_back(std::move(line));
  }
  return out;
}

}  // namespace palpable::vision
