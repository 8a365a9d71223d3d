// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"

#include <cstddef>

namespace palpable::recipes {

struct CorrectedScene {
  MadeScene made;
  /// Samples of the field's surface that were moved onto the measured one, and all moved samples.
  std::size_t measured_samples = 0;
  std::size_t moved_samples = 0;
};

/// A scene's field corrected by a measured surface (Moustakas et al. 2007), which is given in the frame of
/// the input that the scene was made from (scene_from_input). The field's own surface, sampled every four
/// finest cells, is corrected. The field is sampled again only where that changes it; as a whole if the
/// corrected solid leaves its box. Errors: usage for a scene that is no field; failed if no part of the
/// measured surface was matched; as sculpt::corrected_field().
Result<CorrectedScene> correct_scene(const models::Scene& scene, Mesh measured,
                                     const sculpt::CorrectionOptions& options, const Work& work);

}  // namespace palpable::recipes
