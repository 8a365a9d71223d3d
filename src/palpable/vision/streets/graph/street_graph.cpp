// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/graph/street_graph.hpp"

#include "palpable/vision/streets/graph/lone_paths.hpp"
#include "palpable/vision/streets/graph/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace palpable::vision {
namespace {

MapPoint operator-(MapPoint a, MapPoint b) { return {a.x - b.x, a.y - b.y}; }
MapPoint operator+(MapPoint a, MapPoint b) { return {a.x + b.x, a.y + b.y}; }
MapPoint operator*(double s, MapPoint a) { return {s * a.x, s * a.y}; }
double dot(MapPoint a, MapPoint b) { return a.x * b.x + a.y * b.y; }
double norm(MapPoint a) { return std::hypot(a.x, a.y); }
MapPoint unit(MapPoint a) {
  const double n = norm(a);
  return n > 0.0 ? (1.0 / n) * a : MapPoint{};
}

/// A free end of a line: where it is and where it points to.
struct FreeEnd {
  std::size_t line = 0;
  int node = 0;
  MapPoint at;
  MapPoint direction;
  double radius_px = 0.0;
};

class Joiner {
 public:
  Joiner(const MapColours& colours, const std::vector<LayerOfColour>& layers,
         const std::vector<TextLine>& names, const StreetGraphOptions& options)
      : colours_(colours), layers_(layers), names_(names), options_(options) {}

  CentreLines joined() {
    for (const LayerOfColour& layer : layers_) add(layer.lines);
    remove_fragments(options_.fragment_part);
    follow_names();
    close_gaps();
    meet_streets();
    reach_border();
    merge_near_nodes();
    remove_spurs(graph_, options_.spur_radii, options_.spur_px);
    remove_fragments(1.0);
    return std::move(graph_);
  }

  /// Joins paths to a finished network.
  CentreLines with_paths(CentreLines streets, const CentreLines& paths) {
    joined_kind_ = MapStreet::Kind::path;
    graph_ = std::move(streets);
    add(paths);
    follow_names();
    meet_streets();
    close_gaps();
    reach_border();
    merge_near_nodes();
    remove_lone_paths(graph_, colours_.frame, options_.reach_px);
    return std::move(graph_);
  }

 private:
  int width() const { return colours_.of_pixel.width(); }
  int height() const { return colours_.of_pixel.height(); }
  MapPoint& node(int n) { return graph_.nodes[static_cast<std::size_t>(n)]; }

  void add(const CentreLines& lines) {
    const int offset = static_cast<int>(graph_.nodes.size());
    graph_.nodes.insert(graph_.nodes.end(), lines.nodes.begin(), lines.nodes.end());
    for (CentreLine line : lines.lines) {
      line.first += offset;
      line.last += offset;
      graph_.lines.push_back(std::move(line));
    }
  }

  std::vector<FreeEnd> free_ends() const {
    const std::vector<int> degree = degrees_of(graph_);
    std::vector<FreeEnd> ends;
    for (std::size_t i = 0; i < graph_.lines.size(); ++i) {
      const CentreLine& line = graph_.lines[i];
      if (line.kind != joined_kind_) continue;
      const auto& p = line.points;
      // Without the end itself, which may bend to a corner.
      const auto n = p.size();
      const auto near = std::min(n - 1, static_cast<std::size_t>(line.radius_px));
      const auto far = std::min(n - 1, near + static_cast<std::size_t>(options_.end_px) +
                                           static_cast<std::size_t>(options_.end_radii * line.radius_px));
      if (degree[static_cast<std::size_t>(line.first)] == 1)
        ends.push_back({i, line.first, p.front(), unit(p[near == far ? 0 : near] - p[far]), line.radius_px});
      if (degree[static_cast<std::size_t>(line.last)] == 1)
        ends.push_back({i, line.last, p.back(), unit(p[n - 1 - (near == far ? 0 : near)] - p[n - 1 - far]),
                        line.radius_px});
    }
    return ends;
  }

