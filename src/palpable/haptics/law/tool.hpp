// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/effect/tool_touch.hpp"
#include "palpable/haptics/law/contact_law.hpp"
#include "palpable/models/field/distance_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::haptics {

extern const LawDescription kToolLaw;

/// The tool of the law `tool`: a hemispherical end below the hand.
struct ToolShape {
  /// 0.5 ... 20 mm; 8 mm is a finger pad.
  double radius_m = 0.008;
  /// Distance from the hand down to the ball's centre, 0 ... 0.2 m; 0.1 for a cane.
  double length_m = 0.0;
  /// Number of sample points on the end, distributed evenly.
  std::size_t places = 32;
};

/// The sample points of such a tool; their weights sum to 1.
std::vector<ToolPlace> tool_places(const ToolShape& shape);

/// `tool`: `penalty` for an extended tool, with force and torque (six degrees of freedom). Each sample point
/// of the tool is pushed out by a spring with its share of the stiffness, -k min(D, 0) grad D, and damped
/// along the normal by its own velocity v + w x r, never into a pull. The torque is about the hand's
/// position. Undamped, force and torque are the exact derivatives of one energy, the sum of k D^2 / 2
/// (tool_wrench()). Moustakas et al. 2007 claim six degrees of freedom but define no torque. As in `penalty`,
/// a point that is pushed through a thin wall comes out on the other side. Tick path; at most `places`
/// distances.
template <models::DistanceSurface Surface>
class ToolLaw : public ContactLaw<Surface> {
 public:
  struct State {};

  ToolLaw(std::shared_ptr<const Surface> surface, MaterialMap materials, const ToolShape& shape)
      : ContactLaw<Surface>(std::move(surface), std::move(materials)),
        places_(tool_places(shape)),
        end_{{0.0, 0.0, -shape.length_m}},
        radius_m_(shape.radius_m) {}

  LawOutput evaluate(const Hand& hand, State&) const noexcept {
    const Transform<SceneFrame, ToolFrame> scene_from_tool{hand.rotation, hand.position.v, 1.0};
    LawOutput output;
    output.stored_J = 0.0;
    const Point<SceneFrame> end = scene_from_tool * end_;
    output.label = this->materials().label_at(end.v.x, end.v.y);
    // The length of a field's gradient is hardly above 1: if the end's centre is this far outside, so are all
    // its points.
    constexpr double kClear = 1.5;
    if (this->surface().sample(end).distance_m > kClear * radius_m_) return output;
    for (const ToolPlace& tool : places_) add_place(hand, tool, scene_from_tool * tool.place, output);
    return output;
  }

  EnergyModel energy_model() const noexcept { return EnergyModel::spring; }
  std::size_t memory_bytes() const noexcept {
    return ContactLaw<Surface>::memory_bytes() + places_.size() * sizeof(ToolPlace);
  }

 private:
  void add_place(const Hand& hand, const ToolPlace& tool, Point<SceneFrame> place,
                 LawOutput& sum) const noexcept {
    const models::FieldSample s = this->surface().sample(place);
    const double length = norm(s.gradient);
    if (!(s.distance_m < 0.0) || !(length > 0.0)) return;
    const std::uint16_t label = this->materials().label_at(place.v.x, place.v.y);
    if (!sum.contact) sum.label = label;
    sum.contact = true;
    Contact contact = this->materials().contact(label);
    contact.damping_Ns_per_m *= tool.share;
    const double spring_N = -tool.share * contact.stiffness_N_per_m * s.distance_m;
    const Vector<SceneFrame> lever = place - hand.position;
    const Vector<SceneFrame> velocity = hand.velocity_m_per_s + cross(hand.angular_velocity_rad_per_s, lever);
    const Vector<SceneFrame> spring = spring_N * s.gradient;
    const Vector<SceneFrame> force{
        damped_push(spring_N * length, s.gradient.v / length, velocity.v, contact)};
    sum.spring_N += spring;
    sum.spring_torque_Nm += cross(lever, spring);
    sum.force_N += force;
    sum.torque_Nm += cross(lever, force);
    sum.stored_J -= 0.5 * spring_N * s.distance_m;
  }

  std::vector<ToolPlace> places_;
  Point<ToolFrame> end_;
  double radius_m_;
};

}  // namespace palpable::haptics
