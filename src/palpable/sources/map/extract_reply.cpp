// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/map/extract_reply.hpp"

#include "palpable/sources/isolated/flat.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::sources::isolated {
namespace {

constexpr std::size_t kLongestName = 300;

void put_points(FlatWriter& reply, const std::vector<GeoPoint>& points) {
  reply.put(static_cast<std::uint64_t>(points.size()));
  reply.put_array(std::span<const GeoPoint>(points));
}

std::vector<GeoPoint> get_points(FlatReader& reply) {
  return reply.get_array<GeoPoint>(reply.get<std::uint64_t>());
}

bool are_on_earth(const std::vector<GeoPoint>& points) {
  return std::all_of(points.begin(), points.end(), [](const GeoPoint& p) {
    return std::abs(p.latitude) <= 90.0 && std::abs(p.longitude) <= 180.0;
  });
}

}  // namespace

std::vector<std::byte> reply_of(const MapExtract& extract) {
  FlatWriter reply;
  begin_value(reply);
  reply.put(static_cast<std::uint64_t>(extract.ways.size()));
  for (const ExtractWay& way : extract.ways) {
    reply.put_text(way.kind);
    reply.put_text(way.name);
    reply.put(way.width_m);
    reply.put(static_cast<std::uint8_t>(way.tunnel));
    reply.put(static_cast<std::uint8_t>(way.roundabout));
    put_points(reply, way.points);
    reply.put_array(std::span<const std::int64_t>(way.nodes));
  }
  reply.put(static_cast<std::uint64_t>(extract.areas.size()));
  for (const ExtractArea& area : extract.areas) {
    reply.put(static_cast<std::uint8_t>(area.kind));
    put_points(reply, area.ring);
  }
  reply.put(static_cast<std::uint64_t>(extract.places.size()));
  for (const ExtractPlace& place : extract.places) {
    reply.put(static_cast<std::uint8_t>(place.kind));
    reply.put_text(place.name);
    reply.put(place.at);
    reply.put(static_cast<std::uint8_t>(place.tactile_paving));
    put_points(reply, place.ring);
  }
  return reply.take();
}

Result<MapExtract> map_extract_in(std::span<const std::byte> bytes) {
  FlatReader reply(bytes);
  if (auto opened = open_reply(reply); !opened) return std::move(opened).error();
  MapExtract extract;
  const auto ways = reply.get<std::uint64_t>();
  for (std::uint64_t k = 0; k < ways && reply.ok(); ++k) {
    ExtractWay way;
    way.kind = reply.get_text(kLongestName);
    way.name = reply.get_text(kLongestName);
    way.width_m = reply.get<double>();
    way.tunnel = reply.get<std::uint8_t>() == 1;
    way.roundabout = reply.get<std::uint8_t>() == 1;
    way.points = get_points(reply);
    way.nodes = reply.get_array<std::int64_t>(way.points.size());
    const bool has_width = way.width_m >= 0.0 && way.width_m <= 1000.0;
    if (!reply.ok() || way.points.size() < 2 || !are_on_earth(way.points) || !has_width)
      return invalid_reply();
    extract.ways.push_back(std::move(way));
  }
  const auto areas = reply.get<std::uint64_t>();
  for (std::uint64_t k = 0; k < areas && reply.ok(); ++k) {
    const auto kind = reply.get<std::uint8_t>();
    ExtractArea area{static_cast<ExtractArea::Kind>(kind), get_points(reply)};
    if (!reply.ok() || kind > static_cast<std::uint8_t>(ExtractArea::Kind::green) || area.ring.size() < 3 ||
        !are_on_earth(area.ring))
      return invalid_reply();
    extract.areas.push_back(std::move(area));
  }
  const auto places = reply.get<std::uint64_t>();
  for (std::uint64_t k = 0; k < places && reply.ok(); ++k) {
    const auto kind = reply.get<std::uint8_t>();
    ExtractPlace place;
    place.kind = static_cast<MapPlace::Kind>(kind);
    place.name = reply.get_text(kLongestName);
    place.at = reply.get<GeoPoint>();
    place.tactile_paving = reply.get<std::uint8_t>() == 1;
    place.ring = get_points(reply);
    if (!reply.ok() || kind > static_cast<std::uint8_t>(MapPlace::Kind::entrance) ||
        !are_on_earth({place.at}) || !are_on_earth(place.ring))
      return invalid_reply();
    extract.places.push_back(std::move(place));
  }
  if (!reply.done()) return invalid_reply();
  return extract;
}

}  // namespace palpable::sources::isolated
