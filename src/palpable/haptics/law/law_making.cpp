// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/law_making.hpp"

#include "palpable/haptics/law/law_parameters.hpp"
#include "palpable/models/relief/relief_dilation.hpp"

#include <algorithm>
#include <array>

namespace palpable::haptics {
namespace {

using models::Material;
using models::Relief;

Contact contact_of(const Material& material, const LawParameters& p) {
  Contact c;
  c.stiffness_N_per_m = p.stiffness_N_per_m.value_or(material.stiffness_N_per_m);
  c.damping_Ns_per_m = p.damping_Ns_per_m.value_or(material.damping_Ns_per_m);
  c.static_friction = p.static_friction.value_or(p.dynamic_friction.value_or(material.static_friction));
  c.dynamic_friction = p.dynamic_friction.value_or(
      p.static_friction ? models::kDynamicOfStatic * *p.static_friction : material.dynamic_friction);
  c.dynamic_friction = std::min(c.dynamic_friction, c.static_friction);
  return c;
}

constexpr std::size_t kPage_bytes = 4096;

}  // namespace

Error usage_error(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  // Steele & Lea's SplitMix64 finaliser.
  hash += value + 0x9E3779B97F4A7C15ULL;
  hash = (hash ^ (hash >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  hash = (hash ^ (hash >> 27U)) * 0x94D049BB133111EBULL;
  return hash ^ (hash >> 31U);
}

std::uint64_t content_hash(const Relief& relief) {
  std::uint64_t hash = mixed(static_cast<std::uint64_t>(relief.samples_m().width()), relief.pixel_m());
  for (const float z : relief.samples_m().values())
    hash = mixed(hash, std::uint64_t{std::bit_cast<std::uint32_t>(z)});
  return hash;
}

std::uint64_t content_hash(const models::DenseField& field) {
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(field.cell_m()), norm(field.origin_m()));
  for (const float value : field.values())
    hash = mixed(hash, std::uint64_t{std::bit_cast<std::uint32_t>(value)});
  return hash;
}

std::uint64_t content_hash(const models::DistanceField& field) {
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(field.cell_m()), norm(field.grid().origin_m));
  for (const auto* numbers : {&field.tree().roots, &field.tree().nodes, &field.tree().words})
    for (const std::uint32_t number : *numbers) hash = mixed(hash, std::uint64_t{number});
  return hash;
}

MaterialMap materials_of(const models::Scene& scene, const Relief& relief, const LawParameters& parameters) {
  const Material fallback;
  const Material& first = scene.materials.empty() ? fallback : scene.materials.front();
  std::array<Contact, 256> contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    contacts[k] = contact_of(k < scene.materials.size() ? scene.materials[k] : first, parameters);
  return {contacts, scene.labels, relief.size_x_m(), relief.size_y_m()};
}

Result<std::shared_ptr<const Relief>> dilated_surface(const std::shared_ptr<const Relief>& relief,
                                                      double radius_m, DilatedRelief* kept,
                                                      const Work& work) {
  if (radius_m == 0.0) return relief;
  if (kept != nullptr && kept->of == relief && kept->radius_m == radius_m) return kept->surface;
  auto values = models::dilate_by_ball(*relief, radius_m, work);
  if (work.cancelled()) return Work::interrupted();
  auto dilated = Relief::from_samples(std::move(values), relief->pixel_m());
  if (!dilated) return dilated.error();
  auto surface = std::make_shared<const Relief>(std::move(*dilated));
  if (kept != nullptr) *kept = {relief, radius_m, surface};
  return surface;
}

void read_pages(const void* data, std::size_t bytes) noexcept {
  const auto* at = static_cast<const volatile unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; i += kPage_bytes) static_cast<void>(at[i]);
}
void read_pages(const Relief& relief) noexcept {
  read_pages(relief.samples_m().data(), relief.samples_m().count() * sizeof(float));
}
void read_pages(const models::BoundedRelief& relief) noexcept { read_pages(relief.relief()); }
void read_pages(const models::BoundaryMap& map) noexcept {
  read_pages(map.averaged().data(), map.averaged().count() * sizeof(*map.averaged().data()));
}
void read_pages(const models::DistanceField& field) noexcept {
  for (const auto* part : {&field.tree().roots, &field.tree().nodes, &field.tree().words})
    read_pages(part->data(), part->size() * sizeof(std::uint32_t));
}
void read_pages(const models::DenseField& field) noexcept {
  read_pages(field.values().data(), field.values().size() * sizeof(float));
}
void read_pages(const models::ReliefDepth& depth) noexcept {
  depth.each_surface([](const Relief& surface) { read_pages(surface); });
}
void read_pages(const models::OccupancyGrid& grid) noexcept { grid.touch_pages(); }

}  // namespace palpable::haptics
