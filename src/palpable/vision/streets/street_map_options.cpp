// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/street_map_from_picture.hpp"

namespace palpable::vision {

std::vector<Parameter> parameters_of(MapFrameOptions& o) {
  return {
      {"page_tolerance", &o.page_tolerance, {0, 255}, "levels", "difference between pixels of the page"},
      {"page_corner_px", &o.page_corner_px, {0, 100}, "px", "where the page is looked at, in the corners"},
      {"closing_px", &o.closing_px, {1, 200}, "px", "widest gap of the map in the page's colour"},
      {"edge_px", &o.edge_px, {1, 50}, "px", "width of the map's edge"},
      {"least_page_part", &o.least_page_part, {0, 1}, "", "part outside of the map in the page's colour"},
      {"least_side_part", &o.least_side_part, {0, 1}, "", "part of a side that differs from the page"},
      {"side_inside_px", &o.side_inside_px, {0, 50}, "px", "how far inside that is measured"},
      {"least_outside_part", &o.least_outside_part, {0, 1}, "", "least part of the picture that is page"},
      {"inset_px", &o.inset_px, {0, 50}, "px", "distance of the frame from the map's edge"}};
}

std::vector<Parameter> parameters_of(MapColourOptions& o) {
  std::vector<Parameter> all{
      {"tolerance", &o.tolerance, {1, 128}, "levels", "difference of a pixel from its colour"},
      {"noise_tolerance", &o.noise_tolerance, {0, 10}, "", "how many times the noise widens it"},
      {"least_edge", &o.least_edge, {1, 255}, "levels", "larger differences are edges, not noise"},
      {"noisy_part", &o.noisy_part, {0, 1}, "", "part of pixels that differ in a noisy picture"},
      {"most_noise", &o.most_noise, {0, 255}, "levels", "by how much half of these differ at most"},
      {"noise_difference", &o.noise_difference, {1, 765}, "levels", "differences that are smoothed in it"},
      {"noise_reach_px", &o.noise_reach_px, {0.5, 10}, "px", "reach of the smoothing"},
      {"noise_rounds", &o.noise_rounds, {1, 10}, "", "how often it is smoothed"},
      {"lossy_part", &o.lossy_part, {0, 1}, "", "part of small differences in a lossy copy"},
      {"least_apart", &o.least_apart, {1, 128}, "levels", "difference of two colours of a clean drawing"},
      {"least_part", &o.least_part, {1e-5, 0.5}, "", "part of the picture that an area's colour fills"},
      {"most_colours", &o.most_colours, {2, 64}, "", "most colours that are distinguished"},
      {"thinnest_px", &o.thinnest_px, {1, 20}, "px", "thinner lines are lettering and borders"},
      {"least_thick_part",
       &o.least_thick_part,
       {0, 1},
       "",
       "part of a colour that is thicker, else it is ink"},
      {"thin_length_px", &o.thin_length_px, {1, 1000}, "px", "thin lines this long are narrow streets"},
      {"symbol_part", &o.symbol_part, {0, 0.5}, "", "a colour of smaller pieces is one of symbols"}};
  append_parameters(all, "frame", parameters_of(o.frame));
  return all;
}

std::vector<Parameter> parameters_of(CentreLineOptions& o) {
  return {{"spur_radii", &o.spur_radii, {0, 10}, "radii", "longest branch that comes from a border"},
          {"spur_px", &o.spur_px, {0, 50}, "px", "and this longer"},
          {"end_part", &o.end_part, {0, 0.4}, "", "part of a line at each end left out of its width"},
          {"least_points", &o.least_points, {0, 1000}, "points", "shorter lines are measured whole"}};
}

std::vector<Parameter> parameters_of(CarriagewayOptions& o) {
  return {{"measured_widths", &o.measured_widths, {0, 20}, "widths", "length of lines whose width is used"},
          {"measured_spread", &o.measured_spread, {0, 1}, "", "spread of their width, as a part of it"},
          {"same_width", &o.same_width, {0, 1}, "", "widths that differ less are the same"},
          {"common_part", &o.common_part, {0, 1}, "", "part of a colour's length with a common width"},
          {"common_widths", &o.common_widths, {0, 1000}, "widths", "or with a length of this many of it"},
          {"next_width", &o.next_width, {1, 5}, "", "how much wider a single carriageway can be"},
          {"width_ratio", &o.width_ratio, {1, 10}, "", "wider colours show two carriageways only"},
          {"least_apart_px", &o.least_apart_px, {0, 50}, "px", "distance of two carriageways' middles"},
          {"most_widths", &o.most_widths, {1, 10}, "widths", "wider places are squares"},
          {"square_margin", &o.square_margin, {0, 10}, "radii", "what is so near to a square belongs to it"},
          {"least_length_widths", &o.least_length_widths, {0, 20}, "widths", "shortest two carriageways"},
          {"side_window", &o.side_window, {0.1, 5}, "radii", "how far to both sides a side is looked at"},
          {"least_side_ratio", &o.least_side_ratio, {0, 1}, "", "how far the border goes on along it"},
          {"least_side_widths", &o.least_side_widths, {0, 20}, "widths", "least length of all sides"},
          {"side_angle_deg", &o.side_angle_deg, {0, 90}, "degrees", "of a side that goes on"}};
}

std::vector<Parameter> parameters_of(ArrowOptions& o) {
  return {{"least_contrast", &o.least_contrast, {1, 255}, "levels", "how much darker an arrow is"},
          {"inside_px", &o.inside_px, {0, 20}, "px", "how far inside of the street it is"},
          {"shortest_px", &o.shortest_px, {1, 100}, "px", "its least length"},
          {"longest_px", &o.longest_px, {1, 100}, "px", "its greatest length"},
          {"least_area_px", &o.least_area_px, {1, 100}, "px", "its least area"},
          {"least_elongation", &o.least_elongation, {1, 10}, "", "how much longer than wide it is"},
          {"apart_lengths", &o.apart_lengths, {0, 10}, "lengths", "distance from other marks"},
          {"least_aside_px", &o.least_aside_px, {0, 50}, "px", "how far it is beside the street's middle"},
          {"least_aside", &o.least_aside, {0, 1}, "radii", "and this"},
          {"most_aside", &o.most_aside, {0, 1}, "radii", "and at most this"},
          {"angle_deg", &o.angle_deg, {0, 90}, "degrees", "its direction to the street's"},
          {"direction_points", &o.direction_points, {1, 50}, "points", "on both sides for that"},
          {"same_radius", &o.same_radius, {0, 1}, "", "radii of carriageways that are the same"},
          {"fewest_of_street", &o.fewest_of_street, {1, 100}, "", "arrows that decide for a street"},
          {"fewest_of_colour", &o.fewest_of_colour, {1, 1000}, "", "and for a colour's streets"},
          {"common_part", &o.common_part, {0, 1}, "", "and this part of all"}};
}

std::vector<Parameter> parameters_of(CasingOptions& o) {
  return {
      {"least_contrast", &o.least_contrast, {0, 255}, "levels", "how much darker a casing is"},
      {"dark_land", &o.dark_land, {0, 255}, "levels", "beside darker land no casing is needed"},
      {"inside_px", &o.inside_px, {0, 20}, "px", "place of the street, from its border"},
      {"casing_inside_px", &o.casing_inside_px, {0, 20}, "px", "where a casing begins, inside the border"},
      {"casing_outside_px", &o.casing_outside_px, {0, 20}, "px", "where it ends, outside the border"},
      {"beside_px", &o.beside_px, {0, 50}, "px", "first place beside the street"},
      {"far_beside_px", &o.far_beside_px, {0, 50}, "px", "second place beside the street"},
      {"step_points", &o.step_points, {1, 20}, "points", "steps along a line"},
      {"direction_points", &o.direction_points, {1, 20}, "points", "on both sides for a direction"},
      {"least_cased_part", &o.least_cased_part, {0, 1}, "", "part of all streets with casings"},
      {"least_line_part", &o.least_line_part, {0, 1}, "", "part of each street with casings"},
      {"least_side_part", &o.least_side_part, {0, 1}, "", "and of each side of it"}};
}

std::vector<Parameter> parameters_of(StreetColourOptions& o) {
  std::vector<Parameter> all{
      {"least_ribbon_part", &o.least_ribbon_part, {0, 1}, "", "part of a colour's area in ribbons"},
      {"tunnel_ribbon_part", &o.tunnel_ribbon_part, {0, 1}, "", "the same of a paler colour, of tunnels"},
      {"least_paler", &o.least_paler, {0, 1}, "", "how much paler tunnels are"},
      {"most_paler", &o.most_paler, {0, 1}, "", "and at most"},
      {"paler_tolerance", &o.paler_tolerance, {0, 128}, "levels", "difference from such a colour"},
      {"tunnel_side_part", &o.tunnel_side_part, {0, 1}, "", "part of each side of a tunnel with casings"},
      {"tunnel_widths", &o.tunnel_widths, {0, 100}, "widths", "shortest piece of a tunnel"},
      {"least_length_widths", &o.least_length_widths, {0, 100}, "widths", "shortest ribbon"},
      {"least_block_widths", &o.least_block_widths, {0, 100}, "widths", "shortest ribbon between junctions"},
      {"most_width_spread", &o.most_width_spread, {0, 2}, "", "spread of a ribbon's width, as a part of it"},
      {"most_width_part", &o.most_width_part, {0, 1}, "", "widest street, as a part of the shorter side"},
      {"least_total_part", &o.least_total_part, {0, 10}, "", "least length of all, in the shorter side"},
      {"least_total_widths", &o.least_total_widths, {0, 1000}, "widths", "least length of all"},
      {"hole_px", &o.hole_px, {0, 1e5}, "px", "area of holes that are symbols"},
      {"least_seen_part", &o.least_seen_part, {0, 1}, "", "part of a street that is not covered"},
      {"broad_radius_px", &o.broad_radius_px, {0, 50}, "px", "broader streets must be seen as areas"},
      {"direction_points", &o.direction_points, {1, 20}, "points", "on both sides for a direction"},
      {"least_blue", &o.least_blue, {1, 255}, "levels", "how much bluer water is than land"},
      {"least_green", &o.least_green, {1, 255}, "levels", "how much greener vegetation is than land"},
      {"fewest_buildings", &o.fewest_buildings, {1, 10000}, "", "pieces that a colour of buildings has"},
      {"least_building_px", &o.least_building_px, {1, 1e5}, "px", "least area of these"},
      {"most_building_part", &o.most_building_part, {0, 1}, "", "largest one, as a part of the picture"}};
  append_parameters(all, "lines", parameters_of(o.lines));
  append_parameters(all, "carriageways", parameters_of(o.carriageways));
  append_parameters(all, "arrows", parameters_of(o.arrows));
  append_parameters(all, "casings", parameters_of(o.casings));
  append_parameters(all, "hidden_sides", parameters_of(o.hidden_sides));
  append_parameters(all, "even_ribbons", parameters_of(o.even_ribbons));
  return all;
}

std::vector<Parameter> parameters_of(StreetGraphOptions& o) {
  return {{"end_radii", &o.end_radii, {0, 50}, "radii", "length of a street's end, for its direction"},
          {"end_px", &o.end_px, {1, 50}, "px", "and this longer"},
          {"border_px", &o.border_px, {0, 50}, "px", "widest border between streets that meet"},
          {"meeting_radii", &o.meeting_radii, {0, 5}, "radii", "how far a street's end is from the other"},
          {"meeting_angle_deg", &o.meeting_angle_deg, {0, 90}, "degrees", "its direction to it"},
          {"meeting_part", &o.meeting_part, {0, 0.5}, "", "how far it is at most, of the shorter side"},
          {"name_angle_deg", &o.name_angle_deg, {0, 90}, "degrees", "direction of lettering on a street"},
          {"name_margin", &o.name_margin, {0, 10}, "heights", "how far behind a street's end it begins"},
          {"name_aside", &o.name_aside, {0, 5}, "heights", "how far beside it the street's end is"},
          {"name_length", &o.name_length, {0, 50}, "heights", "least length of lettering on a street"},
          {"gap_px", &o.gap_px, {0, 1000}, "px", "longest gap that is closed"},
          {"crossing_px", &o.crossing_px, {0, 1000}, "px", "longest part of it on other streets"},
          {"gap_angle_deg", &o.gap_angle_deg, {0, 90}, "degrees", "direction of a gap"},
          {"gap_covered", &o.gap_covered, {0, 1}, "", "part of a gap that is covered"},
          {"gap_width_ratio", &o.gap_width_ratio, {1, 10}, "", "widths on both sides of a gap"},
          {"reach_radii", &o.reach_radii, {0, 10}, "radii", "streets so near to the border go on to it"},
          {"reach_px", &o.reach_px, {0, 50}, "px", "and this farther"},
          {"merge_radii", &o.merge_radii, {0, 10}, "radii", "junctions so near are one"},
          {"merge_px", &o.merge_px, {0, 50}, "px", "and this farther"},
          {"loop_radii", &o.loop_radii, {0, 50}, "radii", "shorter loops are none"},
          {"spur_radii", &o.spur_radii, {0, 10}, "radii", "shorter branches are none"},
          {"spur_px", &o.spur_px, {0, 50}, "px", "and this longer"},
          {"least_network_part", &o.least_network_part, {0, 1}, "", "least network, of the shorter side"},
          {"least_network_radii", &o.least_network_radii, {0, 100}, "radii", "least network"},
          {"fragment_part", &o.fragment_part, {0, 1}, "", "part of that before gaps are closed"}};
}

std::vector<Parameter> parameters_of(StreetNameOptions& o) {
  std::vector<Parameter> all{
      {"least_part_on_street", &o.least_part_on_street, {0, 1}, "", "part of a name on its street"},
      {"aside", &o.aside, {0, 5}, "heights", "how far it is beside the street's middle"},
      {"aside_deg", &o.aside_deg, {0, 90}, "degrees", "its direction there"},
      {"step_points", &o.step_points, {1, 20}, "points", "steps along a name"},
      {"crossing_part", &o.crossing_part, {0, 1}, "", "a street with a smaller part crosses"},
      {"same_name", &o.same_name, {0, 1}, "", "similarity of readings of one name"},
      {"divided_part", &o.divided_part, {0, 1}, "", "part of a name on a street that it divides"},
      {"most_turn_deg", &o.most_turn_deg, {0, 180}, "degrees", "turn over which a name goes on"},
      {"most_width_change", &o.most_width_change, {0, 1}, "", "change of width over which it does"},
      {"end_widths", &o.end_widths, {0, 20}, "widths", "length of a street's end, for its direction"},
      {"least_end_px", &o.least_end_px, {1, 100}, "px", "at least"},
      {"least_confidence", &o.least_confidence, {0, 1}, "", "of a street's name without a gazetteer"},
      {"border_heights", &o.border_heights, {0, 5}, "heights", "nearer to the border it may be cut off"},
      {"least_similarity", &o.least_similarity, {0, 1}, "", "with a name of the gazetteer"}};
  append_parameters(all, "stacked", parameters_of(o.stacked));
  return all;
}

std::vector<Parameter> parameters_of(MapRecognitionOptions& o) {
  return {{"dead_ends_per_junction", &o.dead_ends_per_junction, {0, 100}, "", "more are no map"},
          {"most_street_part", &o.most_street_part, {0, 1}, "", "part of a map in colours of streets"},
          {"border_px", &o.border_px, {0, 50}, "px", "ends so near to the border are no dead ends"},
          {"edge_radii", &o.edge_radii, {0, 10}, "radii", "one street so near to a side is no map"},
          {"least_flat_part", &o.least_flat_part, {0, 1}, "", "part of streets that is flat in a drawing"},
          {"lossy_length", &o.lossy_length, {0, 100}, "", "least length of streets else, in shorter sides"},
          {"lossy_ribbon_part", &o.lossy_ribbon_part, {0, 1}, "", "part of that of constant width"},
          {"least_junctions", &o.least_junctions, {0, 1000}, "", "fewer junctions need few colours"},
          {"most_colours", &o.most_colours, {2, 64}, "", "these are few colours"},
          {"ink_contrast", &o.ink_contrast, {0, 255}, "levels", "how dark the lines of tables are"},
          {"upright_part", &o.upright_part, {0, 1}, "", "part of a table's lines along the sides"},
          {"upright_deg", &o.upright_deg, {0, 45}, "degrees", "lines along a side"},
          {"straight_error_px", &o.straight_error_px, {0.1, 20}, "px", "error of these lines' pieces"}};
}

std::vector<Parameter> parameters_of(MapOutlineOptions& o) {
  return {{"least_area_px", &o.least_area_px, {0, 1e6}, "px", "smaller areas are left out"},
          {"area_error_px", &o.area_error_px, {0, 20}, "px", "error of a simplified outline"},
          {"smoothing_radii", &o.smoothing_radii, {0, 5}, "radii", "reach of a line's smoothing"},
          {"least_smoothing_points", &o.least_smoothing_points, {0, 50}, "points", "at least"},
          {"line_error_px", &o.line_error_px, {0, 20}, "px", "error of a simplified line"}};
}

std::vector<Parameter> parameters_of(StreetMapOptions& o) {
  std::vector<Parameter> all{
      {"dark_land", &o.dark_land, {0, 255}, "levels", "on darker land lettering is light"}};
  append_parameters(all, "colours", parameters_of(o.colours));
  append_parameters(all, "streets", parameters_of(o.streets));
  append_parameters(all, "text", parameters_of(o.text));
  append_parameters(all, "graph", parameters_of(o.graph));
  append_parameters(all, "dashes", parameters_of(o.dashes));
  append_parameters(all, "recognition", parameters_of(o.recognition));
  append_parameters(all, "outlines", parameters_of(o.outlines));
  append_parameters(all, "reading", parameters_of(o.reading));
  append_parameters(all, "words", parameters_of(o.words));
  append_parameters(all, "pieces", parameters_of(o.pieces));
  append_parameters(all, "along_streets", parameters_of(o.along_streets));
  append_parameters(all, "extension", parameters_of(o.extension));
  append_parameters(all, "followed", parameters_of(o.followed));
  append_parameters(all, "under_names", parameters_of(o.under_names));
  append_parameters(all, "names", parameters_of(o.names));
  return all;
}

Result<void> check(const StreetMapOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range;
  if (options.text.smallest_letter_px < options.text.largest_letter_px) return {};
  return Error{ErrorCode::usage, "the first must be below the second",
               "text.smallest_letter_px, text.largest_letter_px"};
}

}  // namespace palpable::vision
