// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/photo_tracks.hpp"

#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

namespace palpable::vision {
namespace {

using Descriptors = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Features {
  std::vector<cv::Point2f> places;
  /// One row each, of length 1.
  Descriptors descriptors;
};

using Match = std::pair<int, int>;

// Square roots of the normalised histograms: their product is the Hellinger kernel (Arandjelović & Zisserman
// 2012).
Features features_of(const Raster<std::uint8_t>& picture, const PhotoMatchOptions& options) {
  std::vector<cv::KeyPoint> points;
  cv::Mat values;
  cv::SIFT::create(options.most_features)
      ->detectAndCompute(grey_view_of(picture), cv::noArray(), points, values);
  Features out;
  out.descriptors.resize(values.rows, values.cols);
  for (int i = 0; i < values.rows; ++i) {
    out.places.push_back(points[static_cast<std::size_t>(i)].pt);
    const Eigen::Map<const Eigen::RowVectorXf> row(values.ptr<float>(i), values.cols);
    out.descriptors.row(i) = (row / std::max(1e-6F, row.lpNorm<1>())).cwiseSqrt();
  }
  return out;
}

// For each row the column of the greatest product, -1 where the ratio test fails.
std::vector<int> best_columns(const Eigen::MatrixXf& products, double ratio) {
  std::vector<int> out(static_cast<std::size_t>(products.rows()), -1);
  const auto distance = [](float product) {
    return std::sqrt(std::max(0.0, 2.0 - 2.0 * static_cast<double>(product)));
  };
  for (Eigen::Index i = 0; i < products.rows(); ++i) {
    float best = -1.0F, next = -1.0F;
    int at = -1;
    for (Eigen::Index j = 0; j < products.cols(); ++j) {
      const float product = products(i, j);
      if (product > best)
        next = best, best = product, at = static_cast<int>(j);
      else
        next = std::max(next, product);
    }
    if (distance(best) < ratio * distance(next)) out[static_cast<std::size_t>(i)] = at;
  }
  return out;
}

std::vector<Match> mutual_matches(const Features& a, const Features& b, const PhotoMatchOptions& options) {
  std::vector<Match> out;
  if (a.places.size() < 2 || b.places.size() < 2) return out;
  const Eigen::MatrixXf products = a.descriptors * b.descriptors.transpose();
  const std::vector<int> there = best_columns(products, options.ratio),
                         back = best_columns(products.transpose(), options.ratio);
  for (std::size_t i = 0; i < there.size(); ++i)
    if (there[i] >= 0 && back[static_cast<std::size_t>(there[i])] == static_cast<int>(i))
      out.emplace_back(static_cast<int>(i), there[i]);
  return out;
}

// The matches that agree with one epipolar geometry; none where too few do.
std::vector<Match> checked_matches(const Features& a, const Features& b, const PhotoMatchOptions& options) {
  std::vector<Match> matches = mutual_matches(a, b, options);
  if (static_cast<int>(matches.size()) < options.least_matches) return {};
  std::vector<cv::Point2f> first, second;
  for (const auto& [i, j] : matches)
    first.push_back(a.places[static_cast<std::size_t>(i)]),
        second.push_back(b.places[static_cast<std::size_t>(j)]);
  cv::Mat inliers;
  cv::findFundamentalMat(first, second, cv::FM_RANSAC, options.epipolar_px, 0.999, inliers);
  std::vector<Match> out;
  for (std::size_t k = 0; k < matches.size(); ++k)
    if (!inliers.empty() && inliers.at<std::uint8_t>(static_cast<int>(k)) != 0) out.push_back(matches[k]);
  return static_cast<int>(out.size()) < options.least_matches ? std::vector<Match>{} : out;
}

// Sets of features of the same point: disjoint sets with path halving.
class PointSets {
 public:
  explicit PointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

struct PicturePair {
  std::size_t first = 0, second = 0;
  std::vector<Match> matches;
};

std::vector<PointTrack> joined(const std::vector<Features>& features, const std::vector<PicturePair>& pairs) {
  std::vector<std::size_t> begin(features.size() + 1, 0);
  for (std::size_t i = 0; i < features.size(); ++i) begin[i + 1] = begin[i] + features[i].places.size();
  PointSets sets(begin.back());
  for (const PicturePair& pair : pairs)
    for (const auto& [i, j] : pair.matches)
      sets.join(begin[pair.first] + static_cast<std::size_t>(i),
                begin[pair.second] + static_cast<std::size_t>(j));
  std::map<std::size_t, std::map<int, ImagePoint>> places;
  std::map<std::size_t, std::size_t> members;
  for (std::size_t picture = 0; picture < features.size(); ++picture)
    for (std::size_t i = 0; i < features[picture].places.size(); ++i) {
      const std::size_t set = sets.find(begin[picture] + i);
      const cv::Point2f place = features[picture].places[i];
      places[set].try_emplace(static_cast<int>(picture), ImagePoint{place.x, place.y});
      ++members[set];
    }
  std::vector<PointTrack> out;
  for (const auto& [set, seen] : places) {
    // A point that one picture shows twice is two points.
    if (seen.size() < 2 || members[set] != seen.size()) continue;
    PointTrack track{seen.begin()->first, {}};
    track.places.assign(static_cast<std::size_t>(seen.rbegin()->first - track.first_frame + 1), kNotSeen);
    for (const auto& [picture, place] : seen)
      track.places[static_cast<std::size_t>(picture - track.first_frame)] = place;
    out.push_back(std::move(track));
  }
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(PhotoMatchOptions& o) {
  return {
      {"most_features", &o.most_features, {100, 20000}, "", "Features of a picture, the strongest ones"},
      {"ratio", &o.ratio, {0.3, 1}, "", "Distance to the match as a share of that to the next best"},
      {"epipolar_px", &o.epipolar_px, {0.2, 20}, "px", "Matches farther from the epipolar line are wrong"},
      {"least_matches", &o.least_matches, {8, 1000}, "", "Matches that two pictures need"},
      {"following", &o.following, {1, 400}, "", "Pictures after each that it is matched with"}};
}

Result<std::vector<PointTrack>> match_photos(std::span<const Raster<std::uint8_t>> pictures,
                                             const PhotoMatchOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  std::vector<Features> features(pictures.size());
  parallel_for(work, static_cast<int>(pictures.size()), 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end) && !work.cancelled();
         ++i)
      features[i] = features_of(pictures[i], options);
  });
  std::vector<PicturePair> pairs;
  for (std::size_t a = 0; a < pictures.size(); ++a)
    for (std::size_t b = a + 1; b < pictures.size() && b <= a + static_cast<std::size_t>(options.following);
         ++b)
      pairs.push_back({a, b, {}});
  std::atomic<std::size_t> done{0};
  parallel_for(work, static_cast<int>(pairs.size()), 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end) && !work.cancelled();
         ++i) {
      pairs[i].matches = checked_matches(features[pairs[i].first], features[pairs[i].second], options);
      work.report(static_cast<double>(++done) / static_cast<double>(pairs.size()), "matching the pictures");
    }
  });
  if (work.cancelled()) return Work::interrupted();
  return joined(features, pairs);
}

}  // namespace palpable::vision
