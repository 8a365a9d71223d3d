// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/core/geometry/street_map.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/formats/scene/map_codec.hpp"
#include "palpable/formats/scene/superquadric_json.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <variant>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

Json matrix_of(const Transform<SceneFrame, models::InputFrame>& transform) {
  const auto& r = transform.rotation;
  const double s = transform.scale;
  const Vec3 t = transform.translation_m;
  return {{s * r[0], s * r[1], s * r[2], t.x},
          {s * r[3], s * r[4], s * r[5], t.y},
          {s * r[6], s * r[7], s * r[8], t.z},
          {0.0, 0.0, 0.0, 1.0}};
}

Json json_of(const models::Material& material) {
  Json json{{"name", material.name},
            {"stiffness_N_per_m", material.stiffness_N_per_m},
            {"damping_Ns_per_m", material.damping_Ns_per_m},
            {"static_friction", material.static_friction},
            {"dynamic_friction", material.dynamic_friction}};
  const auto& texture = material.texture;
  if (texture.kind != models::TouchTexture::Kind::none)
    json["texture"] = {{"kind", models::name_of(texture.kind)},
                       {"pitch_m", texture.pitch_m},
                       {"height_m", texture.height_m},
                       {"angle_rad", texture.angle_rad}};
  return json;
}

/// One line about a material, with its texture if it has one.
std::string words_of(const models::Material& material) {
  std::string words = fmt::format("  material {}: {} N/m, {} N·s/m, friction {} (sliding {})", material.name,
                                  figure(material.stiffness_N_per_m, 3), figure(material.damping_Ns_per_m, 3),
                                  figure(material.static_friction, 3), figure(material.dynamic_friction, 3));
  const auto& texture = material.texture;
  if (texture.kind == models::TouchTexture::Kind::picture)
    words += fmt::format(", texture of a picture, {} wide",
                         describe::length(texture.pitch_m * models::kPictureForms));
  else if (texture.kind != models::TouchTexture::Kind::none)
    words += fmt::format(", texture {} every {}", models::name_of(texture.kind),
                         describe::length(texture.pitch_m));
  if (texture.kind != models::TouchTexture::Kind::none)
    words += fmt::format(", {} um high", figure(1e6 * texture.height_m));
  return words + "\n";
}

Json laws_of(const models::Scene& scene) {
  Json laws = Json::array();
  for (const haptics::Law law : haptics::laws_for(scene)) laws.push_back(haptics::name_of(law));
  return laws;
}

Json json_of(const haptics::LawDescription& law) {
  Json json{{"name", law.name},
            {"title", law.title},
            {"paper", law.paper},
            {"degrees_of_freedom", law.degrees_of_freedom},
            {"conservative", law.conservative},
            {"contact_error", law.contact_error.empty() ? Json(nullptr) : Json(law.contact_error)},
            {"parameters", Json::array()}};
  for (const haptics::LawParameter& p : law.parameters)
    json["parameters"].push_back(
        {{"name", p.name},
         {"title", p.title},
         {"unit", p.unit},
         {"option", p.option.empty() ? Json(nullptr) : Json("--" + std::string(p.option))},
         {"min", p.min},
         {"max", p.max},
         {"default", p.preset ? Json(*p.preset) : Json(nullptr)}});
  return json;
}

std::string sentence_of(const haptics::LawDescription& law) {
  std::string options;
  for (const haptics::LawParameter& p : law.parameters)
    if (!p.option.empty()) options += fmt::format("{}--{}", options.empty() ? "" : " ", p.option);
  const std::string fails = law.contact_error.empty() ? "" : fmt::format("; {}", law.contact_error);
  return fmt::format("  law {}: {} ({}){}; {}\n", law.name, law.title, options, fails, law.paper);
}

void add_model(Answer& answer, const models::Relief& relief) {
  const auto& samples = relief.samples_m();
  answer.json["samples"] = {samples.width(), samples.height()};
  answer.json["pixel_m"] = relief.pixel_m();
  answer.json["lowest_m"] = relief.lowest_m();
  answer.json["highest_m"] = relief.highest_m();
  answer.text += fmt::format("  {} x {} samples of {:.3f} mm, heights {:.2f} to {:.2f} mm\n", samples.width(),
                             samples.height(), 1000.0 * relief.pixel_m(), 1000.0 * relief.lowest_m(),
                             1000.0 * relief.highest_m());
}

void add_primitives(Answer& answer, const std::vector<models::Superquadric>& primitives) {
  answer.json["primitives"] = Json::array();
  for (const models::Superquadric& shape : primitives)
    answer.json["primitives"].push_back(Json(formats::json_of(shape)));
}

