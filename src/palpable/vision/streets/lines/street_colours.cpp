// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/street_colours.hpp"

#include "palpable/vision/streets/lines/beside_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Maps draw water blue and vegetation green in nearly every style, compared with the land, which is blue on
/// maps for the night.
MapLayer layer_by_hue(Rgb8 c, Rgb8 land, const StreetColourOptions& options) {
  const int most_green = options.least_green;
  const auto blue = [](Rgb8 v) { return v.b - v.r; };
  const auto green = [](Rgb8 v) { return v.g - std::max(v.r, v.b); };
  if (blue(c) - std::max(0, blue(land)) >= options.least_blue && c.b >= c.g - most_green)
    return MapLayer::water;
  if (green(c) - std::max(-options.least_green, green(land)) >= options.least_green) return MapLayer::green;
  return MapLayer::land;
}

/// Number of connected pieces with an area of at least `least` pixels, and the area of the largest one.
struct Pieces {
  int count = 0;
  int largest = 0;
  int area = 0;
};
Pieces pieces_of(const Raster<std::uint8_t>& mask, int least) {
  const cv::Mat view(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(view, labels, stats, centres, 4);
  Pieces out;
  for (int i = 1; i < n; ++i) {
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    out.area += area;
    out.largest = std::max(out.largest, area);
    out.count += area >= least ? 1 : 0;
  }
  return out;
}

/// Fills holes that are smaller than symbols on the street.
void fill_holes(Raster<std::uint8_t>& mask, int most_px) {
  cv::Mat view(mask.height(), mask.width(), CV_8U, mask.data());
  cv::Mat labels, stats, centres;
  const cv::Mat outside = view == 0;
  const int n = cv::connectedComponentsWithStats(outside, labels, stats, centres, 4);
  std::vector<bool> is_hole(static_cast<std::size_t>(n), false);
  for (int i = 1; i < n; ++i) {
    const int x = stats.at<int>(i, cv::CC_STAT_LEFT);
    const int y = stats.at<int>(i, cv::CC_STAT_TOP);
    const bool at_border = x == 0 || y == 0 || x + stats.at<int>(i, cv::CC_STAT_WIDTH) == view.cols ||
                           y + stats.at<int>(i, cv::CC_STAT_HEIGHT) == view.rows;
    is_hole[static_cast<std::size_t>(i)] = !at_border && stats.at<int>(i, cv::CC_STAT_AREA) <= most_px;
  }
  for (int y = 0; y < view.rows; ++y)
    for (int x = 0; x < view.cols; ++x)
      if (is_hole[static_cast<std::size_t>(labels.at<int>(y, x))]) mask(x, y) = 1;
}

/// Part of a line across which the picture itself shows the street: somewhere over its width, as lettering
/// may cover its middle. A broad street must be seen as an area: the pale rims of a border are thin lines.
double seen_part(const CentreLine& line, const MapColours& colours, const StreetColourOptions& options) {
  const std::uint8_t least =
      line.radius_px >= options.broad_radius_px ? MapColours::kArea : MapColours::kThinLine;
  const auto around = static_cast<std::size_t>(options.direction_points);
  const auto& p = line.points;
  int seen = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const MapPoint normal = normal_at(p, i, around);
    const int reach = static_cast<int>(line.radius_px);
    bool is_seen = false;
    for (int k = -reach; k <= reach && !is_seen; ++k)
      is_seen = value_at(colours.seen, beside(p[i], normal, k)) >= least;
    seen += is_seen ? 1 : 0;
  }
  return seen / static_cast<double>(p.size());
}

/// The line's length if it is a ribbon, else 0. Between two junctions it may be short, unless it is land
/// between buildings.
double ribbon_length(const CentreLine& line, const std::vector<int>& degrees, bool is_land,
                     double most_width_px, const StreetColourOptions& options) {
  const double length = length_px(line.points);
  const bool is_between = !is_land && degrees[static_cast<std::size_t>(line.first)] > 2 &&
                          degrees[static_cast<std::size_t>(line.last)] > 2 && line.first != line.last;
  const double widths = is_between ? options.least_block_widths : options.least_length_widths;
  const bool is_ribbon = length > 2.0 * line.radius_px * widths &&
                         line.radius_spread_px < options.most_width_spread * line.radius_px &&
                         2.0 * line.radius_px < most_width_px;
  return is_ribbon ? length : 0.0;
}

