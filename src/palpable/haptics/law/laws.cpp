// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/laws.hpp"

#include "palpable/haptics/law/field_laws.hpp"
#include "palpable/haptics/law/grid_law.hpp"
#include "palpable/haptics/law/proxy.hpp"
#include "palpable/haptics/law/rolling.hpp"
#include "palpable/haptics/law/sobel.hpp"
#include "palpable/haptics/law/tracing.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace palpable::haptics {
namespace {

using models::Material;
using models::Relief;

struct Name {
  Law law;
  std::string_view name;
};
constexpr std::array kNames{Name{Law::proxy, "proxy"},       Name{Law::rolling, "rolling"},
                            Name{Law::sobel, "sobel"},       Name{Law::penalty, "penalty"},
                            Name{Law::averaged, "averaged"}, Name{Law::tracing, "tracing"},
                            Name{Law::groove, "groove"},     Name{Law::grid, "grid"}};

// What Shi & Pai's laws take where nothing is given: a slope of 1 pushes with 1 N.
constexpr double kRollingWeight_N = 1.0;
constexpr double kRollingDamping_Ns_per_m = 0.5;
constexpr double kDynamicOfStatic = 5.0 / 6.0;

Error usage(std::string message) { return {ErrorCode::usage, std::move(message), {}}; }

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  // Steele & Lea's SplitMix64 finaliser.
  hash += value + 0x9E3779B97F4A7C15ULL;
  hash = (hash ^ (hash >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  hash = (hash ^ (hash >> 27U)) * 0x94D049BB133111EBULL;
  return hash ^ (hash >> 31U);
}

std::uint64_t content_hash(const Relief& relief) {
  std::uint64_t hash = mixed(static_cast<std::uint64_t>(relief.samples_m().width()),
                             std::bit_cast<std::uint64_t>(relief.pixel_m()));
  for (const float z : relief.samples_m().values()) hash = mixed(hash, std::bit_cast<std::uint32_t>(z));
  return hash;
}

std::uint64_t content_hash(const models::DenseField& field) {
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(field.cell_m()),
                             std::bit_cast<std::uint64_t>(norm(field.origin_m())));
  for (const float value : field.values()) hash = mixed(hash, std::bit_cast<std::uint32_t>(value));
  return hash;
}

std::uint64_t content_hash(const models::DistanceField& field) {
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(field.cell_m()),
                             std::bit_cast<std::uint64_t>(norm(field.grid().origin_m)));
  for (const std::uint32_t word : field.tree().words) hash = mixed(hash, word);
  return hash;
}

constexpr std::size_t kPage = 4096;

template <class T>
void read_pages(const Raster<T>& raster) noexcept {
  const auto* bytes = reinterpret_cast<const volatile unsigned char*>(raster.data());
  for (std::size_t at = 0; at < raster.count() * sizeof(T); at += kPage) static_cast<void>(bytes[at]);
}
void read_pages(const models::DistanceField& field) noexcept {
  for (const auto* part : {&field.tree().roots, &field.tree().nodes, &field.tree().words}) {
    const volatile std::uint32_t* words = part->data();
    for (std::size_t at = 0; at < part->size(); at += kPage / sizeof(*words)) static_cast<void>(words[at]);
  }
}
void read_pages(const models::DenseField& field) noexcept {
  const volatile float* values = field.values().data();
  for (std::size_t at = 0; at < field.values().size(); at += kPage / sizeof(float))
    static_cast<void>(values[at]);
}
void read_pages(const models::OccupancyGrid& grid) noexcept { grid.touch_pages(); }
void read_pages(const Relief& relief) noexcept { read_pages(relief.samples_m()); }
void read_pages(const models::BoundaryMap& map) noexcept { read_pages(map.averaged()); }
void read_pages(const SobelSlopes& slopes) noexcept { read_pages(slopes.slopes()); }

/// Gives one law the contract's outside. A Law has a State, feel(), surface(), damping_Ns_per_m(),
/// memory_bytes().
template <class L>
class LawTouchable final : public Touchable {
 public:
  LawTouchable(L law, std::uint64_t family) : law_(std::move(law)), family_(family) {}
  Feel feel(const Hand& hand, TouchState& state) const noexcept override {
    return law_.feel(hand, state_as<typename L::State>(state));
  }
  std::uint64_t state_family() const noexcept override { return family_; }
  double damping_Ns_per_m() const noexcept override { return law_.damping_Ns_per_m(); }
  void touch_pages() const noexcept override { read_pages(law_.surface()); }
  std::size_t memory_bytes() const noexcept override { return law_.memory_bytes(); }

 private:
  L law_;
  std::uint64_t family_;
};

template <class L>
std::shared_ptr<const Touchable> touchable(L law, std::uint64_t family) {
  return std::make_shared<LawTouchable<L>>(std::move(law), family);
}

bool within(const std::optional<double>& value, double low, double high) {
  return !value || (*value >= low && *value <= high);
}

