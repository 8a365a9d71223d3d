// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string_view>

#include "drawn_maps.hpp"

namespace palpable::bench {
namespace {

constexpr double kMetresPerDegree = 111195.0;

class Town {
 public:
  explicit Town(std::uint64_t seed) : random_(seed), random_tunnels_(seed + 500) {}

  sources::MapExtract take() {
    place_nodes();
    for (int row = 0; row < kSide; ++row) add_street(row, true);
    for (int column = 0; column < kSide; ++column) add_street(column, false);
    add_blocks();
    add_lanes();
    add_tunnels();
    return std::move(town_);
  }

 private:
  static constexpr int kSide = 15;
  static constexpr double kBlock_m = 110.0;

  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

  static sources::GeoPoint geo(double x_m, double y_m) {
    return {y_m / kMetresPerDegree, x_m / kMetresPerDegree};
  }

  /// Crossings on a bent and turned grid.
  void place_nodes() {
    const double turn = uniform(-0.4, 0.4);
    const double bend = uniform(-3e-4, 3e-4);
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const double u = (i - 0.5 * (kSide - 1)) * kBlock_m + uniform(-18.0, 18.0);
        const double v = (j - 0.5 * (kSide - 1)) * kBlock_m + uniform(-18.0, 18.0) + bend * u * u;
        x_[j][i] = std::cos(turn) * u - std::sin(turn) * v;
        y_[j][i] = std::sin(turn) * u + std::cos(turn) * v;
      }
  }

  std::string new_name() {
    constexpr std::array<std::string_view, 20> kFirst{
        "Linden", "Bahnhof",  "Garten", "Mühl",   "Kirch",   "Schul",  "Rosen", "Berg", "Wald",  "Ufer",
        "Castle", "Victoria", "Albert", "Market", "Station", "Church", "Mill",  "Park", "Queen", "Bridge"};
    constexpr std::array<std::string_view, 5> kGerman{"straße", "gasse", "weg", "allee", "platz"};
    constexpr std::array<std::string_view, 5> kEnglish{" Street", " Road", " Lane", " Avenue", " Terrace"};
    constexpr std::array<std::string_view, 12> kFrench{
        "Rue des Iris",      "Rue du Port",    "Boulevard Carnot", "Avenue Pasteur",
        "Rue de la Poste",   "Rue Grimaldi",   "Allée des Pins",   "Chemin du Moulin",
        "Avenue de la Gare", "Rue des Écoles", "Quai Antoine",     "Rue Émile Zola"};
    const auto pick = [this](std::size_t n) {
      return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
    };
    const std::size_t kind = pick(3);
    if (kind == 0) return std::string(kFrench[pick(kFrench.size())]);
    const std::string prefix = chance(0.3) ? "Old " : chance(0.3) ? "North " : "";
    const std::size_t first = pick(10);
    if (kind == 1) return std::string(kFirst[first]) + std::string(kGerman[pick(5)]);
    return prefix + std::string(kFirst[10 + first]) + std::string(kEnglish[pick(5)]);
  }

  void add_way(std::string kind, std::string name, std::vector<std::int64_t> nodes,
               std::vector<sources::GeoPoint> points, bool tunnel = false) {
    sources::ExtractWay way;
    way.tunnel = tunnel;
    way.kind = std::move(kind);
    way.name = std::move(name);
    way.nodes = std::move(nodes);
    way.points = std::move(points);
    town_.ways.push_back(std::move(way));
  }

  /// A row or column of the grid, in which pieces are missing; some are main streets, of which some have two
  /// carriageways of opposite directions, and of these some blocks are in tunnels.
  void add_street(int number, bool is_row) {
    const bool main = number % 5 == 2;
    const bool is_dual = main && chance(0.5);
    const std::string kind = is_dual       ? "primary"
                             : main        ? (chance(0.5) ? "secondary" : "tertiary")
                             : chance(0.8) ? "residential"
                                           : "pedestrian";
    std::string name = new_name();
    std::vector<std::int64_t> nodes;
    std::vector<sources::GeoPoint> points, beside;
    const double apart_m = std::uniform_real_distribution<>(9.0, 16.0)(random_tunnels_);
    bool tunnel = false;
    const auto flush = [&] {
      if (points.size() >= 2) {
        add_way(kind, name, nodes, points, tunnel);
        if (is_dual) {
          std::vector<std::int64_t> numbers;
          for (std::size_t k = 0; k < beside.size(); ++k) numbers.push_back(next_++);
          std::reverse(beside.begin(), beside.end());
          add_way(kind, name, std::move(numbers), beside, tunnel);
        }
      }
      nodes.clear();
      points.clear();
      beside.clear();
    };
    for (int k = 0; k < kSide; ++k) {
      const int i = is_row ? k : number;
      const int j = is_row ? number : k;
      nodes.push_back(j * kSide + i);
      points.push_back(geo(x_[j][i], y_[j][i]));
      beside.push_back(is_row ? geo(x_[j][i], y_[j][i] + apart_m) : geo(x_[j][i] + apart_m, y_[j][i]));
      if (main && tunnel != std::bernoulli_distribution(tunnel ? 0.5 : 0.1)(random_tunnels_)) {
        const auto node = nodes.back();
        const auto here = points.back();
        const auto there = beside.back();
        flush();
        nodes = {node};
        points = {here};
        beside = {there};
        tunnel = !tunnel;
      }
      if (!main && chance(0.22)) flush();
      if (!main && chance(0.12)) name = new_name();
      if (k + 1 == kSide || points.empty() || !chance(0.5)) continue;
      // A bend between two crossings.
      const int i2 = is_row ? k + 1 : number;
      const int j2 = is_row ? number : k + 1;
      const double mx = 0.5 * (x_[j][i] + x_[j2][i2]) + uniform(-12.0, 12.0);
      const double my = 0.5 * (y_[j][i] + y_[j2][i2]) + uniform(-12.0, 12.0);
      nodes.push_back(next_++);
      points.push_back(geo(mx, my));
      beside.push_back(is_row ? geo(mx, my + apart_m) : geo(mx + apart_m, my));
    }
    flush();
  }