void add_model(Answer& answer, const models::Field& field) {
  const models::DistanceField& distance = field.distance;
  const models::FieldGrid& grid = distance.grid();
  // As in the paper: a distance and a force vector, four bytes each, for every finest cell.
  constexpr double kBytes = 16.0;
  const double dense = kBytes * grid.cells(0) * grid.cells(1) * grid.cells(2);
  answer.json["resolution"] = {grid.cells(0), grid.cells(1), grid.cells(2)};
  answer.json["cell_m"] = grid.cell_m;
  answer.json["dense_bytes"] = dense;
  answer.json["cells"] = distance.leaves();
  answer.json["max_error_m"] = distance.errors().bound_m;
  answer.json["measured_error_m"] = {{"p99", distance.errors().p99_m}, {"max", distance.errors().max_m}};
  add_primitives(answer, field.primitives);
  answer.text += fmt::format(
      "  {} cells; {} x {} x {} of {:.3f} mm if dense ({:.0f} MB)\n"
      "  error bound {:.1f} um near smooth surfaces; measured near the surface, edges included: {:.1f} um "
      "(99 %), {:.1f} um at most\n",
      distance.leaves(), grid.cells(0), grid.cells(1), grid.cells(2), 1e3 * grid.cell_m, dense / 1e6,
      1e6 * distance.errors().bound_m, 1e6 * distance.errors().p99_m, 1e6 * distance.errors().max_m);
}

void add_model(Answer& answer, const models::FieldOnLattice& field) {
  const models::Lattice& lattice = field.distance.lattice();
  const bool force = field.distance.content() == models::DenseContent::distance_and_force;
  const models::FieldErrors& errors = field.distance.errors();
  answer.json["resolution"] = lattice.counts;
  answer.json["cell_m"] = lattice.spacing_m;
  answer.json["dense_bytes"] = field.distance.memory_bytes();
  answer.json["content"] = force ? "distance and force" : "distance";
  answer.json["measured_error_m"] = {{"p99", errors.p99_m}, {"max", errors.max_m}};
  add_primitives(answer, field.primitives);
  answer.text += fmt::format(
      "  {} at {} x {} x {} places every {:.3f} mm\n"
      "  error measured near the surface, edges included: {:.1f} um (99 %), {:.1f} um at most\n",
      force ? "distance and force (16 bytes)" : "distance (4 bytes)", lattice.counts[0], lattice.counts[1],
      lattice.counts[2], 1e3 * lattice.spacing_m, 1e6 * errors.p99_m, 1e6 * errors.max_m);
}

void add_model(Answer& answer, const models::Grid& grid) {
  const models::OccupancyGrid& o = grid.occupancy;
  answer.json["points"] = o.counts();
  answer.json["occupied"] = o.occupied_points();
  answer.json["spacing_m"] = o.spacing_m();
  answer.text += fmt::format("  {} x {} x {} points every {:.3f} mm, {} of them occupied\n", o.counts()[0],
                             o.counts()[1], o.counts()[2], 1000.0 * o.spacing_m(), o.occupied_points());
}

/// In pixels of the input picture.
void add_model(Answer& answer, const models::Contours& contours) {
  const models::BoundaryMap& map = contours.boundaries;
  answer.json["width_px"] = map.edges().width();
  answer.json["height_px"] = map.edges().height();
  answer.json["boundary_fraction"] = map.origin().boundary_fraction;
  answer.json["threshold"] = map.origin().threshold;
  answer.json["neighbourhood_px"] = map.radius_px();
  answer.text +=
      fmt::format("  {} x {} pixels, {:.1f} % of them boundary (strength from {:.2f})\n", map.edges().width(),
                  map.edges().height(), 100.0 * map.origin().boundary_fraction, map.origin().threshold);
}

/// In pixels of the input picture.
void add_map(Answer& answer, const StreetMap& map) {
  answer.json.update(formats::json_of(map));
  std::set<std::string> names;
  for (const MapStreet& street : map.streets)
    if (!street.name.empty()) names.insert(street.name);
  answer.text += fmt::format(
      "  {} pieces of streets with {} names, {} junctions, {} areas, on {} x {} pixels\n", map.streets.size(),
      names.size(), map.junctions.size(), map.areas.size(), map.width_px, map.height_px);
}

/// The paper of the method that a scene was made by; empty if none is known.
std::string_view paper_of(const models::Provenance& source) {
  const std::string_view method = source.method;
  constexpr std::string_view kStereo = "stereo, ";
  if (method.starts_with(kStereo)) {
    const auto known = vision::stereo_method_from(
        method.substr(kStereo.size(), method.find(',', kStereo.size()) - kStereo.size()));
    return known ? vision::paper_of(*known) : std::string_view{};
  }
  struct Known {
    std::string_view begin;
    std::string_view paper;
  };
  static constexpr std::array kKnown{
      Known{"contours", "Design and implementation of a graphic-haptic display system, 2006"},
      Known{"field of", "Moustakas et al. 2007"}, Known{"map extract", "Moustakas et al. 2007, sidebar"},
      Known{"street map", "Moustakas et al. 2007, sidebar"}};
  const auto* const known =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& k) { return method.starts_with(k.begin); });
  return known == kKnown.end() ? std::string_view{} : known->paper;
}

