// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/haptics/law/law.hpp"
#include "palpable/haptics/law/touchable.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::haptics {

/// All laws. The default law of a kind of model is the first one that renders it.
std::span<const LawDescription* const> all_laws();
const LawDescription& description_of(Law law);
/// The name on the command line; and the reverse, nullopt for an unknown name.
std::string_view name_of(Law law);
std::optional<Law> law_from(std::string_view name);
/// All laws for this kind of scene, the default first.
std::vector<Law> laws_for(const models::Scene& scene);

/// The largest radius of a ball that touches the scene by this law. On a field it is the space between the
/// solid and the field's border, less half a cell: beyond the border the distance is not the field's own and
/// the force not its gradient. Otherwise infinite.
double largest_radius_m(const models::Scene& scene, Law law);
/// That a ball is larger than largest_radius_m(), and which field it could touch, as a clause.
std::string too_large_ball_words(double radius_m, const models::Scene& scene, Law law);

/// Cache of the dilated relief, whose computation in make_touchable() is expensive. The owner of a touch
/// keeps it while parameters change. Empty at first. One thread at a time.
struct DilatedRelief {
  std::shared_ptr<const models::Relief> of;
  double radius_m = 0.0;
  std::shared_ptr<const models::Relief> surface;
};

/// Creates the Touchable of a scene and a law, with the pull of the scene's guide, for the servo loop.
/// One-time work (dilating a relief by the ball) is done here, outside the tick; for a relief of 4 megapixels
/// it takes seconds, longer for large radii and rough surfaces, and is skipped if `kept` contains the result.
/// Long work: reports progress, polls cancel. Errors: usage for a scene without a model or with an invalid
/// guide, a parameter of the law out of range, a ball larger than largest_radius_m(), or a law that does not
/// support this kind of scene; interrupted.
Result<std::shared_ptr<const Touchable>> make_touchable(const models::Scene& scene,
                                                        const LawParameters& parameters,
                                                        DilatedRelief* kept = nullptr, const Work& work = {});

}  // namespace palpable::haptics
