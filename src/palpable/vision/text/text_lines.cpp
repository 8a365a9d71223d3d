// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/text_lines.hpp"

#include "palpable/vision/text/ink.hpp"
#include "palpable/vision/text/ink_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace palpable::vision {
namespace {

/// Least distance between two pieces of ink, pixels.
double gap_between(const Ink& a, const Ink& b) {
  double least = 1e18;
  for (const cv::Point p : a.pixels)
    for (const cv::Point q : b.pixels) {
      const double dx = p.x - q.x;
      const double dy = p.y - q.y;
      least = std::min(least, dx * dx + dy * dy);
    }
  return std::sqrt(least);
}

struct Link {
  int a;
  int b;
};

/// Pairs of pieces of similar size with a small gap.
std::vector<Link> near_pairs(const std::vector<Ink>& inks, const TextLineOptions& options) {
  std::vector<int> order(inks.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&inks](int i) -> const Ink& { return inks[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int i, int j) { return at(i).centre.x < at(j).centre.x; });
  std::vector<Link> links;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Ink& a = at(order[i]);
      const Ink& b = at(order[j]);
      if (b.centre.x - a.centre.x > options.most_distance * options.largest_letter_px) break;
      const double larger = std::max(a.size_px, b.size_px);
      const double smaller = std::min(a.size_px, b.size_px);
      if (cv::norm(a.centre - b.centre) > options.most_distance * larger ||
          larger > options.most_size_ratio * smaller)
        continue;
      if (cv::norm(a.colour - b.colour) > options.most_colour_difference) continue;
      if (gap_between(a, b) <= options.largest_gap * std::max(options.gap_size_part * larger, smaller))
        links.push_back({order[i], order[j]});
    }
  return links;
}

/// Keeps the links that run along the local direction of the lettering.
void keep_links_along(const std::vector<Ink>& inks, std::vector<Link>& links,
                      const TextLineOptions& options) {
  std::vector<std::vector<int>> near(inks.size());
  for (const Link& link : links) {
    near[static_cast<std::size_t>(link.a)].push_back(link.b);
    near[static_cast<std::size_t>(link.b)].push_back(link.a);
  }
  std::vector<cv::Point2d> direction(inks.size());
  for (std::size_t i = 0; i < inks.size(); ++i) {
    // The neighbours of the neighbours: about five letters.
    std::vector<int> around{static_cast<int>(i)};
    for (int step = 0; step < 2; ++step) {
      const std::vector<int> before = around;
      for (const int k : before)
        for (const int m : near[static_cast<std::size_t>(k)])
          if (std::find(around.begin(), around.end(), m) == around.end()) around.push_back(m);
    }
    std::vector<cv::Point> pixels;
    for (const int k : around) {
      const auto& more = inks[static_cast<std::size_t>(k)].pixels;
      pixels.insert(pixels.end(), more.begin(), more.end());
    }
    direction[i] = direction_of(pixels);
  }
  const double least = std::cos(options.most_turn_deg * std::numbers::pi / 180.0);
  std::erase_if(links, [&](const Link& link) {
    const Ink& a = inks[static_cast<std::size_t>(link.a)];
    const Ink& b = inks[static_cast<std::size_t>(link.b)];
    const cv::Point2d to = b.centre - a.centre;
    const double length = cv::norm(to);
    const auto along = [&](int k) {
      return std::abs(to.dot(direction[static_cast<std::size_t>(k)])) >= least * length;
    };
    // A dot or an accent lies beside its letter, not along the line.
    const double larger = std::max(a.size_px, b.size_px);
    const bool dot = std::min(a.size_px, b.size_px) < options.mark_size * larger &&
                     length < options.mark_distance * larger;
    return !dot && !along(link.a) && !along(link.b);
  });
}

}  // namespace

std::vector<TextLine> find_text_lines(const Raster<Rgb8>& picture, const TextLineOptions& options) {
  const std::vector<Ink> inks = pieces_of_ink(picture, options);
  std::vector<Link> links = near_pairs(inks, options);
  keep_links_along(inks, links, options);
  std::vector<int> group(inks.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&group](int i) {
    while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
    return i;
  };
  for (const Link& link : links) group[static_cast<std::size_t>(root(link.a))] = root(link.b);
  std::vector<std::vector<const Ink*>> members(inks.size());
  for (std::size_t i = 0; i < inks.size(); ++i)
    members[static_cast<std::size_t>(root(static_cast<int>(i)))].push_back(&inks[i]);
  std::vector<InkLine> words;
  const auto is_high = [&options](const TextLine& line) {
    return line.height_px >= options.least_word_height * options.smallest_letter_px;
  };
  for (const auto& pieces : members) {
    if (pieces.empty() ||
        (pieces.size() == 1 && pieces[0]->size_px < options.lone_letter * options.smallest_letter_px))
      continue;
    InkLine word = line_of(pieces, options);
    // Dashes in a row are lower than letters. A single stroke may be an I or a 1.
    if (pieces.size() == 1 || is_high(word.line)) words.push_back(std::move(word));
  }
  join_words(words, options);
  std::vector<TextLine> lines;
  for (InkLine& word : words)
    if (word.line.letters >= options.fewest_letters && is_high(word.line) &&
        static_cast<double>(word.line.centre.size()) >= options.least_length * word.line.height_px)
      lines.push_back(std::move(word.line));
  return lines;
}

}  // namespace palpable::vision
