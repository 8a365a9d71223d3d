// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_laws.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace palpable::page {
namespace {

using haptics::LawParameters;

/// The scene's value of a parameter that is not set.
double decided_by_scene(const models::Scene& scene, const haptics::LawParameter& parameter) {
  const auto& material = scene.materials.front();
  if (parameter.value == &LawParameters::stiffness_N_per_m) return material.stiffness_N_per_m;
  if (parameter.value == &LawParameters::damping_Ns_per_m) return material.damping_Ns_per_m;
  if (parameter.value == &LawParameters::static_friction) return material.static_friction;
  if (parameter.value == &LawParameters::dynamic_friction) return material.dynamic_friction;
  if (parameter.value == &LawParameters::neighbourhood_px)
    if (const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model))
      return (*contours)->boundaries.radius_px();
  return 0.0;
}

}  // namespace

protocol::Laws page_laws(const models::Scene& scene, const device::Traits& device) {
  protocol::Laws all;
  for (const auto law : haptics::laws_for(scene)) {
    const haptics::LawDescription& description = haptics::description_of(law);
    protocol::Law& message = all.laws.emplace_back();
    message.name = description.name;
    message.title = description.title;
    message.has_materials = description.is_contact;
    message.has_texture = description.renders_textures;
    if (description.degrees_of_freedom > 3 && !device.has_torque)
      message.unavailable = "needs a device with torque";
    for (const auto& p : description.parameters)
      message.parameters.push_back(
          {std::string(p.name), std::string(p.title), std::string(p.unit), p.slider_min, p.slider_max});
  }
  return all;
}

std::vector<protocol::ParameterValue> parameter_values(const models::Scene& scene, haptics::Law law,
                                                       const LawParameters& parameters) {
  std::vector<protocol::ParameterValue> values;
  for (const auto& parameter : haptics::description_of(law).parameters) {
    const std::optional<double> set = parameters.*parameter.value;
    const double unset = parameter.preset ? *parameter.preset : decided_by_scene(scene, parameter);
    const bool follows = parameter.value == &LawParameters::dynamic_friction && parameters.static_friction;
    values.push_back(
        {std::string(parameter.name), set,
         set.value_or(follows ? models::kDynamicOfStatic * *parameters.static_friction : unset)});
  }
  return values;
}

Result<LawParameters> requested_parameters(const LawParameters& before, const protocol::Change& change) {
  const auto law = haptics::law_from(change.law);
  if (!law) return Error{ErrorCode::usage, "there is no such law", change.law};
  const auto& known = haptics::description_of(*law).parameters;
  LawParameters parameters = before;
  parameters.law = *law;
  for (const auto& parameter : known) parameters.*parameter.value = std::nullopt;
  for (const auto& requested : change.parameters) {
    const auto parameter =
        std::find_if(known.begin(), known.end(), [&](const auto& p) { return p.name == requested.name; });
    if (parameter == known.end())
      return Error{ErrorCode::usage, "the law " + change.law + " has no such parameter", requested.name};
    parameters.*parameter->value = requested.value;
  }
  return parameters;
}

}  // namespace palpable::page