  bool is_street(MapPoint p) const {
    const int x = static_cast<int>(std::lround(p.x));
    const int y = static_cast<int>(std::lround(p.y));
    return colours_.of_pixel.contains(x, y) && layers_[colours_.of_pixel(x, y)].layer == MapLayer::street;
  }
  bool is_seen_street(MapPoint p) const {
    const int x = static_cast<int>(std::lround(p.x));
    const int y = static_cast<int>(std::lround(p.y));
    return is_street(p) && colours_.seen(x, y) != 0;
  }
  bool is_covered(MapPoint p) const {
    const int x = static_cast<int>(std::lround(p.x));
    const int y = static_cast<int>(std::lround(p.y));
    return colours_.of_pixel.contains(x, y) && (colours_.seen(x, y) == 0 || is_street(p));
  }

  /// The cost of bridging the gap between two ends; nullopt if they do not face each other.
  std::optional<double> gap_cost(const FreeEnd& a, const FreeEnd& b) const {
    const MapPoint gap = b.at - a.at;
    const double length = norm(gap);
    const double width = a.radius_px + b.radius_px;
    if (length > options_.gap_px) return std::nullopt;
    const double least = std::cos(options_.gap_angle_deg * std::numbers::pi / 180.0);
    const MapPoint along = unit(gap);
    // Over a short gap the ends' own places decide less than their directions.
    const bool aligned = dot(a.direction, along) > least && dot(b.direction, -1.0 * along) > least;
    const bool tiny =
        length < width && dot(a.direction, -1.0 * b.direction) > least && dot(a.direction, along) > 0.0;
    if (!aligned && !tiny) return std::nullopt;
    const double ratio = a.radius_px / b.radius_px;
    if (ratio < 1.0 / options_.gap_width_ratio || ratio > options_.gap_width_ratio) return std::nullopt;
    int land = 0;
    int street = 0;
    const int steps = std::max(1, static_cast<int>(length));
    for (int i = 0; i <= steps; ++i) {
      const MapPoint p = a.at + (static_cast<double>(i) / steps) * gap;
      land += is_covered(p) ? 0 : 1;
      street += is_seen_street(p) ? 1 : 0;
    }
    if (land > (1.0 - options_.gap_covered) * (steps + 1) || street > options_.crossing_px)
      return std::nullopt;
    return length * (2.0 - dot(a.direction, along) + 2.0 - dot(b.direction, -1.0 * along));
  }

  /// Where a street's free end touches a line of lettering, and whether it points along it or against it.
  struct EndOnName {
    FreeEnd end;
    std::size_t at;
    bool forward;
  };

  std::vector<EndOnName> ends_on(const TextLine& name, const std::vector<FreeEnd>& ends) const {
    std::vector<EndOnName> found;
    const auto& p = name.centre;
    const double least = std::cos(options_.name_angle_deg * std::numbers::pi / 180.0);
    for (const FreeEnd& end : ends) {
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < p.size(); ++i)
        if (norm(p[i] - end.at) < norm(p[nearest] - end.at)) nearest = i;
      const auto window = static_cast<std::size_t>(name.height_px);
      const MapPoint along =
          unit(p[std::min(p.size() - 1, nearest + window)] - p[nearest - std::min(nearest, window)]);
      const MapPoint to = end.at - p[nearest];
      const double aside = std::abs(to.x * along.y - to.y * along.x);
      const bool inside = nearest > 0 && nearest + 1 < p.size();
      const double beyond = inside ? 0.0 : std::abs(dot(to, along));
      if (aside > options_.name_aside * name.height_px + 1.0 ||
          beyond > options_.name_margin * name.height_px + end.radius_px)
        continue;
      const double facing = dot(end.direction, along);
      if (std::abs(facing) < least) continue;
      const bool forward = facing > 0.0;
      // An end beyond the name must point to it.
      if (!inside && forward != (nearest == 0)) continue;
      found.push_back({end, nearest, forward});
    }
    std::sort(found.begin(), found.end(), [](const EndOnName& a, const EndOnName& b) { return a.at < b.at; });
    return found;
  }

  /// Adds the part of a name's middle between two of its points as a line from `first` to `last`; a negative
  /// `last` is a new node at the end of the name.
  void connect_along(const TextLine& name, std::size_t from, std::size_t to, int first, int last,
                     double radius_px) {
    CentreLine line{{}, first, last, radius_px, 0.0, joined_kind_};
    for (std::size_t i = from;; i < to ? ++i : --i) {
      line.points.push_back(name.centre[i]);
      if (i == to) break;
    }
    if (last < 0) {
      line.last = static_cast<int>(graph_.nodes.size());
      graph_.nodes.push_back(line.points.back());
    } else {
      line.points.push_back(node(last));
    }
    line.points.insert(line.points.begin(), node(first));
    graph_.lines.push_back(std::move(line));
  }

