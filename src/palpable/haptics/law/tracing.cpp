// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/tracing.hpp"

#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/law_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::haptics {
namespace {

constexpr LawParameter kForce{&LawParameters::tracing_force_N,
                              "tracing_force_N",
                              "Force along a boundary",
                              "N",
                              "stiffness",
                              1e-6,
                              5.0,
                              0.1,
                              5.0,
                              TracingParameters{}.force_N};
constexpr LawParameter kDamping{&LawParameters::damping_Ns_per_m,
                                "damping_Ns_per_m",
                                "Damping of all motion",
                                "N·s/m",
                                "damping",
                                0.0,
                                1e4,
                                0.0,
                                20.0,
                                TracingParameters{}.damping_Ns_per_m};
/// If not set, the value with which the scene was made; the command line has it as an option of making.
constexpr LawParameter kNeighbourhood{&LawParameters::neighbourhood_px,
                                      "neighbourhood_px",
                                      "Neighbourhood",
                                      "px",
                                      "",
                                      1.0,
                                      32.0,
                                      1.0,
                                      32.0,
                                      std::nullopt};
constexpr LawParameter kBounds{&LawParameters::tracing_bounds,
                               "tracing_bounds",
                               "Limit its speed and energy",
                               kYesOrNo,
                               "tracing-bounds",
                               0.0,
                               1.0,
                               0.0,
                               1.0,
                               1.0};
constexpr std::array kParameters{kForce, kDamping, kBounds, kNeighbourhood};

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

MadeLaw make(const LawInput& in) {
  const auto& contours = std::get<std::shared_ptr<const models::Contours>>(in.scene.model);
  auto map = boundaries_for(contours, in.parameters.neighbourhood_px);
  if (!map) return {map.error()};
  TracingParameters tracing;
  tracing.force_N = value_or_preset(in.parameters, kForce);
  tracing.damping_Ns_per_m = value_or_preset(in.parameters, kDamping);
  tracing.is_bounded = value_or_preset(in.parameters, kBounds) > 0.0;
  return made_law(TracingLaw(*std::move(map), tracing),
                  mixed(static_cast<std::uint64_t>(in.parameters.law), content_hash(*contours->grooves)));
}

/// 0 at rest, 1/2 at the knee, 1 beyond; so flat at rest that a sensor's last digit moves no hand.
double moving(double speed, double knee_m_per_s) {
  const double ratio = speed / knee_m_per_s;
  const double v6 = ratio * ratio * ratio * ratio * ratio * ratio;
  return v6 < 1e6 ? v6 / (v6 + 1.0) : 1.0;
}

/// 1 up to half of the cap, falling smoothly to 0 at the cap.
double below_cap(double speed) {
  const double t = std::clamp(2.0 - 2.0 * speed / TracingLaw::kSpeedCap_m_per_s, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

LawOutput TracingLaw::evaluate(const Hand& hand, State& s) const noexcept {
  const double x = hand.position.v.x;
  const double y = hand.position.v.y;
  if (!s.begun) {
    s.begun = true;
    s.w_x_m = s.last_x_m = x;
    s.w_y_m = s.last_y_m = y;
  }
  // What the last force gave over the way since: exact for a held force.
  s.spent_J += s.last_fx_N * (x - s.last_x_m) + s.last_fy_N * (y - s.last_y_m);
  const double refilled_J = s.steady_s >= kSteady_s ? kRefill_W * hand.dt_s : 0.0;
  s.spent_J = std::clamp(s.spent_J - refilled_J, 0.0, kTank_J);
  const double blend = hand.dt_s / (hand.dt_s + p_.speed_window_s);
  s.vx_m_per_s += blend * ((x - s.last_x_m) / hand.dt_s - s.vx_m_per_s);
  s.vy_m_per_s += blend * ((y - s.last_y_m) / hand.dt_s - s.vy_m_per_s);

  // Eqs 5 and 6: w is dragged behind the hand on a string of length epsilon.
  const double dx = x - s.w_x_m;
  const double dy = y - s.w_y_m;
  const double distance = std::sqrt(dx * dx + dy * dy);
  if (distance > p_.direction_m) {
    s.w_x_m = x - dx / distance * p_.direction_m;
    s.w_y_m = y - dy / distance * p_.direction_m;
  }
  const double direction_x = (x - s.w_x_m) / p_.direction_m;
  const double direction_y = (y - s.w_y_m) / p_.direction_m;

  const models::BoundarySample b = map_->sample(x, y);
  const double speed = std::sqrt(s.vx_m_per_s * s.vx_m_per_s + s.vy_m_per_s * s.vy_m_per_s);
  const double along = direction_x * b.tangent_x + direction_y * b.tangent_y;
  const double printed = p_.force_N * along * b.strength;
  const double wanted = printed * moving(speed, p_.knee_m_per_s) * below_cap(speed);
  s.steady_s += hand.dt_s;
  if (wanted != 0.0) {
    const double heading_x = std::copysign(1.0, wanted) * b.tangent_x;
    const double heading_y = std::copysign(1.0, wanted) * b.tangent_y;
    if (heading_x * s.heading_x + heading_y * s.heading_y < p_.reversal_cosine) {
      s.steady_s = 0.0;
      s.spent_J = kTank_J;
    }
    s.heading_x = heading_x;
    s.heading_y = heading_y;
  }
  // No tick may deliver more energy than the tank contains, even at the fastest motion that the loop accepts.
  const double most = (kTank_J - s.spent_J) / (kFastest_m_per_s * hand.dt_s);
  const double push = p_.is_bounded ? std::clamp(wanted, -most, most) : printed;

  LawOutput output;
  s.last_fx_N = push * b.tangent_x;
  s.last_fy_N = push * b.tangent_y;
  s.last_x_m = x;
  s.last_y_m = y;
  const Vec3 v = hand.velocity_m_per_s.v;
  const double penetration_m = std::max(0.0, -hand.position.v.z);
  output.force_N.v = {s.last_fx_N - p_.damping_Ns_per_m * v.x, s.last_fy_N - p_.damping_Ns_per_m * v.y,
                      p_.wall_N_per_m * penetration_m};
  output.contact = b.strength > 0.0 || penetration_m > 0.0;
  return output;
}

constexpr LawDescription kTracingLaw{
    .law = Law::tracing,
    .name = "tracing",
    .title = "Tracing contours",
    .paper = "Design and implementation of a graphic-haptic display system, 2006, eq. 8",
    .models = {.contours = true},
    .parameters = kParameters,
    .strength = &LawParameters::tracing_force_N,
    .degrees_of_freedom = 2,
    .make = make};

}  // namespace palpable::haptics
