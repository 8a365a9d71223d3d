// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/scene_file.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/text/json_integer.hpp"
#include "palpable/formats/picture/jpeg.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/formats/scene/map_codec.hpp"
#include "palpable/formats/scene/material_codec.hpp"
#include "palpable/formats/scene/model_codec.hpp"
#include "palpable/formats/scene/scene_limits.hpp"
#include "palpable/formats/scene/second_view_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

using nlohmann::json;

constexpr int kMajor = 1;
constexpr int kMinor = 0;
constexpr const char* kFormat = "palpable-scene";
constexpr const char* kDescription = "scene.json";
constexpr const char* kTexture = "texture.png";
constexpr const char* kLabels = "labels.png";
constexpr const char* kMap = "map.json";
constexpr std::size_t kMaxDescriptionBytes = std::size_t{16} << 20U;

struct Reader {
  std::string_view kind;
  Result<models::Model> (*read)(const json& description, const ZipMembers& members);
};
/// A new kind of models::Model is added here and in write_model().
constexpr std::array<Reader, 5> kReaders{{{"relief", read_relief},
                                          {"contours", read_contours},
                                          {"field", read_field},
                                          {"grid", read_grid},
                                          {"dense-field", read_dense_field}}};

Result<void> write_model(const models::Model& model, json& description, ZipMembers& members) {
  if (const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&model))
    return write_relief(**relief, description, members);
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&model))
    return write_field(**field, description, members);
  if (const auto* grid = std::get_if<std::shared_ptr<const models::Grid>>(&model))
    return write_grid(**grid, description, members);
  if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&model))
    return write_dense_field(**dense, description, members);
  return write_contours(*std::get<std::shared_ptr<const models::Contours>>(model), description, members);
}

using SceneFromInput = Transform<SceneFrame, models::InputFrame>;

json to_json(const SceneFromInput& t) {
  return {{"rotation", t.rotation},
          {"translation_m", {t.translation_m.x, t.translation_m.y, t.translation_m.z}},
          {"scale", t.scale}};
}

SceneFromInput transform_from(const json& j) {
  const auto move = j.at("translation_m").get<std::array<double, 3>>();
  return {j.at("rotation").get<std::array<double, 9>>(),
          {move[0], move[1], move[2]},
          j.at("scale").get<double>()};
}

Result<Raster<Rgb8>> texture_from(const Bytes& member) {
  const auto image = has_magic(member, "\xFF\xD8") ? decode_jpeg(member) : decode_png(member);
  if (!image) return invalid_input("its picture " + image.error().message);
  return rgb8(*image);
}

Result<Raster<std::uint8_t>> labels_from(const Bytes& member) {
  const auto image = decode_png(member);
  if (!image) return invalid_input("its map of materials " + image.error().message);
  if (image->channels != 1 || image->bits != 8)
    return invalid_input("holds a map of materials that is not an 8-bit grey picture");
  Raster<std::uint8_t> labels(image->width, image->height);
  std::transform(image->samples.begin(), image->samples.end(), labels.values().begin(),
                 [](float v) { return static_cast<std::uint8_t>(std::lround(255.0F * v)); });
  return labels;
}

Result<void> check_version(const json& description, SceneFile& out) {
  const int major = integer_from<int>(description.at("version").at("major"));
  const int minor = integer_from<int>(description.at("version").at("minor"));
  out.version = std::to_string(major) + "." + std::to_string(minor);
  if (minor < 0) return invalid_input("states the impossible format version " + out.version);
  if (major != kMajor)
    return invalid_input("is a scene of format version " + out.version + ", but this program reads version " +
                         std::to_string(kMajor) + ": use a newer program or make the scene again");
  return {};
}

json json_of(Place p) { return json{p.x_m, p.y_m}; }

Place place_from(const json& j) {
  const auto at = j.get<std::array<double, 2>>();
  return {at[0], at[1]};
}

/// In the order of models::PlaceName::Extent; an unknown one is a point.
constexpr std::array<std::string_view, 4> kExtents{"point", "line", "area", "label"};

json names_json(const models::PlaceNames& names) {
  json list = json::array();
  for (const models::PlaceName& name : names) {
    json j{{"name", name.name}, {"at_m", json_of(name.at)}};
    if (!name.sentence.empty()) j["sentence"] = name.sentence;
    if (name.extent != models::PlaceName::Extent::point)
      j["extent"] = kExtents.at(static_cast<std::size_t>(name.extent));
    for (const Place p : name.line) j["line_m"].push_back(json_of(p));
    list.push_back(std::move(j));
  }
  return list;
}

/// Absent in older files.
models::PlaceNames names_from(const json& description) {
  models::PlaceNames names;
  for (const json& j : description.value("names", json::array())) {
    models::PlaceName name{j.at("name").get<std::string>(), j.value("sentence", std::string()),
                           place_from(j.at("at_m"))};
    const auto extent = std::find(kExtents.begin(), kExtents.end(), j.value("extent", std::string()));
    if (extent != kExtents.end())
      name.extent = static_cast<models::PlaceName::Extent>(extent - kExtents.begin());
    for (const json& p : j.value("line_m", json::array())) name.line.push_back(place_from(p));
    names.push_back(std::move(name));
  }
  return names;
}

