// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "drawn_maps.hpp"

namespace palpable::bench {
namespace {

constexpr Rgb8 kWhite{255, 255, 255};
constexpr Rgb8 kBlack{0, 0, 0};

/// Like the standard map of OpenStreetMap: coloured main streets, white side streets with thin grey borders,
/// small letters with halos, and all that it shows besides streets.
DrawnMapStyle carto() {
  DrawnMapStyle s;
  s.name = "carto";
  s.width_power = 0.9;
  s.font_power = 0.35;
  s.zoom_out = 1.15;
  s.motorway = {{232, 146, 162}, {220, 42, 103}, 14.0, 0.9};
  s.trunk = {{249, 178, 156}, {200, 78, 47}, 14.0, 0.9};
  s.major = {{252, 214, 164}, {160, 107, 0}, 14.0, 0.8};
  s.middle = {{247, 250, 191}, {112, 125, 5}, 14.0, 0.8};
  s.tertiary = {kWhite, {143, 143, 143}, 13.0, 0.7};
  s.minor = {kWhite, {187, 187, 187}, 9.0, 0.6};
  s.service = {kWhite, {187, 187, 187}, 4.8, 0.5};
  s.pedestrian = {{221, 221, 232}, {153, 153, 153}, 8.0, 0.6};
  s.path = {250, 128, 114};
  s.track = {153, 102, 0};
  s.green = {173, 209, 158};
  s.font = "DejaVu Sans Condensed";
  s.font_px = 10.5;
  s.ink = {34, 34, 34};
  s.halo_px = 1.0;
  s.halo_of_street = true;
  s.repeat_px = 300.0;
  s.tunnel_fade = 0.5;
  s.details = true;
  return s;
}

/// White streets on grey, nothing else, with a serif font.
DrawnMapStyle plain() {
  DrawnMapStyle s;
  s.name = "plain";
  s.land = {214, 214, 214};
  s.water = {190, 200, 210};
  s.green = {205, 212, 203};
  s.buildings = false;
  s.major = {kWhite, kWhite, 14.0, 0.0};
  s.middle = {kWhite, kWhite, 11.0, 0.0};
  s.minor = {kWhite, kWhite, 8.0, 0.0};
  s.service = {kWhite, kWhite, 4.0, 0.0};
  s.pedestrian = {kWhite, kWhite, 6.0, 0.0};
  s.path = {240, 240, 240};
  s.track = {245, 245, 245};
  s.rail = {150, 150, 150};
  s.font = "DejaVu Serif Condensed";
  s.ink = {50, 50, 50};
  s.font_px = 11.5;
  return s;
}

/// Black and white print with black buildings, scanned a little crooked.
DrawnMapStyle print() {
  DrawnMapStyle s = plain();
  s.name = "print";
  s.land = {232, 232, 232};
  s.buildings = true;
  s.building = {40, 40, 40};
  s.building_line = kBlack;
  s.water = {185, 185, 185};
  s.green = {215, 215, 215};
  for (StreetPaint* p : {&s.major, &s.middle, &s.minor, &s.service, &s.pedestrian}) {
    p->casing = kBlack;
    p->casing_px = 1.0;
  }
  s.path = {90, 90, 90};
  s.track = {60, 60, 60};
  s.font = "DejaVu Sans Condensed Bold";
  s.ink = kBlack;
  s.font_px = 10.5;
  s.skew_deg = 1.5;
  s.blur_px = 0.6;
  s.noise = 5.0;
  return s;
}

/// Night colours: dark land, lighter streets, light letters with dark halos.
DrawnMapStyle night() {
  DrawnMapStyle s;
  s.name = "night";
  s.land = {29, 44, 77};
  s.building = {38, 54, 90};
  s.building_line = {45, 62, 100};
  s.water = {14, 22, 38};
  s.green = {33, 60, 74};
  s.major = {{176, 140, 70}, {90, 70, 30}, 13.0, 1.0};
  s.middle = {{98, 120, 160}, {60, 75, 105}, 11.0, 1.0};
  s.minor = {{70, 92, 132}, {20, 32, 60}, 9.0, 0.8};
  s.service = {{62, 82, 118}, {20, 32, 60}, 4.5, 0.6};
  s.pedestrian = {{80, 84, 124}, {20, 32, 60}, 7.0, 0.8};
  s.path = {90, 90, 120};
  s.track = {100, 90, 80};
  s.rail = {90, 96, 110};
  s.ink = {235, 238, 245};
  s.halo = {16, 24, 48};
  s.halo_px = 1.5;
  s.font = "DejaVu Sans Condensed";
  s.font_px = 11.5;
  return s;
}

/// Coloured by class with strong borders, as route planners draw, saved as JPEG.
DrawnMapStyle classes() {
  DrawnMapStyle s;
  s.name = "classes";
  s.land = {248, 244, 228};
  s.building = {232, 214, 200};
  s.building_line = {214, 190, 174};
  s.water = {150, 195, 230};
  s.green = {196, 226, 170};
  s.major = {{240, 120, 100}, {150, 40, 30}, 13.0, 1.5};
  s.middle = {{255, 220, 90}, {170, 130, 20}, 11.0, 1.5};
  s.minor = {kWhite, {150, 150, 150}, 8.5, 1.0};
  s.service = {kWhite, {160, 160, 160}, 4.0, 1.0};
  s.pedestrian = {{240, 225, 240}, {150, 130, 150}, 7.0, 1.0};
  s.ink = {30, 30, 60};
  s.halo = kWhite;
  s.halo_px = 1.2;
  s.font = "DejaVu Sans Bold";
  s.font_px = 9.5;
  s.tunnel_fade = 0.5;
  s.jpeg_quality = 80;
  return s;
}

/// A school atlas: red and yellow streets between dark lines on pale paper, italic capitals, scanned.
DrawnMapStyle atlas() {
  DrawnMapStyle s;
  s.name = "atlas";
  s.land = {250, 240, 205};
  s.building = {228, 170, 150};
  s.building_line = {190, 120, 100};
  s.water = {160, 205, 235};
  s.green = {205, 225, 160};
  s.major = {{225, 85, 70}, {90, 30, 20}, 10.0, 1.2};
  s.middle = {{250, 215, 100}, {110, 80, 20}, 9.0, 1.2};
  s.minor = {{253, 251, 243}, {120, 110, 100}, 7.5, 1.0};
  s.service = {{253, 251, 243}, {150, 140, 130}, 4.0, 0.8};
  s.pedestrian = {{253, 251, 243}, {120, 110, 100}, 6.0, 1.0};
  s.ink = {40, 30, 30};
  s.font = "DejaVu Serif Condensed Italic";
  s.font_px = 12.0;
  s.skew_deg = 2.0;
  s.blur_px = 0.5;
  s.noise = 3.0;
  s.jpeg_quality = 88;
  return s;
}

/// Pale background maps, whose streets differ little from the land.
DrawnMapStyle pale() {
  DrawnMapStyle s;
  s.name = "pale";
  s.land = {238, 238, 236};
  s.building = {228, 228, 225};
  s.building_line = {218, 218, 215};
  s.water = {203, 210, 214};
  s.green = {225, 232, 222};
  for (StreetPaint* p : {&s.major, &s.middle, &s.minor, &s.service, &s.pedestrian})
    *p = {kWhite, {220, 220, 218}, 9.0, 0.8};
  s.major.width_px = 14.0;
  s.middle.width_px = 12.0;
  s.service.width_px = 4.5;
  s.path = {225, 220, 215};
  s.track = {222, 216, 206};
  s.ink = {95, 95, 95};
  s.halo = kWhite;
  s.halo_px = 1.2;
  s.capitals = true;
  s.font = "DejaVu Sans Condensed";
  s.font_px = 9.5;
  return s;
}

/// The first style, printed, scanned and strongly compressed.
DrawnMapStyle scan() {
  DrawnMapStyle s = carto();
  s.name = "scan";
  s.land = {236, 230, 218};
  s.font_px = 12.0;
  s.skew_deg = 1.0;
  s.blur_px = 0.7;
  s.noise = 4.0;
  s.jpeg_quality = 60;
  return s;
}

}  // namespace

std::vector<DrawnMapStyle> drawn_map_styles() {
  return {carto(), plain(), print(), night(), classes(), atlas(), pale(), scan()};
}

}  // namespace palpable::bench
