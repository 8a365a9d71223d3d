// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/mesh/glb.hpp"

#include "palpable/core/files/byte_writer.hpp"
#include "palpable/formats/picture/png.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

using Json = nlohmann::json;

// glTF's constants for component types and buffer targets.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kUnsignedShort = 5123;
constexpr int kVertexBuffer = 34962;
constexpr int kIndexBuffer = 34963;

void write_float(ByteWriter& out, double value) {
  out.u32(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

/// The binary chunk, and the JSON descriptions of its buffer views and accessors.
class Parts {
 public:
  ByteWriter& bytes() { return bytes_; }
  /// Adds a buffer view for the bytes written since the last call; accessor() also describes its content.
  std::size_t close(int target) {
    while (bytes_.bytes().size() % 4 != 0) bytes_.u8(0);
    Json view = {{"buffer", 0}, {"byteOffset", begin_}, {"byteLength", bytes_.bytes().size() - begin_}};
    if (target != 0) view["target"] = target;
    begin_ = bytes_.bytes().size();
    views_.push_back(view);
    return views_.size() - 1;
  }
  std::size_t accessor(Json description) {
    accessors_.push_back(std::move(description));
    return accessors_.size() - 1;
  }
  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }

 private:
  ByteWriter bytes_;
  std::size_t begin_ = 0;
  Json views_ = Json::array();
  Json accessors_ = Json::array();
};

// glTF's vertex colours are linear (glTF 2.0, 3.7.2.1), 16 bits each.
std::uint16_t linear16(std::uint8_t srgb) {
  const double value = srgb / 255.0;
  const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(65535.0 * linear));
}

void add_colours(std::span<const Rgb8> colours, Parts& parts, Json& attributes) {
  for (const Rgb8& colour : colours) {
    for (const std::uint8_t level : {colour.r, colour.g, colour.b}) parts.bytes().u16(linear16(level));
    parts.bytes().u16(65535);
  }
  attributes["COLOR_0"] = parts.accessor({{"bufferView", parts.close(kVertexBuffer)},
                                          {"componentType", kUnsignedShort},
                                          {"normalized", true},
                                          {"count", colours.size()},
                                          {"type", "VEC4"}});
}

Json add_geometry(const Mesh& mesh, bool with_picture, std::span<const Rgb8> colours,
                  std::span<const Vec3> normals, Parts& parts) {
  Vec3 low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
           std::numeric_limits<double>::max()};
  Vec3 high = -low;
  for (const Vec3 v : mesh.vertices_m) {
    for (const double c : {v.x, v.y, v.z}) write_float(parts.bytes(), c);
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const auto single = [](double value) { return static_cast<float>(value); };
  const std::size_t count = mesh.vertices_m.size();
  Json attributes;
  attributes["POSITION"] = parts.accessor({{"bufferView", parts.close(kVertexBuffer)},
                                           {"componentType", kFloat},
                                           {"count", count},
                                           {"type", "VEC3"},
                                           {"min", {single(low.x), single(low.y), single(low.z)}},
                                           {"max", {single(high.x), single(high.y), single(high.z)}}});
  const std::vector<Vec3> own = normals.size() == count ? std::vector<Vec3>{} : vertex_normals(mesh);
  for (const Vec3 n : own.empty() ? normals : std::span<const Vec3>(own))
    for (const double c : {n.x, n.y, n.z}) write_float(parts.bytes(), c);
  attributes["NORMAL"] = parts.accessor({{"bufferView", parts.close(kVertexBuffer)},
                                         {"componentType", kFloat},
                                         {"count", count},
                                         {"type", "VEC3"}});
  if (with_picture) {
    for (const auto& place : mesh.picture_places)
      for (const float c : place) write_float(parts.bytes(), double{c});
    attributes["TEXCOORD_0"] = parts.accessor({{"bufferView", parts.close(kVertexBuffer)},
                                               {"componentType", kFloat},
                                               {"count", count},
                                               {"type", "VEC2"}});
  }
  if (colours.size() == count) add_colours(colours, parts, attributes);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t k : t) parts.bytes().u32(k);
  const std::size_t indices = parts.accessor({{"bufferView", parts.close(kIndexBuffer)},
                                              {"componentType", kUnsignedInt},
                                              {"count", 3 * mesh.triangles.size()},
                                              {"type", "SCALAR"}});
  return {{"attributes", attributes}, {"indices", indices}, {"material", 0}};
}

std::vector<std::byte> container(std::string json, std::span<const std::byte> binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  constexpr std::uint32_t kVersion = 2;
  constexpr std::uint32_t kHeaders = 12 + 8 + 8;
  ByteWriter file;
  file.text("glTF");
  file.u32(kVersion);
  file.u32(static_cast<std::uint32_t>(kHeaders + json.size() + binary.size()));
  file.u32(static_cast<std::uint32_t>(json.size()));
  file.text("JSON");
  file.text(json);
  file.u32(static_cast<std::uint32_t>(binary.size()));
  file.text(std::string_view("BIN\0", 4));
  std::vector<std::byte> all(file.bytes().begin(), file.bytes().end());
  all.insert(all.end(), binary.begin(), binary.end());
  return all;
}

}  // namespace

Result<std::vector<std::byte>> encode_glb(const Mesh& mesh, const Raster<Rgb8>& picture,
                                          std::span<const Rgb8> colours, std::span<const Vec3> normals) {
  if (mesh.triangles.empty()) return Error{ErrorCode::failed, "there is no surface to write", {}};
  const bool with_picture = !picture.empty() && mesh.picture_places.size() == mesh.vertices_m.size();
  Parts parts;
  const Json primitive = add_geometry(mesh, with_picture, colours, normals, parts);
  Json material = {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}};
  Json document = {{"asset", {{"version", "2.0"}, {"generator", "Palpable"}}},
                   {"scene", 0},
                   {"scenes", {{{"nodes", {0}}}}},
                   {"nodes", {{{"mesh", 0}, {"name", "relief"}}}},
                   {"meshes", {{{"primitives", {primitive}}}}}};
  if (with_picture) {
    auto png = encode_png(picture);
    if (!png) return png.error();
    for (const std::byte b : *png) parts.bytes().u8(std::to_integer<std::uint8_t>(b));
    document["images"] = {{{"bufferView", parts.close(0)}, {"mimeType", "image/png"}}};
    document["textures"] = {{{"source", 0}}};
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  }
  document["materials"] = Json::array({material});
  document["bufferViews"] = parts.views();
  document["accessors"] = parts.accessors();
  const auto binary = parts.bytes().bytes();
  constexpr std::size_t kMostBytes = 0xF0000000;
  if (binary.size() > kMostBytes)
    return Error{ErrorCode::failed, "the surface is too large for a GLB file", {}};
  document["buffers"] = {{{"byteLength", binary.size()}}};
  return container(document.dump(), binary);
}

}  // namespace palpable::formats