Json json_of(const models::Provenance& source) {
  Json json{{"inputs", source.inputs},   {"method", source.method},   {"paper", paper_of(source)},
            {"made_by", source.made_by}, {"command", source.command}, {"files", Json::array()}};
  for (const models::SourceFile& file : source.files)
    json["files"].push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return json;
}

/// How the scene was made and can be made again; empty if it does not state it.
std::string making_words_of(const models::Provenance& source, const std::string& path) {
  if (source.command.empty()) return {};
  constexpr std::size_t kMostWords = 40;
  const std::size_t shown = std::min(source.command.size(), kMostWords);
  return fmt::format(
      "  made with: palpable {}{} ({})\n  make it again: palpable make --again {} -o COPY.palp\n",
      fmt::join(source.command.begin(), source.command.begin() + static_cast<std::ptrdiff_t>(shown), " "),
      shown < source.command.size() ? " ..." : "", source.made_by, path);
}

Result<Answer> info(const std::string& path) {
  const auto file = read_scene_argument(path);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  const Vec3 size = models::size_m(scene);
  const std::size_t memory = std::visit([](const auto& model) { return model->memory_bytes(); }, scene.model);
  const std::string kind = scene.map != nullptr ? "map" : models::kind_of(scene.model);

  Answer answer;
  answer.json = {{"format", file->version},
                 {"kind", kind},
                 {"size_m", {size.x, size.y, size.z}},
                 {"scene_from_input", matrix_of(scene.scene_from_input)},
                 {"scale", scene.scene_from_input.scale},
                 {"memory_bytes", memory},
                 {"file_bytes", file->file_bytes},
                 {"source", json_of(scene.source)},
                 {"materials", Json::array()},
                 {"laws", laws_of(scene)},
                 {"title", scene.title},
                 {"description", scene.description},
                 {"warnings", scene.warnings}};
  for (const models::Material& material : scene.materials)
    answer.json["materials"].push_back(json_of(material));
  answer.json["law_descriptions"] = Json::array();
  for (const haptics::Law law : haptics::laws_for(scene))
    answer.json["law_descriptions"].push_back(json_of(haptics::description_of(law)));
  answer.text = fmt::format("{}: {}, {:.1f} x {:.1f} x {:.1f} mm\n", path, kind, 1000.0 * size.x,
                            1000.0 * size.y, 1000.0 * size.z);
  if (const double scale = scene.scene_from_input.scale; scale != 1.0)
    answer.text +=
        fmt::format("  scale: a length of 1 in the input is {} mm here\n", figure(1000.0 * scale, 4));
  if (!scene.title.empty()) answer.text += fmt::format("  title: {}\n", scene.title);
  if (!scene.description.empty()) answer.text += fmt::format("  description: {}\n", scene.description);
  for (const std::string& warning : scene.warnings) answer.text += fmt::format("  warning: {}\n", warning);
  std::visit([&](const auto& model) { add_model(answer, *model); }, scene.model);
  if (scene.map != nullptr) add_map(answer, *scene.map);
  answer.text += fmt::format("  {:.1f} MB in memory, {:.1f} MB on disk\n", static_cast<double>(memory) / 1e6,
                             static_cast<double>(file->file_bytes) / 1e6);
  for (const haptics::Law law : haptics::laws_for(scene))
    answer.text += sentence_of(haptics::description_of(law));
  constexpr std::size_t kMostNamed = 3;
  if (scene.source.inputs.size() > kMostNamed)
    answer.text += fmt::format("  from {} files, {} the first ({})\n", scene.source.inputs.size(),
                               scene.source.inputs.front(), scene.source.method);
  else if (!scene.source.inputs.empty())
    answer.text +=
        fmt::format("  from {} ({})\n", fmt::join(scene.source.inputs, " and "), scene.source.method);
  if (const std::string_view paper = paper_of(scene.source); !paper.empty())
    answer.text += fmt::format("  method after: {}\n", paper);
  answer.text += making_words_of(scene.source, path);
  for (const models::Material& material : scene.materials) answer.text += words_of(material);
  return answer;
}

}  // namespace

void add_info(Program& program) {
  const auto path = std::make_shared<std::string>();
  Options options =
      add_command(program, "info", "Describe the content of a scene file", "  palpable info aloe.palp",
                  [path](Console& /*console*/) { return info(*path); });
  options.argument("SCENE", *path, "A .palp scene");
}

}  // namespace palpable::cli
