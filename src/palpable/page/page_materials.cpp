// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_materials.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::page {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

protocol::Material page_material(const models::Material& m) {
  protocol::Material material;
  material.stiffness_N_per_m = m.stiffness_N_per_m;
  material.damping_Ns_per_m = m.damping_Ns_per_m;
  material.friction = m.static_friction;
  material.stickiness = m.static_friction > 0.0 ? 1.0 - m.dynamic_friction / m.static_friction : 0.0;
  material.texture = {std::string(models::name_of(m.texture.kind)), m.texture.pitch_m, m.texture.height_m,
                      std::remainder(m.texture.angle_rad * kDegreesPerRadian, 360.0)};
  return material;
}

/// The values of `newer`, else those of `older`.
protocol::MaterialEdit merged(const protocol::MaterialEdit& older, protocol::MaterialEdit newer) {
  if (!newer.stiffness_N_per_m) newer.stiffness_N_per_m = older.stiffness_N_per_m;
  if (!newer.damping_Ns_per_m) newer.damping_Ns_per_m = older.damping_Ns_per_m;
  if (!newer.friction) newer.friction = older.friction;
  if (!newer.stickiness) newer.stickiness = older.stickiness;
  if (!newer.texture) newer.texture = older.texture;
  return newer;
}

Result<void> apply(const protocol::MaterialEdit& edit, models::Material& m) {
  if (edit.texture) {
    const auto kind = models::texture_kind_from(edit.texture->kind);
    if (!kind) return Error{ErrorCode::usage, "there is no such texture", edit.texture->kind};
    if (*kind == models::TouchTexture::Kind::picture && m.texture.tile.empty())
      return Error{ErrorCode::usage, "this material has no texture from a picture", m.name};
    // A picture's tile is kept, so that the user may select it again.
    m.texture = {*kind, edit.texture->pitch_m, edit.texture->height_m,
                 edit.texture->angle_deg / kDegreesPerRadian, std::move(m.texture.tile)};
  }
  const double stickiness = edit.stickiness.value_or(page_material(m).stickiness);
  m.stiffness_N_per_m = edit.stiffness_N_per_m.value_or(m.stiffness_N_per_m);
  m.damping_Ns_per_m = edit.damping_Ns_per_m.value_or(m.damping_Ns_per_m);
  if (!edit.friction && !edit.stickiness) return {};
  m.static_friction = edit.friction.value_or(m.static_friction);
  m.dynamic_friction = m.static_friction * (1.0 - stickiness);
  return {};
}

}  // namespace

std::optional<std::string> own_name(const models::Material& material) {
  return material.name == models::Material{}.name ? std::nullopt : std::optional(material.name);
}

std::vector<protocol::NamedMaterial> page_materials(const models::Scene& scene) {
  static_assert(protocol::kPictureForms == models::kPictureForms,
                "the page computes a picture's side from its pitch");
  std::vector<protocol::NamedMaterial> all;
  for (const auto& material : scene.materials) all.push_back({own_name(material), page_material(material)});
  return all;
}

void add_edit(MaterialEdits& edits, const protocol::Edit& edit) {
  auto& waiting = edits[edit.label];
  waiting = merged(waiting, edit.material);
}

Result<std::vector<models::Material>> edited_materials(std::vector<models::Material> materials,
                                                       const MaterialEdits& edits,
                                                       haptics::LawParameters& law) {
  for (const auto& [label, edit] : edits) {
    if (label < 0 || static_cast<std::size_t>(label) >= materials.size())
      return Error{ErrorCode::usage, "there is no such material", std::to_string(label)};
    if (auto done = apply(edit, materials[static_cast<std::size_t>(label)]); !done) return done.error();
    if (edit.stiffness_N_per_m) law.stiffness_N_per_m.reset();
    if (edit.damping_Ns_per_m) law.damping_Ns_per_m.reset();
    if (edit.friction || edit.stickiness) {
      law.static_friction.reset();
      law.dynamic_friction.reset();
    }
  }
  return materials;
}

}  // namespace palpable::page
