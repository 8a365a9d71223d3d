// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/followed_lines.hpp"

#include "palpable/vision/text/ink.hpp"
#include "palpable/vision/text/ink_coverage.hpp"
#include "palpable/vision/text/ink_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Pieces of ink of the size of letters.
std::vector<Ink> letters_of(const Raster<Rgb8>& picture, const cv::Mat& coverage, Rgb8 colour,
                            double height_px, const FollowedLinesOptions& options) {
  cv::Mat labels, stats, centres;
  const cv::Mat is_ink = coverage >= 255.0 * options.least_coverage;
  const int n = cv::connectedComponentsWithStats(is_ink, labels, stats, centres, 8);
  std::vector<Ink> out;
  for (int i = 1; i < n; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const double size = std::max(box.width, box.height);
    if (size < options.smallest_letter * height_px || size > options.largest_letter * height_px) continue;
    Ink ink{{centres.at<double>(i, 0), centres.at<double>(i, 1)}, size, {}, {}};
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x)
        if (labels.at<int>(y, x) == i) ink.pixels.emplace_back(x, y);
    ink.colour = mean_colour(picture, ink.pixels);
    if (cv::norm(ink.colour - cv::Vec3d(colour.r, colour.g, colour.b)) <= options.most_letter_difference)
      out.push_back(std::move(ink));
  }
  return out;
}

/// Follows lettering from letter to letter.
class LetterChains {
 public:
  LetterChains(std::vector<Ink> letters, double height_px, const FollowedLinesOptions& options)
      : letters_(std::move(letters)), height_px_(height_px), options_(options) {
    near_.resize(letters_.size());
    for (std::size_t a = 0; a < letters_.size(); ++a)
      for (std::size_t b = a + 1; b < letters_.size(); ++b)
        if (are_near(letters_[a], letters_[b])) {
          near_[a].push_back(b);
          near_[b].push_back(a);
        }
  }

  /// The longest chain through each pair of neighbours, the longest first.
  std::vector<std::vector<std::size_t>> all() const {
    std::vector<std::vector<std::size_t>> out;
    for (std::size_t a = 0; a < letters_.size(); ++a)
      for (const std::size_t b : near_[a])
        if (a < b) out.push_back(through(a, b));
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return out;
  }

  const std::vector<Ink>& letters() const { return letters_; }

 private:
  using Chain = std::vector<std::size_t>;

  bool are_near(const Ink& a, const Ink& b) const {
    const double most = options_.most_gap * height_px_;
    const auto reach = 0.5 * std::sqrt(2.0) * (a.size_px + b.size_px) + most;
    if (std::abs(a.centre.x - b.centre.x) > reach || std::abs(a.centre.y - b.centre.y) > reach) return false;
    return std::any_of(a.pixels.begin(), a.pixels.end(), [&](cv::Point p) {
      return std::any_of(b.pixels.begin(), b.pixels.end(),
                         [&](cv::Point q) { return cv::norm(p - q) <= most; });
    });
  }

  /// A place on the line of a chain's end, and the direction out of it.
  struct End {
    cv::Point2d at;
    cv::Point2d out;
  };
  End end_of(const Chain& chain) const {
    const cv::Point2d last = letters_[chain.back()].centre;
    std::vector<cv::Point2d> places;
    for (auto k = chain.rbegin(); k != chain.rend(); ++k) {
      const cv::Point2d p = letters_[*k].centre;
      if (places.size() >= 2 && cv::norm(p - last) > options_.direction_length * height_px_) break;
      places.push_back(p);
    }
    cv::Point2d mean(0, 0);
    for (const cv::Point2d p : places) mean += p;
    mean *= 1.0 / static_cast<double>(places.size());
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const cv::Point2d p : places) {
      const cv::Point2d d = p - mean;
      xx += d.x * d.x;
      xy += d.x * d.y;
      yy += d.y * d.y;
    }
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    cv::Point2d out(std::cos(angle), std::sin(angle));
    if (out.dot(last - places.back()) < 0.0) out = -out;
    return {mean + out.dot(last - mean) * out, out};
  }

  std::optional<std::size_t> next(const Chain& chain) const {
    const End end = end_of(chain);
    std::optional<std::size_t> best;
    double least = 1e9;
    for (const std::size_t k : near_[chain.back()]) {
      if (std::find(chain.begin(), chain.end(), k) != chain.end()) continue;
      const cv::Point2d to = letters_[k].centre - end.at;
      const double ahead = end.out.dot(to);
      const bool follows = ahead >= options_.least_step * height_px_ && ahead < least &&
                           std::abs(end.out.cross(to)) <= options_.most_aside * height_px_ &&
                           is_within(k, end);
      if (!follows) continue;
      least = ahead;
      best = k;
    }
    return best;
  }

  bool is_within(std::size_t letter, const End& end) const {
    const auto& pixels = letters_[letter].pixels;
    return std::all_of(pixels.begin(), pixels.end(), [&](cv::Point p) {
      return std::abs(end.out.cross(cv::Point2d(p) - end.at)) <= options_.most_reach * height_px_;
    });
  }

  Chain through(std::size_t a, std::size_t b) const {
    Chain chain{a, b};
    for (int side = 0; side < 2; ++side) {
      while (const auto more = next(chain)) chain.push_back(*more);
      std::reverse(chain.begin(), chain.end());
    }
    return chain;
  }

  std::vector<Ink> letters_;
  double height_px_;
  FollowedLinesOptions options_;
  std::vector<std::vector<std::size_t>> near_;
};