/// The pixels of one colour, without holes.
Raster<std::uint8_t> mask_of(const MapColours& colours, std::size_t k, const StreetColourOptions& options) {
  const Raster<std::uint8_t>& of_pixel = colours.of_pixel;
  Raster<std::uint8_t> mask(of_pixel.width(), of_pixel.height());
  std::transform(of_pixel.values().begin(), of_pixel.values().end(), mask.values().begin(),
                 [k](std::uint8_t c) { return static_cast<std::uint8_t>(c == k ? 1 : 0); });
  fill_holes(mask, options.hole_px);
  return mask;
}

void remove_unseen(CentreLines& lines, const MapColours& colours, const StreetColourOptions& options) {
  std::erase_if(lines.lines, [&](const CentreLine& line) {
    return seen_part(line, colours, options) < options.least_seen_part;
  });
  join_lines(lines);
}

/// On a map whose streets have casings, lines without them are rims of areas. Returns these, for each colour.
std::vector<std::vector<CentreLine>> remove_uncased(const MapColours& colours,
                                                    std::vector<LayerOfColour>& layers,
                                                    const StreetColourOptions& options) {
  std::vector<std::vector<CentreLine>> removed(layers.size());
  double all = 0.0;
  double cased = 0.0;
  std::vector<std::vector<CasedParts>> parts(layers.size());
  for (std::size_t k = 0; k < layers.size(); ++k)
    for (const CentreLine& line : layers[k].lines.lines) {
      parts[k].push_back(cased_parts(colours.picture, line, options.casings));
      const double length = length_px(line.points);
      all += length;
      cased += length * parts[k].back().any;
    }
  if (cased < options.casings.least_cased_part * all) return removed;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    std::size_t i = 0;
    std::erase_if(layers[k].lines.lines, [&](const CentreLine& line) {
      const CasedParts& p = parts[k][i++];
      const bool is_rim = p.any < options.casings.least_line_part ||
                          std::min(p.left, p.right) < options.casings.least_side_part;
      if (is_rim) removed[k].push_back(line);
      return is_rim;
    });
    join_lines(layers[k].lines);
  }
  return removed;
}

/// Clears the area around lines that are no streets.
void clear_around(Raster<std::uint8_t>& mask, const std::vector<CentreLine>& lines) {
  cv::Mat view(mask.height(), mask.width(), CV_8U, mask.data());
  for (const CentreLine& line : lines)
    for (const MapPoint p : line.points)
      cv::circle(view, {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))},
                 static_cast<int>(std::ceil(line.radius_px)), cv::Scalar(0), cv::FILLED);
}

/// Whether a colour is the pale one in which tunnels of a street's colour are drawn.
bool is_paler(Rgb8 colour, Rgb8 street, Rgb8 land, const StreetColourOptions& options) {
  constexpr int kNearlyWhite = 250;
  constexpr Rgb8 kWhite{255, 255, 255};
  const bool is_white = std::min({street.r, street.g, street.b}) >= kNearlyWhite;
  const Rgb8 other = is_white ? land : kWhite;
  const std::array<double, 3> way{static_cast<double>(other.r - street.r),
                                  static_cast<double>(other.g - street.g),
                                  static_cast<double>(other.b - street.b)};
  const std::array<double, 3> gone{static_cast<double>(colour.r - street.r),
                                   static_cast<double>(colour.g - street.g),
                                   static_cast<double>(colour.b - street.b)};
  const double square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
  if (square == 0.0) return false;
  const double part = (way[0] * gone[0] + way[1] * gone[1] + way[2] * gone[2]) / square;
  if (part < options.least_paler || part > options.most_paler) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(gone[i] - part * way[i]) > options.paler_tolerance) return false;
  return true;
}