Result<void> check(const LawParameters& p) {
  if (!within(p.stiffness_N_per_m, 1e-6, 1e6))
    return usage("the stiffness must be above 0 and at most 1000000");
  if (!within(p.damping_Ns_per_m, 0.0, 1e4)) return usage("the damping must be 0 to 10000");
  if (!within(p.static_friction, 0.0, 10.0) || !within(p.dynamic_friction, 0.0, 10.0))
    return usage("a friction coefficient must be 0 to 10");
  if (p.law == Law::tracing && !within(p.stiffness_N_per_m, 0.0, 5.0))
    return usage("the force of tracing must be 0 to 5 newtons");
  if (!within(p.neighbourhood_px, 1.0, 32.0)) return usage("the neighbourhood must be 1 to 32 pixels");
  if (!within(p.radius_m, 0.0, 0.02)) return usage("the radius must be 0 to 20 mm");
  const Averaging& a = p.averaging;
  if (!within(a.offset_m, 0.0, 0.02)) return usage("the averaging's offset must be 0 to 20 mm");
  if (!within(a.neighbour_weight, 0.0, 1e6) || !within(a.centre_weight, 0.0, 1e6) ||
      a.neighbour_weight + a.centre_weight <= 0.0)
    return usage("the averaging's weights must be 0 or more, and not both 0");
  return {};
}

Contact contact_of(const Material& material, const LawParameters& p) {
  Contact c;
  c.stiffness_N_per_m = p.stiffness_N_per_m.value_or(material.stiffness_N_per_m);
  c.damping_Ns_per_m = p.damping_Ns_per_m.value_or(material.damping_Ns_per_m);
  c.static_friction = p.static_friction.value_or(p.dynamic_friction.value_or(material.static_friction));
  c.dynamic_friction = p.dynamic_friction.value_or(p.static_friction ? kDynamicOfStatic * *p.static_friction
                                                                     : material.dynamic_friction);
  c.dynamic_friction = std::min(c.dynamic_friction, c.static_friction);
  return c;
}

MaterialMap materials_of(const models::Scene& scene, const Relief& relief, const LawParameters& parameters) {
  const Material fallback;
  const Material& first = scene.materials.empty() ? fallback : scene.materials.front();
  std::array<Contact, 256> contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    contacts[k] = contact_of(k < scene.materials.size() ? scene.materials[k] : first, parameters);
  return {contacts, scene.labels, relief.width_m(), relief.depth_m()};
}

/// The relief itself for a point; dilated for a ball. The relief's slopes bound the dilated one's.
Result<std::shared_ptr<const Relief>> surface_for(const std::shared_ptr<const Relief>& relief,
                                                  double radius_m, DilatedRelief* kept) {
  if (radius_m == 0.0) return relief;
  if (kept != nullptr && kept->of == relief && kept->radius_m == radius_m) return kept->surface;
  auto dilated = Relief::from_samples(
      models::dilate_by_ball(relief->samples_m(), relief->pixel_m(), radius_m, Work{}), relief->pixel_m());
  if (!dilated) return dilated.error();
  auto surface = std::make_shared<const Relief>(std::move(*dilated));
  if (kept != nullptr) *kept = {relief, radius_m, surface};
  return surface;
}

Result<std::shared_ptr<const Touchable>> on_relief(const models::Scene& scene,
                                                   const std::shared_ptr<const Relief>& relief,
                                                   const LawParameters& p, DilatedRelief* kept) {
  std::uint64_t family = mixed(static_cast<std::uint64_t>(p.law), content_hash(*relief));
  switch (p.law) {
    case Law::rolling:
      return touchable(RollingLaw<Relief>(relief, p.stiffness_N_per_m.value_or(kRollingWeight_N),
                                          p.damping_Ns_per_m.value_or(kRollingDamping_Ns_per_m)),
                       family);
    case Law::sobel:
      return touchable(SobelLaw(*relief, p.stiffness_N_per_m.value_or(kRollingWeight_N),
                                p.damping_Ns_per_m.value_or(kRollingDamping_Ns_per_m)),
                       family);
    case Law::proxy:
    case Law::penalty:
    case Law::averaged:
    case Law::tracing:
    case Law::groove:
    case Law::grid:
      break;
  }
  auto surface = surface_for(relief, p.radius_m, kept);
  if (!surface) return surface.error();
  family = mixed(family, std::bit_cast<std::uint64_t>(p.radius_m));
  MaterialMap materials = materials_of(scene, *relief, p);
  if (p.law == Law::proxy || p.law == Law::groove)
    return touchable(ProxyLaw<Relief>(*std::move(surface), std::move(materials), Textures(scene.materials)),
                     family);
  if (p.law == Law::penalty)
    return touchable(
        PenaltyLaw<Relief>(*std::move(surface), std::move(materials), p.penalty == PenaltyDirection::normal),
        family);
  return touchable(AveragedLaw<Relief>(*std::move(surface), std::move(materials), p.averaging), family);
}

