// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/haptic_scene.hpp"

#include "palpable/describe/numbers.hpp"
#include "palpable/haptics/effect/texture.hpp"
#include "palpable/haptics/law/rolling.hpp"
#include "palpable/haptics/law/tool.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/transient_player.hpp"
#include "palpable/models/material/material_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {

Result<models::Scene> with_height_factor(const models::Scene& scene, double height_factor) {
  if (!(std::abs(height_factor) <= 4.0))
    return Error{ErrorCode::usage, "the height factor must be from -4 to 4", {}};
  if (height_factor == 1.0) return scene;
  const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&scene.model);
  if (relief == nullptr)
    return Error{ErrorCode::usage,
                 "only a relief's height can be changed, and this scene is a " + models::kind_of(scene.model),
                 {}};
  Raster<float> height_m = (*relief)->samples_m();
  for (float& height : height_m.values()) height *= static_cast<float>(height_factor);
  auto changed = models::Relief::from_samples(std::move(height_m), (*relief)->pixel_m());
  if (!changed) return std::move(changed).error();
  models::Scene result = scene;
  result.model = std::make_shared<const models::Relief>(std::move(*changed));
  return result;
}

Result<models::Scene> with_materials(const models::Scene& scene, std::vector<models::Material> materials) {
  if (materials.size() != scene.materials.size())
    return Error{ErrorCode::usage, "there must be one material for each that the scene has", {}};
  for (const auto& material : materials)
    if (!models::is_valid(material) || material.stiffness_N_per_m <= 0.0)
      return Error{ErrorCode::usage, "a value of the material is out of its range", material.name};
  models::Scene changed = scene;
  changed.materials = std::move(materials);
  return changed;
}