/// The colour of streets of which colour `k` is that of tunnels: that of most pixels; `k` if there is none.
std::size_t open_colour_of(std::size_t k, std::size_t land, const MapColours& colours,
                           const std::vector<LayerOfColour>& layers, const StreetColourOptions& options) {
  std::size_t best = k;
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (layers[i].layer == MapLayer::street && colours.colours[i].pixels > colours.colours[best].pixels &&
        is_paler(colours.colours[k].value, colours.colours[i].value, colours.colours[land].value, options))
      best = i;
  return best;
}

/// Colours that were refused since few of their areas are streets, but that are paler ones of streets: their
/// lines with casings on both sides are tunnels.
void accept_tunnels(const MapColours& colours, std::size_t land, std::vector<LayerOfColour>& layers,
                    const StreetColourOptions& options) {
  std::vector<std::size_t> tunnels;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const bool is_refused = layers[k].layer == MapLayer::land || layers[k].layer == MapLayer::building;
    if (k != land && is_refused && layers[k].ribbon_part >= options.tunnel_ribbon_part &&
        open_colour_of(k, land, colours, layers, options) != k)
      tunnels.push_back(k);
  }
  for (const std::size_t k : tunnels) {
    CentreLines& lines = layers[k].lines;
    std::erase_if(lines.lines, [&](const CentreLine& line) {
      if (length_px(line.points) < options.tunnel_widths * 2.0 * line.radius_px) return true;
      const CasedParts parts = cased_parts(colours.picture, line, options.casings);
      return std::min(parts.left, parts.right) < options.tunnel_side_part;
    });
    join_lines(lines);
    if (!lines.lines.empty()) layers[k].layer = MapLayer::street;
  }
}

/// Radius of a single carriageway in each colour; 0 for a colour that is none of streets.
std::vector<double> radii_of(const std::vector<LayerOfColour>& layers, const StreetColourOptions& options) {
  std::vector<std::size_t> numbers;
  std::vector<const CentreLines*> streets;
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (layers[k].layer == MapLayer::street) {
      numbers.push_back(k);
      streets.push_back(&layers[k].lines);
    }
  const std::vector<double> radii = carriageway_radii(streets, options.carriageways);
  std::vector<double> out(layers.size(), 0.0);
  for (std::size_t i = 0; i < numbers.size(); ++i) out[numbers[i]] = radii[i];
  return out;
}

/// The streets of all colours but one.
Raster<std::uint8_t> other_streets(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                                   std::size_t k) {
  Raster<std::uint8_t> out(colours.of_pixel.width(), colours.of_pixel.height());
  std::transform(colours.of_pixel.values().begin(), colours.of_pixel.values().end(), out.values().begin(),
                 [&](std::uint8_t c) {
                   const bool is_other =
                       c != k && c != MapColours::kNone && layers[c].layer == MapLayer::street;
                   return static_cast<std::uint8_t>(is_other ? 1 : 0);
                 });
  return out;
}

/// Streets with two carriageways that the map draws as one area become two lines. `radii`: of a single
/// carriageway, for each colour; `rims`: lines that are no streets.
void divide_carriageways(const MapColours& colours, std::size_t land, std::vector<LayerOfColour>& layers,
                         const std::vector<double>& radii, const std::vector<std::vector<CentreLine>>& rims,
                         const StreetColourOptions& options) {
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (layers[k].layer != MapLayer::street) continue;
    Raster<std::uint8_t> mask = mask_of(colours, k, options);
    clear_around(mask, rims[k]);
    const auto arrows = find_arrows(colours.picture, mask, colours.colours[k].value, options.arrows);
    CentreLines& lines = layers[k].lines;
    // Tunnels are as wide as the streets of their colour.
    const double radius = radii[open_colour_of(k, land, colours, layers, options)];
    const ThinningGuide guide = carriageways_in(
        mask, lines, radii_by_arrows(mask, lines, arrows, radius, options.arrows), options.carriageways);
    const auto& kept = guide.kept.values();
    if (std::any_of(kept.begin(), kept.end(), [](std::uint8_t v) { return v != 0; })) {
      lines = centre_lines_of(mask, guide, options.lines);
      remove_unseen(lines, colours, options);
    }
    centre_hidden_sides(lines, mask, other_streets(colours, layers, k), options.hidden_sides,
                        options.carriageways);
  }
}