/// The size is that of the model; it is stated for other programs, and shows that a number of the model was
/// damaged. Absent in older files.
Result<void> check_stated_size(const json& description, const models::Scene& scene) {
  if (!description.contains("size_m")) return {};
  const json& size = description.at("size_m");
  const auto is_length = [](const json& side) {
    return side.is_number() && std::isfinite(side.get<double>()) && side.get<double>() >= 0.0;
  };
  if (!size.is_array() || size.size() != 3 || !std::all_of(size.begin(), size.end(), is_length))
    return invalid_input("states a size that is not three lengths");
  const Vec3 real = models::size_m(scene);
  // What other versions may round or count otherwise.
  constexpr double kShare = 0.1, kLeast_m = 1e-4;
  const auto agrees = [](const json& stated, double side) {
    return std::abs(stated.get<double>() - side) <= kShare * std::abs(side) + kLeast_m;
  };
  if (agrees(size[0], real.x) && agrees(size[1], real.y) && agrees(size[2], real.z)) return {};
  return invalid_input("is damaged: its model does not have the size that it states");
}

/// Removes the member that `key` names from `members`; nullopt if the scene has none.
Result<std::optional<Bytes>> member_named(const json& description, const char* key, ZipMembers& members) {
  if (!description.contains(key)) return std::optional<Bytes>();
  const auto name = description.at(key).get<std::string>();
  auto node = members.extract(name);
  if (node.empty()) return invalid_input("lacks its member " + name);
  return std::optional(std::move(node.mapped()));
}

Result<void> read_pictures(const json& description, ZipMembers& members, models::Scene& scene) {
  auto texture = member_named(description, "texture", members);
  if (!texture) return std::move(texture).error();
  if (*texture) {
    auto picture = texture_from(**texture);
    if (!picture) return std::move(picture).error();
    scene.texture = *std::move(picture);
  }
  auto labels = member_named(description, "labels", members);
  if (!labels) return std::move(labels).error();
  if (*labels) {
    auto map = labels_from(**labels);
    if (!map) return std::move(map).error();
    scene.labels = *std::move(map);
  }
  // Absent in older files.
  if (description.contains("second_view")) {
    auto view = read_second_view(description.at("second_view"), members);
    if (!view) return std::move(view).error();
    scene.second_view = std::make_shared<const models::SecondView>(*std::move(view));
  }
  return {};
}

/// How it was made is absent in older files.
void read_source(const json& description, models::Provenance& source) {
  const json& j = description.at("source");
  source.inputs = j.at("inputs").get<std::vector<std::string>>();
  source.method = j.at("method").get<std::string>();
  source.made_by = j.at("made_by").get<std::string>();
  source.command = j.value("command", std::vector<std::string>());
  for (const json& file : j.value("files", json::array()))
    source.files.push_back({file.at("name").get<std::string>(), integer_from<std::uint64_t>(file.at("bytes")),
                            file.at("sha256").get<std::string>()});
}

json source_json(const models::Provenance& source) {
  json j{{"inputs", source.inputs}, {"method", source.method}, {"made_by", source.made_by}};
  if (!source.command.empty()) j["command"] = source.command;
  for (const models::SourceFile& file : source.files)
    j["files"].push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return j;
}

/// How a solid lies, the maker's title and description, and warnings; absent in older files.
void read_pose_and_words(const json& description, models::Scene& scene) {
  const bool flat = description.value("pose", std::string()) == "flat";
  scene.pose = flat ? models::SolidPose::flat : models::SolidPose::upright;
  scene.title = description.value("title", std::string());
  scene.description = description.value("description", std::string());
  scene.warnings = description.value("warnings", std::vector<std::string>());
}

Result<SceneFile> scene_from(const json& description, ZipMembers members) {
  SceneFile out;
  if (description.at("format").get<std::string>() != kFormat) return invalid_input("is not a Palpable scene");
  if (auto version = check_version(description, out); !version) return std::move(version).error();
  const auto kind = description.at("kind").get<std::string>();
  const auto* reader =
      std::find_if(kReaders.begin(), kReaders.end(), [&kind](const Reader& r) { return r.kind == kind; });
  if (reader == kReaders.end())
    return invalid_input("is a scene of the kind '" + kind + "', which is not known here");
  auto model = reader->read(description.at("model"), members);
  if (!model) return std::move(model).error();
  out.scene.model = *std::move(model);
  read_pose_and_words(description, out.scene);
  out.scene.names = names_from(description);
  const json& materials = description.at("materials");
  if (materials.size() > kMaxMaterials) return invalid_input("states more than 256 materials");
  out.scene.materials.clear();
  for (const json& j : materials) {
    auto material = read_material(j, members);
    if (!material) return std::move(material).error();
    out.scene.materials.push_back(*std::move(material));
  }
  out.scene.scene_from_input = transform_from(description.at("scene_from_input"));
  read_source(description, out.scene.source);
  if (auto pictures = read_pictures(description, members, out.scene); !pictures)
    return std::move(pictures).error();
  auto map = member_named(description, "map", members);
  if (!map) return std::move(map).error();
  if (*map) {
    auto decoded = decode_street_map(**map);
    if (!decoded) return std::move(decoded).error();
    out.scene.map = std::make_shared<const StreetMap>(*std::move(decoded));
  }
  if (auto valid = check_scene(out.scene); !valid) return std::move(valid).error();
  if (auto size = check_stated_size(description, out.scene); !size) return std::move(size).error();
  for (const json& value : description.at("model")) {
    if (value.is_string()) members.erase(value.get<std::string>());
    if (!value.is_array()) continue;
    for (const json& part : value)
      if (part.is_string()) members.erase(part.get<std::string>());
  }
  out.others = std::move(members);
  return out;
}

}  // namespace

