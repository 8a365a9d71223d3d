// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/text_lines.hpp"

#include "palpable/vision/text/ink.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <opencv2/imgproc.hpp>

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

/// Direction of total least squares through the ink's pixels.
struct Direction {
  cv::Point2d along{1.0, 0.0};
};
Direction direction_of(const std::vector<cv::Point>& pixels) {
  const auto n = static_cast<double>(pixels.size());
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const cv::Point p : pixels) {
    x += p.x;
    y += p.y;
    xx += static_cast<double>(p.x) * p.x;
    xy += static_cast<double>(p.x) * p.y;
    yy += static_cast<double>(p.y) * p.y;
  }
  const double a = xx / n - x / n * x / n;
  const double b = xy / n - x / n * y / n;
  const double c = yy / n - y / n * y / n;
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  return {{std::cos(angle), std::sin(angle)}};
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
  std::vector<Direction> direction(inks.size());
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
      return std::abs(to.dot(direction[static_cast<std::size_t>(k)].along)) >= least * length;
    };
    // A dot or an accent lies beside its letter, not along the line.
    const double larger = std::max(a.size_px, b.size_px);
    const bool dot = std::min(a.size_px, b.size_px) < options.mark_size * larger &&
                     length < options.mark_distance * larger;
    return !dot && !along(link.a) && !along(link.b);
  });
}

double quantile_of(std::vector<double>& values, double q) {
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Fits v = c0 + c1 u + c2 u² + c3 u³ by least squares; the third degree only if `bends`.
std::array<double, 4> curve_of(const std::vector<cv::Point2d>& points, bool bends) {
  const double scale =
      std::max(1.0, std::abs(std::max_element(points.begin(), points.end(), [](auto& a, auto& b) {
                               return std::abs(a.x) < std::abs(b.x);
                             })->x));
  cv::Matx44d m = cv::Matx44d::zeros();
  cv::Vec4d r(0, 0, 0, 0);
  for (const cv::Point2d& p : points) {
    const double u = p.x / scale;
    const cv::Vec4d f(1.0, u, u * u, bends ? u * u * u : 0.0);
    m += f * f.t();
    r += p.y * f;
  }
  cv::Vec4d c;
  if (!cv::solve(m, r, c, cv::DECOMP_SVD)) return {};
  return {c[0], c[1] / scale, c[2] / (scale * scale), c[3] / (scale * scale * scale)};
}

/// A line of lettering with its ink.
struct InkLine {
  TextLine line;
  std::vector<cv::Point> pixels;
  cv::Rect box;
};

/// Fits the line's middle and height to its ink.
void fit_line(InkLine& ink, const TextLineOptions& options) {
  ink.box = cv::boundingRect(ink.pixels);
  const cv::Point2d along = direction_of(ink.pixels).along;
  const cv::Point2d across(-along.y, along.x);
  cv::Point2d origin(0, 0);
  for (const cv::Point p : ink.pixels) origin += cv::Point2d(p);
  origin *= 1.0 / static_cast<double>(ink.pixels.size());
  std::vector<cv::Point2d> points;
  std::vector<double> us;
  std::vector<double> vs;
  for (const cv::Point p : ink.pixels) {
    const cv::Point2d d = cv::Point2d(p) - origin;
    points.emplace_back(d.dot(along), d.dot(across));
    us.push_back(points.back().x);
    vs.push_back(points.back().y);
  }
  const double length = quantile_of(us, 1.0) - quantile_of(us, 0.0);
  const double least = options.height_outliers, most = 1.0 - options.height_outliers;
  const double thickness = quantile_of(vs, most) - quantile_of(vs, least);
  const std::array<double, 4> c = curve_of(points, length > options.bending_length * thickness);
  const auto middle = [&c](double u) { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); };
  std::vector<double> residuals;
  for (const cv::Point2d& p : points) residuals.push_back(p.y - middle(p.x));
  const double low = quantile_of(residuals, least);
  const double high = quantile_of(residuals, most);
  ink.line.height_px = high - low + 1.0;
  ink.line.centre.clear();
  const double first = quantile_of(us, 0.0);
  const int steps = std::max(1, static_cast<int>(length));
  for (int i = 0; i <= steps; ++i) {
    const double u = first + length * i / steps;
    const cv::Point2d p = origin + u * along + (middle(u) + 0.5 * (low + high)) * across;
    ink.line.centre.push_back({p.x, p.y});
  }
}

InkLine line_of(const std::vector<const Ink*>& pieces, const TextLineOptions& options) {
  InkLine out;
  out.line.letters = static_cast<int>(pieces.size());
  cv::Vec3d colour(0, 0, 0);
  for (const Ink* ink : pieces) {
    colour += ink->colour;
    out.pixels.insert(out.pixels.end(), ink->pixels.begin(), ink->pixels.end());
  }
  colour *= 1.0 / static_cast<double>(pieces.size());
  out.line.colour = {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
                     cv::saturate_cast<std::uint8_t>(colour[2])};
  fit_line(out, options);
  return out;
}