/// Colours that mostly show areas, but streets of a common width as well. `refused`: their lines.
void accept_even_ribbons(const MapColours& colours, std::size_t land, const std::vector<CentreLines>& refused,
                         std::vector<LayerOfColour>& layers, const StreetColourOptions& options) {
  std::vector<MeasuredRadius> measured;
  for (const LayerOfColour& layer : layers)
    for (const CentreLine& line : layer.lines.lines)
      measured.push_back({line.radius_px, length_px(line.points)});
  const std::vector<double> radii = common_radii(std::move(measured), options.carriageways);
  const double least =
      options.least_total_part * std::min(colours.of_pixel.width(), colours.of_pixel.height());
  std::vector<std::size_t> accepted;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (k == land || (layers[k].layer != MapLayer::land && layers[k].layer != MapLayer::building)) continue;
    CentreLines lines = even_ribbons(colours.picture, refused[k], other_streets(colours, layers, k), radii,
                                     options.even_ribbons, options.casings);
    double length = 0.0;
    for (const CentreLine& line : lines.lines) length += length_px(line.points);
    if (length < least) continue;
    layers[k].lines = std::move(lines);
    accepted.push_back(k);
  }
  for (const std::size_t k : accepted) layers[k].layer = MapLayer::street;
}

}  // namespace

std::vector<LayerOfColour> layers_of(const MapColours& colours, const StreetColourOptions& options) {
  const Raster<std::uint8_t>& of_pixel = colours.of_pixel;
  const double side = std::min(of_pixel.width(), of_pixel.height());
  std::vector<LayerOfColour> out(colours.colours.size());
  std::size_t background = 0;
  for (std::size_t k = 0; k < out.size(); ++k)
    if (colours.colours[k].pixels > colours.colours[background].pixels) background = k;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (k == colours.page) continue;
    LayerOfColour& layer = out[k];
    layer.layer = layer_by_hue(colours.colours[k].value, colours.colours[background].value, options);
    if (layer.layer != MapLayer::land) continue;
    const Raster<std::uint8_t> mask = mask_of(colours, k, options);
    layer.lines = centre_lines_of(mask, {}, options.lines);
    remove_unseen(layer.lines, colours, options);
    const std::vector<int> degrees = degrees_of(layer.lines);
    double length = 0.0;
    double area = 0.0;
    double widths = 0.0;
    for (const CentreLine& line : layer.lines.lines) {
      const double ribbon =
          ribbon_length(line, degrees, k == background, options.most_width_part * side, options);
      length += ribbon;
      area += 2.0 * line.radius_px * ribbon;
      widths += ribbon / (2.0 * line.radius_px);
    }
    const Pieces pieces = pieces_of(mask, options.least_building_px);
    layer.ribbon_part = area / std::max(1, pieces.area);
    if (layer.ribbon_part >= options.least_ribbon_part && length >= options.least_total_part * side &&
        widths >= options.least_total_widths) {
      layer.layer = MapLayer::street;
      continue;
    }
    // Buildings are many small pieces, none of which is a large part of the map.
    if (k != background && pieces.count >= options.fewest_buildings &&
        pieces.largest < options.most_building_part * static_cast<double>(of_pixel.count()))
      layer.layer = MapLayer::building;
  }
  accept_tunnels(colours, background, out, options);
  std::vector<CentreLines> refused(out.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (out[k].layer != MapLayer::street) refused[k] = std::exchange(out[k].lines, {});
  const std::vector<double> radii = radii_of(out, options);
  const auto rims = remove_uncased(colours, out, options);
  divide_carriageways(colours, background, out, radii, rims, options);
  accept_even_ribbons(colours, background, refused, out, options);
  return out;
}

}  // namespace palpable::vision