/// The runs of at least two letters of a chain that no longer chain has.
std::vector<std::vector<std::size_t>> unused_runs(const std::vector<std::size_t>& chain,
                                                  const std::vector<char>& used) {
  std::vector<std::vector<std::size_t>> out(1);
  for (const std::size_t k : chain) {
    if (used[k] == 0)
      out.back().push_back(k);
    else if (!out.back().empty())
      out.emplace_back();
  }
  std::erase_if(out, [](const auto& run) { return run.size() < 2; });
  return out;
}

bool is_name(const TextLine& line, double height_px, const FollowedLinesOptions& options) {
  return line.letters >= options.fewest_letters && line.height_px >= options.least_height * height_px &&
         line.height_px <= options.most_height * height_px &&
         static_cast<double>(line.centre.size()) >= options.least_length * height_px;
}

}  // namespace

std::vector<Parameter> parameters_of(FollowedLinesOptions& o) {
  return {
      {"least_coverage", &o.least_coverage, {0.05, 1}, "", "least part of a pixel that is ink"},
      {"most_colour_difference", &o.most_colour_difference, {1, 442}, "levels", "from the names' ink"},
      {"most_letter_difference", &o.most_letter_difference, {0, 442}, "levels", "of a letter's mean colour"},
      {"smallest_letter", &o.smallest_letter, {0, 1}, "heights", "least size of a letter"},
      {"largest_letter", &o.largest_letter, {1, 20}, "heights", "of letters that touch"},
      {"most_gap", &o.most_gap, {0, 3}, "heights", "largest gap between letters and words"},
      {"least_step", &o.least_step, {0, 2}, "heights", "how far ahead the next letter is at least"},
      {"most_aside", &o.most_aside, {0, 2}, "heights", "how far beside the line its middle is"},
      {"most_reach", &o.most_reach, {0, 2}, "heights", "how far it reaches from the line"},
      {"direction_length", &o.direction_length, {0.5, 10}, "heights", "length that gives the direction"},
      {"word_gap", &o.word_gap, {0, 10}, "heights", "largest gap between words"},
      {"word_turn_deg", &o.word_turn_deg, {0, 90}, "degrees", "largest turn between words"},
      {"least_height", &o.least_height, {0, 1}, "", "least height of a line, of the names'"},
      {"most_height", &o.most_height, {1, 5}, "", "greatest height"},
      {"least_length", &o.least_length, {0, 50}, "heights", "least length of a line"},
      {"fewest_letters", &o.fewest_letters, {2, 20}, "", "fewest letters of a line"}};
}

std::vector<TextLine> followed_lines(const Raster<Rgb8>& picture, double height_px, Rgb8 colour,
                                     const TextLineOptions& ink, const FollowedLinesOptions& options) {
  const cv::Mat coverage =
      coverage_of(picture, colour, ink.thickest_stroke_px, options.most_colour_difference);
  const LetterChains chains(letters_of(picture, coverage, colour, height_px, options), height_px, options);
  std::vector<char> used(chains.letters().size(), 0);
  std::vector<InkLine> words;
  for (const auto& chain : chains.all())
    for (const auto& run : unused_runs(chain, used)) {
      std::vector<const Ink*> pieces;
      pieces.reserve(run.size());
      for (const std::size_t k : run) pieces.push_back(&chains.letters()[k]);
      InkLine word = line_of(pieces, ink);
      if (word.line.height_px > options.most_height * height_px) continue;
      for (const std::size_t k : run) used[k] = 1;
      words.push_back(std::move(word));
    }
  TextLineOptions joining = ink;
  joining.largest_word_gap = options.word_gap;
  joining.most_turn_deg = options.word_turn_deg;
  join_words(words, joining);
  std::vector<TextLine> out;
  for (InkLine& word : words)
    if (is_name(word.line, height_px, options)) out.push_back(std::move(word.line));
  return out;
}

}  // namespace palpable::vision