  void add_area(sources::ExtractArea::Kind kind, const std::vector<std::array<double, 2>>& corners) {
    sources::ExtractArea area{kind, {}};
    for (const auto& c : corners) area.ring.push_back(geo(c[0], c[1]));
    town_.areas.push_back(std::move(area));
  }

  /// Buildings, parks and ponds between the streets.
  void add_blocks() {
    using Kind = sources::ExtractArea::Kind;
    for (int j = 0; j + 1 < kSide; ++j)
      for (int i = 0; i + 1 < kSide; ++i) {
        const auto inside = [&](double s, double t) {
          const auto mix = [&](const auto& v) {
            return (1 - t) * ((1 - s) * v[j][i] + s * v[j][i + 1]) +
                   t * ((1 - s) * v[j + 1][i] + s * v[j + 1][i + 1]);
          };
          return std::array<double, 2>{mix(x_), mix(y_)};
        };
        const auto rectangle = [&](double s, double t, double w, double h) {
          return std::vector<std::array<double, 2>>{inside(s, t), inside(s + w, t), inside(s + w, t + h),
                                                    inside(s, t + h)};
        };
        if (chance(0.12)) {
          add_area(chance(0.3) ? Kind::water : Kind::green, rectangle(0.15, 0.15, 0.7, 0.7));
          continue;
        }
        for (double s = 0.14; s < 0.7; s += 0.2)
          for (double t = 0.14; t < 0.7; t += 0.2)
            if (chance(0.75))
              add_area(Kind::building, rectangle(s, t, uniform(0.08, 0.16), uniform(0.08, 0.16)));
      }
  }

  /// Short service ways, paths and tracks inside blocks.
  void add_lanes() {
    for (int j = 0; j + 1 < kSide; ++j)
      for (int i = 0; i + 1 < kSide; ++i) {
        if (!chance(0.35)) continue;
        const double x = 0.5 * (x_[j][i] + x_[j + 1][i + 1]);
        const double y = 0.5 * (y_[j][i] + y_[j + 1][i + 1]);
        const std::string kind = chance(0.4) ? "service" : chance(0.5) ? "footway" : "track";
        add_way(kind, "", {j * kSide + i, next_++}, {geo(x_[j][i], y_[j][i]), geo(x, y)});
      }
  }

  /// Tunnels below blocks and streets, from one crossing to another, some with a second tube beside them.
  void add_tunnels() {
    constexpr std::array<std::string_view, 4> kKinds{"primary", "primary", "secondary", "residential"};
    constexpr int kTunnels = 9;
    const auto any = [this](int low, int high) {
      return std::uniform_int_distribution<>(low, high)(random_tunnels_);
    };
    const auto sway_m = [this] { return std::uniform_real_distribution<>(-25.0, 25.0)(random_tunnels_); };
    for (int n = 0; n < kTunnels; ++n) {
      const int i = any(2, kSide - 7);
      const int j = any(4, kSide - 5);
      const int i2 = i + any(2, 4);
      const int j2 = j + any(-3, 3);
      const double dx = x_[j2][i2] - x_[j][i];
      const double dy = y_[j2][i2] - y_[j][i];
      const double length = std::hypot(dx, dy);
      const double sway = sway_m();
      const std::string kind(kKinds[static_cast<std::size_t>(any(0, 3))]);
      const std::string name = any(0, 1) == 0 ? "" : "Tunnel Rocher";
      const int tubes = any(0, 2) == 0 ? 2 : 1;
      for (int tube = 0; tube < tubes; ++tube) {
        const double aside = sway + tube * 14.0;
        std::vector<sources::GeoPoint> points{geo(x_[j][i], y_[j][i])};
        std::vector<std::int64_t> nodes{j * kSide + i};
        for (const double t : {0.3, 0.7}) {
          points.push_back(
              geo(x_[j][i] + t * dx - aside * dy / length, y_[j][i] + t * dy + aside * dx / length));
          nodes.push_back(next_++);
        }
        points.push_back(geo(x_[j2][i2], y_[j2][i2]));
        nodes.push_back(j2 * kSide + i2);
        if (tube == 1) {
          std::reverse(points.begin(), points.end());
          std::reverse(nodes.begin(), nodes.end());
        }
        add_way(kind, name, std::move(nodes), std::move(points), true);
      }
    }
  }

  std::mt19937_64 random_;
  /// For tunnels and carriageways.
  std::mt19937_64 random_tunnels_;
  std::array<std::array<double, kSide>, kSide> x_{}, y_{};
  std::int64_t next_ = kSide * kSide;
  sources::MapExtract town_;
};

}  // namespace

sources::MapExtract drawn_town(std::uint64_t seed) { return Town(seed).take(); }

}  // namespace palpable::bench