Result<Bytes> encode_scene(const models::Scene& scene, const ZipMembers& others) {
  if (auto valid = check_scene(scene); !valid) return std::move(valid).error();
  ZipMembers members = others;
  json model;
  if (auto written = write_model(scene.model, model, members); !written) return std::move(written).error();
  const Vec3 size = models::size_m(scene);
  json description{
      {"format", kFormat},
      {"version", {{"major", kMajor}, {"minor", kMinor}}},
      {"frame", "right-handed, x right, y up, z towards the user; origin at the centre of the base"},
      {"units", "m"},
      {"kind", models::kind_of(scene.model)},
      {"size_m", {size.x, size.y, size.z}},
      {"model", model},
      {"materials", json::array()},
      {"scene_from_input", to_json(scene.scene_from_input)},
      {"source", source_json(scene.source)}};
  if (models::is_field(scene.model) && scene.pose == models::SolidPose::flat) description["pose"] = "flat";
  if (!scene.title.empty()) description["title"] = scene.title;
  if (!scene.description.empty()) description["description"] = scene.description;
  if (!scene.warnings.empty()) description["warnings"] = scene.warnings;
  if (!scene.names.empty()) description["names"] = names_json(scene.names);
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    auto material = write_material(scene.materials[k], k, members);
    if (!material) return std::move(material).error();
    description["materials"].push_back(*std::move(material));
  }
  const auto add_picture = [&](const char* key, const char* name, const auto& picture) -> Result<void> {
    if (picture.empty()) return {};
    auto file = encode_png(picture);
    if (!file) return std::move(file).error();
    members[name] = *std::move(file);
    description[key] = name;
    return {};
  };
  if (auto added = add_picture("texture", kTexture, scene.texture); !added) return std::move(added).error();
  if (auto added = add_picture("labels", kLabels, scene.labels); !added) return std::move(added).error();
  if (scene.second_view != nullptr)
    if (auto added = write_second_view(*scene.second_view, description["second_view"], members); !added)
      return std::move(added).error();
  if (scene.map != nullptr) {
    members[kMap] = encode_street_map(*scene.map);
    description["map"] = kMap;
  }
  // Names come from files and people: invalid UTF-8 in them is replaced, not refused.
  constexpr int kIndent = 1;
  const std::string text = description.dump(kIndent, ' ', false, json::error_handler_t::replace);
  const auto bytes = as_bytes(text);
  members[kDescription] = Bytes(bytes.begin(), bytes.end());
  return zip(members);
}

Result<SceneFile> decode_scene(std::span<const std::byte> file) {
  if (has_magic(file, "PALPREC")) return invalid_input("is the recording of a touch, not a scene");
  const auto names = member_names(file);
  if (!names) return names.error();
  // Asked before another kind of archive, such as an .npz, is unpacked.
  if (std::find(names->begin(), names->end(), kDescription) == names->end())
    return invalid_input("is a zip archive without scene.json, so not a scene");
  auto members = unzip(file);
  if (!members) return std::move(members).error();
  const auto text = members->extract(kDescription);
  if (text.mapped().size() > kMaxDescriptionBytes)
    return invalid_input("has a scene.json larger than 16 MiB");
  const json description = json::parse(as_text(text.mapped()), nullptr, false);
  try {
    auto scene = scene_from(description, *std::move(members));
    if (scene) scene->file_bytes = file.size();
    return scene;
  } catch (const json::exception&) {
    return invalid_input("has a scene.json that is damaged or incomplete");
  }
}

Result<void> write_scene(const std::filesystem::path& path, const models::Scene& scene,
                         const ZipMembers& others) {
  const auto file = encode_scene(scene, others);
  if (!file) return Error{file.error().code, file.error().message, path.string()};
  return write_file_atomically(path, *file);
}

Result<SceneFile> read_scene(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto scene = decode_scene(*file);
  if (!scene) scene.error().place = path.string();
  return scene;
}

}  // namespace palpable::formats
