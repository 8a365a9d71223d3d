// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/street_map_score.hpp"

#include "palpable/core/geometry/segment.hpp"
#include "palpable/vision/streets/names/gazetteer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::measure {
namespace {

bool is_wanted(std::string_view kind) {
  constexpr std::array<std::string_view, 6> kOthers{"footway",  "path",    "steps",
                                                    "cycleway", "service", "bridleway"};
  return std::find(kOthers.begin(), kOthers.end(), kind) == kOthers.end();
}

/// Points of lines inside the picture, one a pixel, and the distance of each pixel to the nearest line.
class LinePixels {
 public:
  LinePixels(int width, int height) : mask_(height, width, CV_8U, cv::Scalar(255)) {}

  void add(const std::vector<MapPoint>& line) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const MapPoint a = line[i - 1];
      const MapPoint b = line[i];
      const int n = std::max(1, static_cast<int>(std::hypot(b.x - a.x, b.y - a.y)));
      for (int k = 0; k < n; ++k) {
        const cv::Point2d p(a.x + (b.x - a.x) * k / n, a.y + (b.y - a.y) * k / n);
        if (p.x < 0 || p.y < 0 || p.x > mask_.cols - 1 || p.y > mask_.rows - 1) continue;
        points_.push_back(p);
        mask_.at<std::uint8_t>(cv::Point(p)) = 0;
      }
    }
  }
  std::size_t count() const { return points_.size(); }

  /// Part of these points that are within `most_px` of the other lines.
  double part_near(const LinePixels& other, double most_px) const {
    if (points_.empty() || other.points_.empty()) return 0.0;
    cv::Mat distance;
    cv::distanceTransform(other.mask_, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const auto near = std::count_if(points_.begin(), points_.end(), [&](const cv::Point2d& p) {
      return distance.at<float>(cv::Point(p)) <= most_px;
    });
    return static_cast<double>(near) / static_cast<double>(points_.size());
  }

 private:
  cv::Mat mask_;
  std::vector<cv::Point2d> points_;
};

void paint(cv::Mat& mask, const std::vector<MapPoint>& line, double width_px) {
  constexpr int kBits = 4;
  constexpr double kOne = 1 << kBits;
  std::vector<cv::Point> points;
  for (const MapPoint p : line)
    points.emplace_back(static_cast<int>(std::lround(p.x * kOne)), static_cast<int>(std::lround(p.y * kOne)));
  cv::polylines(mask, points, false, cv::Scalar(255), std::max(1, static_cast<int>(std::lround(width_px))),
                cv::LINE_8, kBits);
}

/// The width of the found street that is nearest to most of a line's corners; 1 if none is near.
double width_beside(const std::vector<MapPoint>& line, const StreetMap& found) {
  constexpr double kNear_px = 6.0;
  std::map<double, int> votes;
  for (const MapPoint p : line) {
    double least = kNear_px;
    double width = 0.0;
    for (const MapStreet& street : found.streets)
      for (std::size_t i = 1; i < street.points.size(); ++i) {
        const double distance = distance_to_segment(p, street.points[i - 1], street.points[i]);
        if (distance >= least) continue;
        least = distance;
        width = street.width_px;
      }
    if (width > 0.0) ++votes[width];
  }
  const auto most = std::max_element(votes.begin(), votes.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? 1.0 : most->first;
}

double area_iou_of(const StreetMap& found, const TrueStreetMap& truth) {
  const cv::Size size(truth.width_px, truth.height_px);
  cv::Mat have = cv::Mat::zeros(size, CV_8U);
  cv::Mat wanted = have.clone();
  cv::Mat others = have.clone();
  for (const MapStreet& street : found.streets) paint(have, street.points, street.width_px);
  for (const TrueStreet& street : truth.streets)
    for (const auto& line : street.lines)
      paint(is_wanted(street.kind) ? wanted : others, line,
            street.width_px > 0.0 ? street.width_px : width_beside(line, found));
  have.setTo(0, others & ~wanted);
  const int all = cv::countNonZero(have | wanted);
  return all == 0 ? 0.0 : static_cast<double>(cv::countNonZero(have & wanted)) / all;
}

struct TrueJunction {
  MapPoint at;
  int degree = 0;
};

/// Where three or more pieces meet: ways meet at points that they share.
std::vector<TrueJunction> junctions_of(const TrueStreetMap& truth, bool wanted_only) {
  std::map<std::pair<double, double>, int> arms;
  for (const TrueStreet& street : truth.streets) {
    if (wanted_only && !is_wanted(street.kind)) continue;
    for (const auto& line : street.lines)
      for (std::size_t i = 0; i < line.size(); ++i)
        arms[{line[i].x, line[i].y}] += i == 0 || i + 1 == line.size() ? 1 : 2;
  }
  std::vector<TrueJunction> out;
  for (const auto& [at, degree] : arms) {
    const bool inside = at.first >= 0.0 && at.second >= 0.0 && at.first <= truth.width_px - 1 &&
                        at.second <= truth.height_px - 1;
    if (degree > 2 && inside) out.push_back({{at.first, at.second}, degree});
  }
  return out;
}

/// Pairs of true and found junctions within reach, the nearest first; each is used once.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<TrueJunction>& truth,
                                                          const std::vector<MapJunction>& found,
                                                          double most_px) {
  struct NearJunctions {
    double distance;
    std::size_t wanted, found;
  };
  std::vector<NearJunctions> near;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t k = 0; k < found.size(); ++k)
      if (const double d = std::hypot(truth[i].at.x - found[k].at.x, truth[i].at.y - found[k].at.y);
          d <= most_px)
        near.push_back({d, i, k});
  std::sort(near.begin(), near.end(),
            [](const NearJunctions& a, const NearJunctions& b) { return a.distance < b.distance; });
  std::vector<std::pair<std::size_t, std::size_t>> out;
  std::set<std::size_t> used_truth, used_found;
  for (const NearJunctions& pair : near) {
    if (used_truth.contains(pair.wanted) || used_found.contains(pair.found)) continue;
    used_truth.insert(pair.wanted);
    used_found.insert(pair.found);
    out.emplace_back(pair.wanted, pair.found);
  }
  return out;
}

