// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/effect/material_map.hpp"
#include "palpable/haptics/law/laws.hpp"
#include "palpable/models/field/dense_field.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/relief_depth.hpp"
#include "palpable/models/grid/occupancy_grid.hpp"
#include "palpable/models/relief/height_bounds.hpp"

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

// Functions for creating laws, outside the tick.

namespace palpable::haptics {

/// The input for creating a law. `scene` must be of a kind that the law renders; `parameters` must be in
/// range.
struct LawInput {
  const models::Scene& scene;
  const LawParameters& parameters;
  /// Cache of the dilated relief; null: no cache.
  DilatedRelief* kept = nullptr;
  Work work = {};
};

struct MadeLaw {
  Result<std::shared_ptr<const Touchable>> touchable;
};

Error usage_error(std::string message);

/// Combines hashes of content. Equal content gives equal hashes, which distinguish families of states.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value);
inline std::uint64_t mixed(std::uint64_t hash, double value) {
  return mixed(hash, std::bit_cast<std::uint64_t>(value));
}
std::uint64_t content_hash(const models::Relief& relief);
std::uint64_t content_hash(const models::DenseField& field);
std::uint64_t content_hash(const models::DistanceField& field);

/// The scene's materials, overridden by the law's parameters where these are set. `relief`: the scene seen
/// from above.
MaterialMap materials_of(const models::Scene& scene, const models::Relief& relief,
                         const LawParameters& parameters);

/// The relief itself for a point; dilated for a ball. The slope of the dilated relief does not exceed the
/// relief's. Errors: interrupted.
Result<std::shared_ptr<const models::Relief>> dilated_surface(
    const std::shared_ptr<const models::Relief>& relief, double radius_m, DilatedRelief* kept,
    const Work& work);

/// Reads every page of a model once.
void read_pages(const void* data, std::size_t bytes) noexcept;
void read_pages(const models::Relief& relief) noexcept;
void read_pages(const models::BoundedRelief& relief) noexcept;
void read_pages(const models::BoundaryMap& map) noexcept;
void read_pages(const models::DistanceField& field) noexcept;
void read_pages(const models::DenseField& field) noexcept;
void read_pages(const models::ReliefDepth& depth) noexcept;
void read_pages(const models::OccupancyGrid& grid) noexcept;

/// Adapter from a law to Touchable. A law has a State, evaluate(), energy_model(), surface(),
/// damping_Ns_per_m(), memory_bytes() and, if it has a proxy, hand_over(), take_over() and tangent_plane();
/// read_pages() exists for its surface.
template <class L>
class LawTouchable final : public Touchable {
 public:
  LawTouchable(L law, std::uint64_t family) : law_(std::move(law)), family_(family) {}
  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    if constexpr (requires(typename L::State & s) { law_.evaluate(hand, s, state.found); })
      return law_.evaluate(hand, state_as<typename L::State>(state), state.found);
    else
      return law_.evaluate(hand, state_as<typename L::State>(state));
  }
  std::uint64_t state_family() const noexcept override { return family_; }
  EnergyModel energy_model() const noexcept override { return law_.energy_model(); }
  HandOver hand_over(const TouchState& state) const noexcept override {
    if constexpr (requires(const typename L::State& s) { law_.hand_over(s); })
      return law_.hand_over(state_as<typename L::State>(state));
    else
      return {};
  }
  void take_over(const HandOver& from, TouchState& state) const noexcept override {
    if constexpr (requires(typename L::State & s) { law_.take_over(from, s); })
      law_.take_over(from, state_as<typename L::State>(state));
  }
  TangentPlane tangent_plane(const Hand& hand, const TouchState& state) const noexcept override {
    if constexpr (requires(const typename L::State& s) { law_.tangent_plane(hand, s); })
      return law_.tangent_plane(hand, state_as<typename L::State>(state));
    else
      return {};
  }
  bool has_tangent_planes() const noexcept override {
    return requires(const L& law, const typename L::State& s, const Hand& h) { law.tangent_plane(h, s); };
  }
  double damping_Ns_per_m() const noexcept override { return law_.damping_Ns_per_m(); }
  void touch_pages() const noexcept override { read_pages(law_.surface()); }
  std::size_t memory_bytes() const noexcept override { return law_.memory_bytes(); }

 private:
  L law_;
  std::uint64_t family_;
};

template <class L>
MadeLaw made_law(L law, std::uint64_t family) {
  return {std::shared_ptr<const Touchable>(std::make_shared<LawTouchable<L>>(std::move(law), family))};
}

/// Calls `make(surface, materials, family)` for the scene's field, adaptive or dense.
template <class Make>
MadeLaw make_on_field(const LawInput& in, Make&& make) {
  const auto on = [&](const auto& field) {
    using Distance = std::remove_cvref_t<decltype(field->distance)>;
    const std::shared_ptr<const Distance> surface(field, &field->distance);
    const std::uint64_t family =
        mixed(mixed(static_cast<std::uint64_t>(in.parameters.law), content_hash(*surface)),
              in.parameters.radius_m.value_or(0.0));
    return make(surface, materials_of(in.scene, *field->from_above, in.parameters), family);
  };
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&in.scene.model))
    return on(*field);
  return on(std::get<std::shared_ptr<const models::FieldOnLattice>>(in.scene.model));
}

/// Calls `make(surface, materials, family)` for the scene seen from above, dilated by the ball.
template <class Make>
MadeLaw make_on_relief(const LawInput& in, Make&& make) {
  const std::shared_ptr<const models::Relief>& relief = models::relief_of(in.scene);
  const double radius_m = in.parameters.radius_m.value_or(0.0);
  auto surface = dilated_surface(relief, radius_m, in.kept, in.work);
  if (!surface) return {surface.error()};
  const std::uint64_t family =
      mixed(mixed(static_cast<std::uint64_t>(in.parameters.law), content_hash(*relief)), radius_m);
  return make(*std::move(surface), materials_of(in.scene, *relief, in.parameters), family);
}

}  // namespace palpable::haptics
