// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace palpable::haptics {

/// All laws. A kind of model's default law is the first that renders it.
std::span<const LawDescription* const> all_laws();
const LawDescription& description_of(Law law);
/// The name on the command line; and back, nullopt for an unknown name.
std::string_view name_of(Law law);
std::optional<Law> law_from(std::string_view name);
/// Every law that exists for a scene of this kind, the default first.
std::vector<Law> laws_for(const models::Scene& scene);

/// A relief dilated by the ball that touches it: what make_touchable() took long to make, kept by who changes
/// parameters during a touch. Empty at first. One thread at a time.
struct DilatedRelief {
  std::shared_ptr<const models::Relief> of;
  double radius_m = 0.0;
  std::shared_ptr<const models::Relief> surface;
};

/// Surface + law, ready for the servo loop. Work that a law needs once (dilating a relief by the ball)
/// happens here, outside the tick: up to a second for large radii; not again where `kept` already has it.
/// Errors: usage for a parameter of the law out of its range or a law that this kind of scene does not have.
Result<std::shared_ptr<const Touchable>> make_touchable(const models::Scene& scene,
                                                        const LawParameters& parameters,
                                                        DilatedRelief* kept = nullptr);

}  // namespace palpable::haptics