void score_junctions(StreetMapScore& score, const StreetMap& found, const TrueStreetMap& truth,
                     const StreetMapScoreOptions& options) {
  const std::vector<TrueJunction> wanted = junctions_of(truth, true);
  const auto pairs = pairs_of(wanted, found.junctions, options.junction_px);
  score.junctions = static_cast<int>(wanted.size());
  score.junctions_found = static_cast<int>(pairs.size());
  std::set<std::size_t> used;
  for (const auto& [i, k] : pairs) {
    score.junctions_right_degree += wanted[i].degree == found.junctions[k].degree ? 1 : 0;
    used.insert(k);
  }
  // Where a service way or a path begins, a junction is not wanted, but true.
  std::vector<MapJunction> rest;
  for (std::size_t k = 0; k < found.junctions.size(); ++k)
    if (!used.contains(k)) rest.push_back(found.junctions[k]);
  const auto true_ones = pairs_of(junctions_of(truth, false), rest, options.junction_px);
  score.junctions_false = static_cast<int>(rest.size() - true_ones.size());
}

void score_names(StreetMapScore& score, const StreetMap& found, const TrueStreetMap& truth,
                 const StreetMapScoreOptions& options) {
  std::set<std::string> wanted, all, have;
  std::map<std::string, std::size_t> length;
  for (const TrueStreet& street : truth.streets) {
    const std::string name = vision::compared_form(street.name);
    if (name.empty()) continue;
    all.insert(name);
    LinePixels pixels(truth.width_px, truth.height_px);
    for (const auto& line : street.lines) pixels.add(line);
    length[name] = std::max(length[name], pixels.count());
  }
  for (const std::string& name : truth.drawn_names) wanted.insert(vision::compared_form(name));
  if (truth.drawn_names.empty())
    for (const auto& [name, pixels] : length)
      if (static_cast<double>(pixels) > options.named_px) wanted.insert(name);
  for (const MapStreet& street : found.streets)
    if (!street.name.empty()) have.insert(vision::compared_form(street.name));
  const auto count_in = [&have](const std::set<std::string>& names) {
    return static_cast<int>(std::count_if(
        have.begin(), have.end(), [&names](const std::string& name) { return names.contains(name); }));
  };
  score.names = static_cast<int>(wanted.size());
  score.names_right = count_in(wanted);
  score.names_false = static_cast<int>(have.size()) - count_in(all);
}

}  // namespace

double StreetMapScore::junction_f() const {
  const int all = junctions + junctions_found + junctions_false;
  return all == 0 ? 0.0 : 2.0 * junctions_found / all;
}

Result<StreetMapScore> score_street_map(const StreetMap& found, const TrueStreetMap& truth,
                                        const StreetMapScoreOptions& options) {
  if (found.width_px != truth.width_px || found.height_px != truth.height_px)
    return invalid_input("the map and the truth are of pictures of different size");
  const auto empty = [&truth] { return LinePixels(truth.width_px, truth.height_px); };
  LinePixels wanted = empty(), every = empty(), have = empty();
  for (const TrueStreet& street : truth.streets)
    for (const auto& line : street.lines) {
      every.add(line);
      if (is_wanted(street.kind)) wanted.add(line);
    }
  for (const MapStreet& street : found.streets) have.add(street.points);
  if (wanted.count() == 0) return invalid_input("the truth has no streets in the picture");
  StreetMapScore score;
  score.length_px = static_cast<double>(wanted.count());
  score.found = wanted.part_near(have, options.found_px);
  score.found_closely = wanted.part_near(have, options.close_px);
  score.true_part = have.part_near(every, options.true_px);
  score.area_iou = area_iou_of(found, truth);
  score_junctions(score, found, truth, options);
  score_names(score, found, truth, options);
  return score;
}

}  // namespace palpable::measure
