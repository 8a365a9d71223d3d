// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/map_options.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/vision/streets/names/gazetteer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Parses "LAT,LON" in degrees; spaces may follow the comma, as maps in browsers write it. Errors: usage.
Result<sources::GeoPoint> geo_point_from(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto latitude = finite_number(std::string_view(text).substr(0, comma));
  const std::size_t second = comma == std::string::npos ? comma : text.find_first_not_of(' ', comma + 1);
  const auto longitude =
      second == std::string::npos ? std::nullopt : finite_number(std::string_view(text).substr(second));
  if (latitude && longitude && std::abs(*latitude) <= 85.0 && std::abs(*longitude) <= 180.0)
    return sources::GeoPoint{*latitude, *longitude};
  return Error{ErrorCode::usage,
               fmt::format("'{}' is not LATITUDE,LONGITUDE in degrees, as 47.1410,9.5220", text), "--center"};
}

/// Parses "steps,stops", "all" or "none". Errors: usage.
Result<sources::ExtractLayers> layers_from(std::string_view text) {
  sources::ExtractLayers layers;
  const std::array<std::pair<std::string_view, bool*>, 5> known{{{"sidewalks", &layers.sidewalks},
                                                                 {"crossings", &layers.crossings},
                                                                 {"steps", &layers.steps},
                                                                 {"entrances", &layers.entrances},
                                                                 {"stops", &layers.stops}}};
  if (text == "none") return layers;
  if (text == "all") return sources::ExtractLayers{true, true, true, true, true};
  for (bool more = true; more;) {
    const std::size_t comma = text.find(',');
    more = comma != std::string_view::npos;
    const std::string_view name = text.substr(0, comma);
    const auto layer =
        std::find_if(known.begin(), known.end(), [name](const auto& one) { return one.first == name; });
    if (layer == known.end())
      return Error{
          ErrorCode::usage,
          fmt::format(
              "'{}' is no layer of a map; there are sidewalks, crossings, steps, entrances and stops, "
              "with commas between them, or all, or none",
              name),
          "--layers"};
    *layer->second = true;
    if (more) text.remove_prefix(comma + 1);
  }
  return layers;
}

}  // namespace

void add_map_options(Options& options, MapArguments& arguments) {
  options.under("Street maps");
  options.text("--center", arguments.center,
               "OpenStreetMap extract: the middle of the map, LATITUDE,LONGITUDE in degrees; default: the "
               "street nearest to the median of all");
  options.number("--width", arguments.window_m, {50.0, 20000.0},
                 "OpenStreetMap extract: width of the map, m; default: 600");
  options.text(
      "--layers", arguments.layers,
      "OpenStreetMap extract: what is shown beside streets, of sidewalks, crossings, steps, entrances and "
      "stops, as 'steps,stops', or all, or none; default: stops up to a width of 1000 m, crossings and "
      "steps up to 300 m");
  options.text("--gazetteer", arguments.gazetteer,
               "Picture of a map: a file of street names, one a line; read names are corrected by it");
}

Result<sources::ExtractWindow> window_of(const MapArguments& arguments) {
  sources::ExtractWindow window;
  if (arguments.window_m) window.width_m = *arguments.window_m;
  if (!arguments.layers.empty()) {
    const auto layers = layers_from(arguments.layers);
    if (!layers) return layers.error();
    window.layers = *layers;
  }
  if (arguments.center.empty()) return window;
  const auto center = geo_point_from(arguments.center);
  if (!center) return center.error();
  window.center = *center;
  return window;
}

Result<std::vector<std::string>> gazetteer_of(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) return text.error();
  auto names = vision::parse_gazetteer(*text);
  if (!names) return invalid_input(names.error().message, path);
  return names;
}

}  // namespace palpable::cli
