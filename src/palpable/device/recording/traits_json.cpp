// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/recording/traits_json.hpp"

#include "palpable/core/text/json_integer.hpp"

#include <cmath>
#include <string_view>

#include <nlohmann/json.hpp>

namespace palpable::device {
namespace {

using Json = nlohmann::ordered_json;

/// A number of the traits, its name, and the meaning of null.
struct TraitNumber {
  std::string_view name;
  double Traits::*value;
  double if_null;
};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// Recordings from before they were known do not have these.
constexpr std::string_view kContinuous = "continuous_force_N";
constexpr std::string_view kSensorPeriod = "sensor_period_s";
constexpr TraitNumber kTraitNumbers[]{
    {"max_force_N", &Traits::max_force_N, kUnbounded},
    {kContinuous, &Traits::continuous_force_N, kUnknown},
    {"mass_kg", &Traits::mass_kg, kUnknown},
    {"damping_Ns_per_m", &Traits::damping_Ns_per_m, kUnknown},
    {"coulomb_friction_N", &Traits::coulomb_friction_N, kUnknown},
    {"position_resolution_m", &Traits::position_resolution_m, kUnknown},
    {"rate_hz", &Traits::rate_hz, kUnknown},
    {kSensorPeriod, &Traits::sensor_period_s, 0.0},
    {"max_torque_Nm", &Traits::max_torque_Nm, kUnbounded},
    {"inertia_kg_m2", &Traits::inertia_kg_m2, kUnknown},
    {"rotational_damping_Nm_s", &Traits::rotational_damping_Nm_s, kUnknown}};

Traits traits_from(const Json& json) {
  Traits traits;
  traits.name = json.at("name").get<std::string>();
  traits.degrees_of_freedom = integer_from<int>(json.at("degrees_of_freedom"));
  traits.delay_samples = integer_from<int>(json.at("delay_samples"));
  traits.pushes_back = json.at("pushes_back").get<bool>();
  traits.has_torque = json.at("has_torque").get<bool>();
  const auto& work = json.at("workspace_m");
  traits.workspace_m = {work.at(0).get<double>(), work.at(1).get<double>(), work.at(2).get<double>()};
  for (const TraitNumber& number : kTraitNumbers) {
    const bool is_later = number.name == kContinuous || number.name == kSensorPeriod;
    if (is_later && !json.contains(std::string(number.name))) continue;
    const auto& value = json.at(std::string(number.name));
    traits.*number.value = value.is_null() ? number.if_null : value.get<double>();
  }
  return traits;
}

}  // namespace

std::string traits_json(const Traits& traits) {
  Json json{{"name", traits.name},
            {"degrees_of_freedom", traits.degrees_of_freedom},
            {"workspace_m", {traits.workspace_m.x, traits.workspace_m.y, traits.workspace_m.z}},
            {"delay_samples", traits.delay_samples},
            {"pushes_back", traits.pushes_back},
            {"has_torque", traits.has_torque}};
  for (const TraitNumber& number : kTraitNumbers) {
    const double value = traits.*number.value;
    json[std::string(number.name)] = std::isfinite(value) ? Json(value) : Json(nullptr);
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<Traits> recorded_traits(const std::string& header_json) {
  try {
    const Json header = Json::parse(header_json);
    if (!header.is_object() || !header.contains("traits")) return std::nullopt;
    return traits_from(header.at("traits"));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace palpable::device
