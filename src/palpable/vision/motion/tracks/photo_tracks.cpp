// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/photo_tracks.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/core/numbers/vectorize.hpp"
#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

namespace palpable::vision {
namespace {

// Of a SIFT descriptor, and the unit of its stored values: products of two descriptors are at most kUnit².
constexpr std::size_t kLength = 128;
constexpr double kUnit = 4096.0;

struct Features {
  std::vector<cv::Point2f> places;
  /// kLength values each, of length kUnit.
  std::vector<std::int16_t> descriptors;

  const std::int16_t* descriptor(std::size_t i) const { return descriptors.data() + i * kLength; }
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
  for (int i = 0; i < values.rows; ++i) {
    out.places.push_back(points[static_cast<std::size_t>(i)].pt);
    const float* row = values.ptr<float>(i);
    const float sum = std::max(1e-6F, std::accumulate(row, row + kLength, 0.0F));
    for (std::size_t k = 0; k < kLength; ++k)
      out.descriptors.push_back(
          static_cast<std::int16_t>(std::lround(kUnit * std::sqrt(static_cast<double>(row[k] / sum)))));
  }
  return out;
}

// The products of one descriptor with `count` others. In whole numbers this takes a fifth of the time.
PALPABLE_VECTORIZE void products(const std::int16_t* one, const std::int16_t* others, std::size_t count,
                                 std::int32_t* out) {
  for (std::size_t j = 0; j < count; ++j) {
    std::int32_t sum = 0;
    for (std::size_t k = 0; k < kLength; ++k) sum += one[k] * others[j * kLength + k];
    out[j] = sum;
  }
}

// The two greatest products of a descriptor, and which one gives the greatest.
struct Nearest {
  std::int32_t best = -1, next = -1;
  int at = -1;

  void add(std::int32_t product, std::size_t index) {
    if (product > best)
      next = best, best = product, at = static_cast<int>(index);
    else
      next = std::max(next, product);
  }
  bool passes(double ratio) const {
    const auto distance = [](std::int32_t product) {
      return std::sqrt(std::max(0.0, 2.0 - 2.0 * product / (kUnit * kUnit)));
    };
    return distance(best) < ratio * distance(next);
  }
};

std::vector<Match> mutual_matches(const Features& a, const Features& b, const PhotoMatchOptions& options) {
  std::vector<Match> out;
  if (a.places.size() < 2 || b.places.size() < 2) return out;
  std::vector<Nearest> there(a.places.size()), back(b.places.size());
  std::vector<std::int32_t> row(b.places.size());
  for (std::size_t i = 0; i < there.size(); ++i) {
    products(a.descriptor(i), b.descriptors.data(), row.size(), row.data());
    for (std::size_t j = 0; j < row.size(); ++j) there[i].add(row[j], j), back[j].add(row[j], i);
  }
  for (std::size_t i = 0; i < there.size(); ++i) {
    const Nearest& other = back[static_cast<std::size_t>(there[i].at)];
    if (other.at == static_cast<int>(i) && there[i].passes(options.ratio) && other.passes(options.ratio))
      out.emplace_back(static_cast<int>(i), there[i].at);
  }
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

struct PicturePair {
  std::size_t first = 0, second = 0;
  std::vector<Match> matches;
};

std::vector<PointTrack> joined(const std::vector<Features>& features, const std::vector<PicturePair>& pairs) {
  std::vector<std::size_t> begin(features.size() + 1, 0);
  for (std::size_t i = 0; i < features.size(); ++i) begin[i + 1] = begin[i] + features[i].places.size();
  // Features of the same point.
  DisjointSets sets(begin.back());
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