namespace {

/// Removes textures that this loop and device cannot render, and adds notices about these and about reduced
/// ones.
void make_carried(models::Scene& scene, const device::Traits& device, double rate_hz, double scale,
                  PreparedScene& prepared) {
  if (!haptics::description_of(prepared.law.law).renders_textures) return;
  const double step_m =
      std::isfinite(device.position_resolution_m) ? device.position_resolution_m * scale : 0.0;
  const double finest_m = haptics::min_pitch_m(rate_hz, step_m);
  for (auto& material : scene.materials) {
    auto& texture = material.texture;
    if (texture.kind == models::TouchTexture::Kind::none) continue;
    const double most_m = haptics::max_texture_height_m(texture.pitch_m);
    if (texture.pitch_m < finest_m) {
      prepared.notices.push_back(fmt::format(
          "The texture of {} was left out: its pitch is {}, and this loop and device render none below {}.",
          material.name, describe::length(texture.pitch_m), describe::length(finest_m)));
      texture = {};
    } else if (texture.height_m > most_m) {
      prepared.notices.push_back(fmt::format(
          "The height of the texture of {} was reduced from {:.0f} to {:.0f} micrometres: a higher one would "
          "make the wall too stiff.",
          material.name, 1e6 * texture.height_m, 1e6 * most_m));
      texture.height_m = most_m;
    }
  }
}

/// Sets the requested transient, or none with a notice if this loop and device cannot render it.
void choose_transient(haptics::TransientKind wanted, const device::Traits& device, double rate_hz,
                      PreparedScene& prepared) {
  const auto transient = haptics::transient_of(wanted);
  if (haptics::can_render(transient, device, rate_hz)) {
    prepared.transient = wanted;
    prepared.scene.transient = transient;
  } else if (wanted != haptics::TransientKind::none) {
    prepared.notices.push_back(fmt::format(
        "The contact transient {} ({:.0f} Hz) was left out: this loop and device cannot render it.",
        haptics::name_of(wanted), transient.frequency_hz));
  }
}

/// Least rotational damping that the fingers add to a handle: an assumption, like
/// haptics::kLeastHandDamping_Ns_per_m.
constexpr double kLeastHandRotationalDamping_Nm_s = 0.004;

/// The device's properties at a tool point far from the hand: its damping there is the handle's rotational
/// damping divided by the squared lever arm, if that is less.
device::Traits at_lever(device::Traits device, const haptics::LawParameters& law, double scale,
                        double hand_damping_Ns_per_m) {
  if (law.law != haptics::Law::tool) return device;
  haptics::ToolShape shape;
  shape.radius_m = law.tool_radius_m.value_or(shape.radius_m);
  shape.length_m = law.tool_length_m.value_or(shape.length_m);
  const double lever_m = (shape.length_m + shape.radius_m) / scale;
  const double rotational =
      std::isfinite(device.rotational_damping_Nm_s) ? device.rotational_damping_Nm_s : 0.0;
  const double there_Ns_per_m =
      (rotational + kLeastHandRotationalDamping_Nm_s) / (lever_m * lever_m) - hand_damping_Ns_per_m;
  const double own = std::isfinite(device.damping_Ns_per_m) ? device.damping_Ns_per_m : 0.0;
  device.damping_Ns_per_m = std::min(own, there_Ns_per_m);
  return device;
}

/// Limits the requested stiffness and damping to what the device can render without generating energy.
void make_safe(models::Scene& scene, const device::Traits& device, double rate_hz, double scale,
               double hand_damping_Ns_per_m, PreparedScene& prepared) {
  auto& law = prepared.law;
  const haptics::LawDescription& description = haptics::description_of(law.law);
  if (!description.is_contact) return;
  const device::Traits held_device = at_lever(device, law, scale, hand_damping_Ns_per_m);
  std::string lowered;
  for (auto& material : scene.materials) {
    const double stiffness = law.stiffness_N_per_m.value_or(material.stiffness_N_per_m);
    const double damping = law.damping_Ns_per_m.value_or(material.damping_Ns_per_m);
    // Values out of range are rejected later by the law.
    if (!(stiffness > 0.0) || !(damping >= 0.0)) return;
    // A texture increases the effective stiffness of a wall.
    const double stiffening =
        description.renders_textures ? haptics::texture_stiffening(material.texture) : 1.0;
    const auto safe = haptics::safe_contact(held_device, rate_hz, scale, stiffening * stiffness, damping,
                                            hand_damping_Ns_per_m);
    material.stiffness_N_per_m = safe.stiffness_N_per_m / stiffening;
    material.damping_Ns_per_m = safe.damping_Ns_per_m;
    if (safe.bound != haptics::StiffnessBound::none && lowered.empty())
      lowered = fmt::format("Stiffness {:.0f} N/m was lowered to {:.0f} N/m: {}.", stiffness,
                            material.stiffness_N_per_m, haptics::reason(safe.bound));
  }
  law.stiffness_N_per_m.reset();
  law.damping_Ns_per_m.reset();
  if (!lowered.empty()) prepared.notices.push_back(std::move(lowered));
}

/// Limits the force of a ball on a slope so that the device can render a slope of 45 degrees. A capped force
/// no longer corresponds to the slope: it pushes a hand that moves uphill with less than one that moves
/// downhill.
void limit_slope_force(const device::Traits& device, PreparedScene& prepared) {
  const auto* parameter = haptics::find_parameter(haptics::description_of(prepared.law.law),
                                                  &haptics::LawParameters::slope_force_N);
  if (parameter == nullptr || !device.pushes_back) return;
  const double wanted_N = prepared.law.slope_force_N.value_or(parameter->preset.value_or(0.0));
  if (!(wanted_N > device.max_force_N) || wanted_N > parameter->max) return;
  prepared.law.slope_force_N = device.max_force_N;
  prepared.notices.push_back(fmt::format(
      "The force {:.2g} N on a slope of 1 was lowered to {:.2g} N: it is the greatest that the device gives.",
      wanted_N, device.max_force_N));
}

/// Smooths what a ball rolls on, and limits its force, to what loop and device can render at every place. A
/// slope beyond the device's force, or a bend beyond the stiffness limit, would generate energy.
void fit_to_bends(const models::Scene& scene, const device::Traits& device, double rate_hz, double scale,
                  double hand_damping_Ns_per_m, PreparedScene& prepared) {
  auto& law = prepared.law;
  const auto& description = haptics::description_of(law.law);
  const auto* smoothing = haptics::find_parameter(description, &haptics::LawParameters::rolling_smoothing_m);
  const auto* force = haptics::find_parameter(description, &haptics::LawParameters::slope_force_N);
  const auto* damper = haptics::find_parameter(description, &haptics::LawParameters::damping_Ns_per_m);
  if (smoothing == nullptr || force == nullptr || damper == nullptr || !device.pushes_back) return;
  const haptics::RollingFit wanted{law.slope_force_N.value_or(force->preset.value_or(0.0)),
                                   law.rolling_smoothing_m.value_or(smoothing->preset.value_or(0.0))};
  const double least_damping = damper->preset.value_or(0.0);
  const double wanted_damping = law.damping_Ns_per_m.value_or(least_damping);
  const double damping = std::max(least_damping, wanted_damping);
  // Values out of range are rejected later by the law.
  const auto is_within = [](const haptics::LawParameter& of, double value) {
    return value >= of.min && value <= of.max;
  };
  if (!is_within(*force, wanted.slope_force_N) || !is_within(*smoothing, wanted.smoothing_m) ||
      !is_within(*damper, wanted_damping))
    return;
  const auto safe = haptics::safe_slopes(device, rate_hz, scale, damping, hand_damping_Ns_per_m);
  law.damping_Ns_per_m = safe.damping_Ns_per_m;
  const auto fit = haptics::fit_rolling(scene, wanted, {safe.max_stiffness_N_per_m, safe.max_force_N});
  law.slope_force_N = fit.slope_force_N;
  law.rolling_smoothing_m = fit.smoothing_m;
  // With less damping no bend could be rendered: each is a spring (stability.hpp).
  if (*law.damping_Ns_per_m > wanted_damping)
    prepared.notices.push_back(
        fmt::format("The damping {:.2g} N·s/m was raised to {:.2g} N·s/m: with less, a ball that rolls "
                    "through bends would return more energy than it received.",
                    wanted_damping, *law.damping_Ns_per_m));
  if (fit.smoothing_m > wanted.smoothing_m)
    prepared.notices.push_back(
        fmt::format("The ball rolls on a surface that is smoothed by {}: this loop and device cannot render "
                    "sharper bends.",
                    describe::length(fit.smoothing_m)));
  if (fit.slope_force_N < wanted.slope_force_N)
    prepared.notices.push_back(
        fmt::format("The force {:.2g} N on a slope of 1 was lowered to {:.2g} N: this loop and device cannot "
                    "render more on this surface.",
                    wanted.slope_force_N, fit.slope_force_N));
}

/// Limits the ball to what a field has room for, rather than refusing a scene because of the last one's ball.
void limit_radius(const models::Scene& scene, PreparedScene& prepared) {
  const double largest_m = haptics::largest_radius_m(scene, prepared.law.law);
  const auto* parameter =
      haptics::find_parameter(haptics::description_of(prepared.law.law), &haptics::LawParameters::radius_m);
  const double wanted_m = prepared.law.radius_m.value_or(0.0);
  // Values out of range are rejected later by the law.
  if (!(wanted_m > largest_m) || wanted_m > parameter->max) return;
  prepared.law.radius_m = largest_m;
  prepared.notices.push_back(fmt::format("The probe's radius was lowered: {}.",
                                         haptics::too_large_ball_words(wanted_m, scene, prepared.law.law)));
}

/// The damping that was set for one law does not apply to another.
void replace_law(haptics::LawParameters& parameters, haptics::Law law) {
  parameters.law = law;
  parameters.damping_Ns_per_m.reset();
}

/// "contours", "reliefs and fields".
std::string kinds_of(const haptics::ModelKinds& models) {
  std::vector<std::string> kinds;
  if (models.relief) kinds.emplace_back("reliefs");
  if (models.field) kinds.emplace_back("fields");
  if (models.grid) kinds.emplace_back("grids");
  if (models.contours) kinds.emplace_back("contours");
  return describe::listed(kinds);
}

std::string scenes_of_law_words(haptics::Law law, const models::Scene& scene) {
  const std::string kind = models::kind_of(scene.model);
  return fmt::format("The law {} is for {}, not for {}", haptics::name_of(law),
                     kinds_of(haptics::description_of(law).models), kind.ends_with('s') ? kind : kind + "s");
}

std::string other_law_words(haptics::Law asked, haptics::Law used, const models::Scene& scene) {
  return fmt::format("{}: this scene is touched with the law {}.", scenes_of_law_words(asked, scene),
                     haptics::name_of(used));
}

/// What a device in the plane feels of a solid; empty for other scenes.
std::string seen_from_above(const models::Scene& scene) {
  if (!models::is_field(scene.model) && models::kind_of(scene.model) != "grid") return {};
  return " Of a solid it feels the slopes as they are seen from above: neither its height nor what is below.";
}

/// The scene's law that is passive and needs only two axes.
haptics::Law passive_planar_law(const std::vector<haptics::Law>& laws) {
  const auto found = std::find_if(laws.begin(), laws.end(), [](haptics::Law law) {
    const auto& description = haptics::description_of(law);
    return description.degrees_of_freedom == 2 && description.conservative;
  });
  return found != laws.end() ? *found : laws.front();
}

Result<models::Scene> with_kept_height(const models::Scene& scene, double height_factor, KeptSurfaces& kept) {
  const auto* relief = std::get_if<std::shared_ptr<const models::Relief>>(&scene.model);
  if (relief == nullptr || height_factor == 1.0) return with_height_factor(scene, height_factor);
  if (kept.of != *relief || kept.height_factor != height_factor) {
    auto scaled = with_height_factor(scene, height_factor);
    if (!scaled) return scaled;
    kept.of = *relief;
    kept.height_factor = height_factor;
    kept.scaled = std::get<std::shared_ptr<const models::Relief>>(scaled->model);
  }
  models::Scene result = scene;
  result.model = kept.scaled;
  return result;
}

}  // namespace