  /// A street's name lies in the middle of the street: a street that ends at its own name goes on along it.
  void follow_names() {
    const std::vector<FreeEnd> ends = free_ends();
    std::vector<bool> used(graph_.nodes.size(), false);
    for (const TextLine& name : names_) {
      if (static_cast<double>(name.centre.size()) < options_.name_length * name.height_px) continue;
      std::vector<EndOnName> on = ends_on(name, ends);
      std::erase_if(on, [&used](const EndOnName& e) { return used[static_cast<std::size_t>(e.end.node)]; });
      for (std::size_t i = 0; i < on.size(); ++i) {
        const EndOnName& a = on[i];
        if (used[static_cast<std::size_t>(a.end.node)]) continue;
        const bool is_pair = a.forward && i + 1 < on.size() && !on[i + 1].forward;
        if (is_pair) {
          const EndOnName& b = on[i + 1];
          connect_along(name, a.at, b.at, a.end.node, b.end.node, std::min(a.end.radius_px, b.end.radius_px));
          used[static_cast<std::size_t>(a.end.node)] = used[static_cast<std::size_t>(b.end.node)] = true;
          continue;
        }
        // Nothing else of the street may lie in the rest of the name.
        const bool last_forward = a.forward && i + 1 == on.size();
        const bool first_backward = !a.forward && i == 0;
        if (!last_forward && !first_backward) continue;
        const std::size_t to = a.forward ? name.centre.size() - 1 : 0;
        if (to == a.at) continue;
        connect_along(name, a.at, to, a.end.node, -1, a.end.radius_px);
        used[static_cast<std::size_t>(a.end.node)] = true;
      }
    }
    join_lines(graph_);
  }