template <models::DistanceSurface Distance>
Result<std::shared_ptr<const Touchable>> on_field(
    const models::Scene& scene, const std::shared_ptr<const models::SolidField<Distance>>& field,
    const LawParameters& p) {
  // Seen from above it is a relief: for devices that move in a plane.
  if (p.law == Law::rolling) return on_relief(scene, field->from_above, p, nullptr);
  const std::shared_ptr<const Distance> surface(field, &field->distance);
  MaterialMap materials = materials_of(scene, *field->from_above, p);
  const std::uint64_t family = mixed(mixed(static_cast<std::uint64_t>(p.law), content_hash(*surface)),
                                     std::bit_cast<std::uint64_t>(p.radius_m));
  if (p.law == Law::penalty)
    return touchable(FieldPenaltyLaw<Distance>(surface, std::move(materials), p.radius_m,
                                               p.penalty == PenaltyDirection::normal),
                     family);
  return touchable(
      FieldProxyLaw<Distance>(surface, std::move(materials), p.radius_m, Textures(scene.materials)), family);
}

Result<std::shared_ptr<const Touchable>> on_grid(const models::Scene& scene,
                                                 const std::shared_ptr<const models::Grid>& grid,
                                                 const LawParameters& p) {
  if (p.radius_m > 0.0) return usage("the law grid touches with a point: give no radius");
  const std::shared_ptr<const models::OccupancyGrid> surface(grid, &grid->occupancy);
  const std::uint64_t family = mixed(mixed(static_cast<std::uint64_t>(p.law), surface->occupied_points()),
                                     content_hash(*grid->from_above));
  return touchable(GridLaw(surface, materials_of(scene, *grid->from_above, p)), family);
}

/// The map as made, or averaged anew over another neighbourhood.
Result<std::shared_ptr<const models::BoundaryMap>> boundaries_for(
    const std::shared_ptr<const models::Contours>& contours, const std::optional<double>& radius_px) {
  const models::BoundaryMap& map = contours->boundaries;
  if (!radius_px || *radius_px == map.radius_px())
    return std::shared_ptr<const models::BoundaryMap>(contours, &map);
  auto again = models::BoundaryMap::from_edges(map.edges(), map.pixel_m(), *radius_px, map.origin(), Work{});
  if (!again) return again.error();
  return std::make_shared<const models::BoundaryMap>(std::move(*again));
}

Result<std::shared_ptr<const Touchable>> on_boundaries(
    const std::shared_ptr<const models::Contours>& contours, const LawParameters& p) {
  auto map = boundaries_for(contours, p.neighbourhood_px);
  if (!map) return map.error();
  TracingParameters tracing;
  tracing.force_N = p.stiffness_N_per_m.value_or(tracing.force_N);
  tracing.damping_Ns_per_m = p.damping_Ns_per_m.value_or(tracing.damping_Ns_per_m);
  const std::uint64_t family =
      mixed(static_cast<std::uint64_t>(Law::tracing), content_hash(*contours->grooves));
  return touchable(TracingLaw(*std::move(map), tracing), family);
}

}  // namespace

std::string_view name_of(Law law) {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [law](const Name& n) { return n.law == law; });
  return found != kNames.end() ? found->name : std::string_view{};
}

std::optional<Law> law_from(std::string_view name) {
  const auto* found =
      std::find_if(kNames.begin(), kNames.end(), [name](const Name& n) { return n.name == name; });
  return found != kNames.end() ? std::optional(found->law) : std::nullopt;
}

std::vector<Law> laws_for(const models::Scene& scene) {
  if (std::holds_alternative<std::shared_ptr<const Relief>>(scene.model))
    return {Law::proxy, Law::rolling, Law::penalty, Law::averaged, Law::sobel};
  if (models::is_field(scene.model)) return {Law::proxy, Law::penalty, Law::rolling};
  if (std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model))
    return {Law::grid, Law::rolling};
  return {Law::tracing, Law::groove, Law::rolling};
}

Result<std::shared_ptr<const Touchable>> make_touchable(const models::Scene& scene,
                                                        const LawParameters& parameters,
                                                        DilatedRelief* kept) {
  if (const auto sound = check(parameters); !sound) return sound.error();
  const auto laws = laws_for(scene);
  if (std::find(laws.begin(), laws.end(), parameters.law) == laws.end())
    return usage("the law " + std::string(name_of(parameters.law)) + " does not exist for a " +
                 models::kind_of(scene.model));
  if (const auto* relief = std::get_if<std::shared_ptr<const Relief>>(&scene.model))
    return on_relief(scene, *relief, parameters, kept);
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    return on_field(scene, *field, parameters);
  if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    return on_field(scene, *dense, parameters);
  if (const auto* grid = std::get_if<std::shared_ptr<const models::Grid>>(&scene.model)) {
    if (parameters.law == Law::grid) return on_grid(scene, *grid, parameters);
    return on_relief(scene, (*grid)->from_above, parameters, kept);
  }
  const auto& contours = std::get<std::shared_ptr<const models::Contours>>(scene.model);
  if (parameters.law == Law::tracing) return on_boundaries(contours, parameters);
  return on_relief(scene, contours->grooves, parameters, kept);
}

}  // namespace palpable::haptics