Result<PreparedScene> prepare_scene(const models::Scene& scene, const TouchSettings& settings,
                                    const device::Traits& device, double rate_hz,
                                    const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                                    KeptSurfaces& kept, const Work& work) {
  PreparedScene prepared;
  prepared.law = settings.law;
  const auto laws = haptics::laws_for(scene);
  if (std::find(laws.begin(), laws.end(), prepared.law.law) == laws.end()) {
    if (settings.law_is_required)
      return Error{
          ErrorCode::usage, scenes_of_law_words(prepared.law.law, scene) + ", and no other will do", {}};
    if (settings.law_is_chosen)
      prepared.notices.push_back(other_law_words(prepared.law.law, laws.front(), scene));
    replace_law(prepared.law, laws.front());
  }
  if (haptics::description_of(prepared.law.law).degrees_of_freedom == 6 && !device.has_torque) {
    prepared.notices.push_back("The device has no torque, so the law is " +
                               std::string(haptics::name_of(laws.front())) + " instead of tool.");
    replace_law(prepared.law, laws.front());
  }
  if (device.degrees_of_freedom < std::min(3, haptics::description_of(prepared.law.law).degrees_of_freedom)) {
    const haptics::Law planar = passive_planar_law(laws);
    prepared.notices.push_back(
        "The device moves in the plane only, so the law is " + std::string(haptics::name_of(planar)) +
        " instead of " + std::string(haptics::name_of(prepared.law.law)) + "." + seen_from_above(scene));
    replace_law(prepared.law, planar);
  }
  auto scaled = with_kept_height(scene, settings.height_factor, kept);
  if (!scaled) return std::move(scaled).error();
  if (settings.limits == Limits::of_device) {
    const double scale = scene_from_device.scale;
    limit_slope_force(device, prepared);
    fit_to_bends(*scaled, device, rate_hz, scale, settings.hand_damping_Ns_per_m, prepared);
    make_safe(*scaled, device, rate_hz, scale, settings.hand_damping_Ns_per_m, prepared);
  }
  limit_radius(*scaled, prepared);
  make_carried(*scaled, device, rate_hz, scene_from_device.scale, prepared);
  prepared.materials = scaled->materials;
  auto touchable = haptics::make_touchable(*scaled, prepared.law, &kept.dilated, work);
  if (!touchable) return std::move(touchable).error();
  prepared.scene.touchable = std::move(*touchable);
  prepared.scene.scene_from_device = scene_from_device;
  choose_transient(settings.transient, device, rate_hz, prepared);
  return prepared;
}

}  // namespace palpable::session