MapPoint end_of(const TextLine& line, bool last) { return last ? line.centre.back() : line.centre.front(); }

/// The direction out of a line at one of its ends.
cv::Point2d direction_at(const TextLine& line, bool last, const TextLineOptions& options) {
  const std::size_t back =
      std::min(line.centre.size() - 1, static_cast<std::size_t>(options.word_end_heights * line.height_px));
  const MapPoint inner = line.centre[last ? line.centre.size() - 1 - back : back];
  const MapPoint end = end_of(line, last);
  const cv::Point2d d(end.x - inner.x, end.y - inner.y);
  return d * (1.0 / std::max(1e-9, cv::norm(d)));
}

bool has_colour_of(const TextLine& a, const TextLine& b, const TextLineOptions& options) {
  return cv::norm(cv::Vec3d(a.colour.r - b.colour.r, a.colour.g - b.colour.g, a.colour.b - b.colour.b)) <=
         options.most_colour_difference;
}

/// Whether a word is too short, against the line `a`, to have a direction of its own.
bool is_short_word(const InkLine& word, const TextLine& a, const TextLineOptions& options) {
  return std::max(word.box.width, word.box.height) <= options.short_word_heights * a.height_px &&
         static_cast<double>(a.centre.size()) > options.short_word_heights * a.height_px;
}

/// The gap between an end of a line and a short word that belongs to it; negative if it does not.
double short_word_gap(const TextLine& a, bool a_last, const InkLine& word, const TextLineOptions& options) {
  const cv::Point2d along = direction_at(a, a_last, options), from(end_of(a, a_last).x, end_of(a, a_last).y);
  const cv::Point2d middle = 0.5 * cv::Point2d(word.box.tl() + word.box.br());
  if (cv::norm(middle - from) > (options.largest_word_gap + options.short_word_heights) * a.height_px)
    return -1.0;
  double first = 1e9, left = 1e9, right = -1e9;
  for (const cv::Point p : word.pixels) {
    const cv::Point2d to = cv::Point2d(p) - from;
    first = std::min(first, to.dot(along));
    left = std::min(left, along.cross(to));
    right = std::max(right, along.cross(to));
  }
  const double most = (0.5 + options.short_word_beyond) * a.height_px;
  const bool is_in_line =
      left >= -most && right <= most && right - left + 1.0 >= options.short_word_part * a.height_px;
  const bool follows =
      first > -options.word_overlap * a.height_px && first <= options.largest_word_gap * a.height_px;
  return is_in_line && follows && has_colour_of(a, word.line, options) ? std::max(0.0, first) : -1.0;
}

/// The gap between two ends of lines that are words of one name; negative if they are not. The longer word
/// decides the direction, in which the shorter one must lie.
double word_gap(const InkLine& longer, bool a_last, const InkLine& shorter, bool b_last,
                const TextLineOptions& options) {
  const TextLine &a = longer.line, &b = shorter.line;
  if (a.centre.size() < b.centre.size()) return word_gap(shorter, b_last, longer, a_last, options);
  if (is_short_word(shorter, a, options)) return short_word_gap(a, a_last, shorter, options);
  const double height = std::max(a.height_px, b.height_px);
  const MapPoint from = end_of(a, a_last);
  const cv::Point2d gap(end_of(b, b_last).x - from.x, end_of(b, b_last).y - from.y);
  const cv::Point2d far(end_of(b, !b_last).x - from.x, end_of(b, !b_last).y - from.y);
  const double length = cv::norm(gap);
  const bool alike =
      height < options.word_height_ratio * std::min(a.height_px, b.height_px) && has_colour_of(a, b, options);
  if (!alike || length > options.largest_word_gap * height) return -1.0;
  const cv::Point2d along = direction_at(a, a_last, options);
  const double least = std::cos(options.most_turn_deg * std::numbers::pi / 180.0);
  const bool follows = along.dot(far) >= least * cv::norm(far) && along.dot(far) > along.dot(gap) &&
                       along.dot(gap) > -options.word_overlap * height;
  return follows && std::abs(along.cross(gap)) < options.word_aside * height ? length : -1.0;
}

/// Joins words that follow each other into one line, the nearest ones first.
void join_words(std::vector<InkLine>& lines, const TextLineOptions& options) {
  for (;;) {
    double least = 1e9;
    std::array<std::size_t, 2> best{};
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = i + 1; j < lines.size(); ++j)
        for (const bool i_last : {false, true})
          for (const bool j_last : {false, true})
            if (const double gap = word_gap(lines[i], i_last, lines[j], j_last, options);
                gap >= 0.0 && gap < least) {
              least = gap;
              best = {i, j};
            }
    if (least >= 1e9) return;
    InkLine& a = lines[best[0]];
    const InkLine& b = lines[best[1]];
    a.pixels.insert(a.pixels.end(), b.pixels.begin(), b.pixels.end());
    a.line.letters += b.line.letters;
    fit_line(a, options);
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(best[1]));
  }
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