  void close_gaps() {
    const std::vector<FreeEnd> ends = free_ends();
    struct Pair {
      double cost;
      std::size_t a, b;
    };
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < ends.size(); ++a)
      for (std::size_t b = a + 1; b < ends.size(); ++b)
        if (ends[a].node != ends[b].node)
          if (const auto cost = gap_cost(ends[a], ends[b])) pairs.push_back({*cost, a, b});
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
    std::vector<bool> used(ends.size(), false);
    for (const Pair& pair : pairs) {
      if (used[pair.a] || used[pair.b]) continue;
      used[pair.a] = used[pair.b] = true;
      connect(ends[pair.a].node, ends[pair.b].node, std::min(ends[pair.a].radius_px, ends[pair.b].radius_px));
    }
    join_lines(graph_);
  }

  struct Meeting {
    int node;
    MapPoint at;
    double radius_px;
  };

  /// Where a street's end meets the centre line of another street: the best point before it.
  std::optional<MapPoint> meeting_of(const FreeEnd& end, const PointGrid& grid) const {
    const double reach = options_.meeting_part * std::min(width(), height());
    const double least_facing = std::cos(options_.meeting_angle_deg * std::numbers::pi / 180.0);
    std::optional<MapPoint> best;
    double least = 1e9;
    grid.near(end.at, reach, [&](const PointGrid::Entry& entry) {
      const CentreLine& other = graph_.lines[entry.line];
      if (entry.line == end.line) return;
      const MapPoint to = other.points[entry.point] - end.at;
      const double distance = norm(to);
      if (distance > options_.meeting_radii * (end.radius_px + other.radius_px) + options_.border_px) return;
      const double facing = distance > 0.0 ? dot(end.direction, to) / distance : 1.0;
      if (facing < least_facing) return;
      if (const double cost = distance * (2.0 - facing); cost < least) {
        least = cost;
        best = other.points[entry.point];
      }
    });
    if (!best) return best;
    // Between the two there may be a border, but no land.
    const MapPoint to = *best - end.at;
    const int steps = std::max(1, static_cast<int>(norm(to)));
    int outside = 0;
    for (int i = 0; i <= steps; ++i) {
      const MapPoint p = end.at + (static_cast<double>(i) / steps) * to;
      outside += is_covered(p) ? 0 : 1;
    }
    if (outside > options_.border_px) return std::nullopt;
    return best;
  }

  void meet_streets() {
    PointGrid grid(width(), height());
    grid.add(graph_);
    const std::vector<FreeEnd> ends = free_ends();
    std::vector<Meeting> meetings;
    for (const FreeEnd& end : ends)
      if (const auto at = meeting_of(end, grid)) meetings.push_back({end.node, *at, end.radius_px});
    for (const Meeting& meeting : meetings) {
      // Lines were split since: look for the point again.
      for (std::size_t i = 0; i < graph_.lines.size(); ++i) {
        const auto& points = graph_.lines[i].points;
        const auto found = std::find_if(points.begin(), points.end(), [&](MapPoint p) {
          return p.x == meeting.at.x && p.y == meeting.at.y;
        });
        if (found == points.end()) continue;
        const int there = split_line(graph_, i, static_cast<std::size_t>(found - points.begin()));
        if (there != meeting.node) connect(meeting.node, there, meeting.radius_px);
        break;
      }
    }
    join_lines(graph_);
  }

  /// Streets that end just inside the picture's border go on to it: thinning shortens them.
  void reach_border() {
    for (const FreeEnd& end : free_ends()) {
      const double reach = options_.reach_radii * end.radius_px + options_.reach_px;
      const double t = std::max(0.0, distance_to_side(colours_.frame, end.at, end.direction));
      if (t > reach) continue;
      graph_.nodes.push_back(end.at + t * end.direction);
      connect(end.node, static_cast<int>(graph_.nodes.size()) - 1, end.radius_px);
    }
    join_lines(graph_);
  }

  /// Two junctions that are nearer than the streets are wide are one: their short line goes.
  void merge_near_nodes() {
    for (bool changed = true; changed;) {
      changed = false;
      const std::vector<int> degree = degrees_of(graph_);
      for (std::size_t i = 0; i < graph_.lines.size(); ++i) {
        const CentreLine line = graph_.lines[i];
        if (line.first == line.last) continue;
        if (degree[static_cast<std::size_t>(line.first)] < 3 ||
            degree[static_cast<std::size_t>(line.last)] < 3)
          continue;
        if (length_px(line.points) > options_.merge_radii * line.radius_px + options_.merge_px) continue;
        graph_.lines.erase(graph_.lines.begin() + static_cast<std::ptrdiff_t>(i));
        const MapPoint middle = 0.5 * (node(line.first) + node(line.last));
        node(line.first) = middle;
        for (CentreLine& other : graph_.lines) {
          if (other.first == line.last) other.first = line.first;
          if (other.last == line.last) other.last = line.first;
          if (other.first == line.first) other.points.front() = middle;
          if (other.last == line.first) other.points.back() = middle;
        }
        changed = true;
        break;
      }
    }
    std::erase_if(graph_.lines, [this](const CentreLine& line) {
      return line.first == line.last && length_px(line.points) < options_.loop_radii * line.radius_px;
    });
    join_lines(graph_);
  }

  void remove_fragments(double factor) {
    remove_short_networks(graph_, factor * options_.least_network_part * std::min(width(), height()),
                          factor * options_.least_network_radii);
  }

  /// A line between two nodes of what is joined.
  void connect(int a, int b, double radius_px) {
    connect_nodes(graph_, a, b, radius_px);
    graph_.lines.back().kind = joined_kind_;
  }

  const MapColours& colours_;
  const std::vector<LayerOfColour>& layers_;
  const std::vector<TextLine>& names_;
  StreetGraphOptions options_;
  /// The kind of the lines whose ends are joined.
  MapStreet::Kind joined_kind_ = MapStreet::Kind::street;
  CentreLines graph_;
};

}  // namespace

CentreLines join_streets(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                         const std::vector<TextLine>& names, const StreetGraphOptions& options) {
  return Joiner(colours, layers, names, options).joined();
}

CentreLines join_paths(CentreLines streets, const CentreLines& paths, const MapColours& colours,
                       const std::vector<LayerOfColour>& layers, const std::vector<TextLine>& names,
                       const StreetGraphOptions& options) {
  return Joiner(colours, layers, names, options).with_paths(std::move(streets), paths);
}

}  // namespace palpable::vision
