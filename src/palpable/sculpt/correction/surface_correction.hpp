// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace palpable::sculpt {

/// Where a correction gives the field new distances (field_update.hpp).
enum class CorrectedVolume { near_measured, everywhere };

struct CorrectionOptions {
  /// How far along its normal a sample of the predicted surface looks for the measured one, outwards and
  /// inwards, > 0.
  double reach_m = 0.01;
  /// Width of the transition around what was measured: delta of Moustakas 2007, eq. 2; > 0.
  double transition_m = 0.005;
  CorrectedVolume volume = CorrectedVolume::near_measured;
};

/// How a predicted surface's samples lie to each other: found once, for all corrections.
struct SampleNetwork;

/// A predicted surface on its way to what was measured.
struct CorrectedSurface {
  /// As predicted, closed; a sample a vertex.
  Mesh predicted;
  /// Of `predicted`; never null.
  std::shared_ptr<const SampleNetwork> network;
  /// Where each sample goes. 0 where nothing was measured near.
  std::vector<Vec3> translations_m;
  /// Whether a sample is of the set W: pulled onto the measured surface itself.
  std::vector<bool> measured;
  /// A sample that the last correction moved, and its translation before that.
  struct Moved {
    std::uint32_t sample = 0;
    Vec3 before_m;
  };
  std::vector<Moved> moved;
  /// Samples that the last correction found on the measured surface, rising; moved or there already.
  std::vector<std::uint32_t> pulled;

  /// The surface as it stands.
  Mesh adapted() const;
  /// The triangles that the last correction changed, as they were and as they are, with those that share a
  /// corner with them, whose normals turned: only where one of them is the nearest does a field need another
  /// look. Empty where nothing changed.
  Mesh changed() const;
  /// What the last correction pulled onto the measured surface, as it stands: the triangles between samples
  /// of `pulled`, and the others of them as triangles without extent.
  Mesh pulled_surface() const;
  /// The longest way that a sample moved at the last correction.
  double greatest_step_m() const;
};

/// Before any correction. Errors: invalid_input for a mesh that is not closed.
Result<CorrectedSurface> predicted_surface(Mesh mesh);

/// Force-field correction of Moustakas et al. 2007, on the surface that the field is then made of: samples
/// whose normal meets the measured surface, outside or inside, move onto it (W); samples within the
/// transition's geodesic distance of W follow by eq. 2 with its weights corrected,
///   t(y) = phi(min GD / delta) sum w_i t_i / sum w_i,  w_i = ((delta - GD_i)+ / (delta GD_i))^2,
///   phi(s) = 1 - 10 s^3 + 15 s^4 - 6 s^5,
/// so that the surface has neither step nor crease through the transition, nor a jump of its curvature, which
/// would show between samples. Correcting again with more data
/// keeps what was measured before (a later measurement of the same sample replaces it) and recomputes
/// translations only within the transition of the samples that changed. Errors: usage for options out of
/// range, invalid_input for a measured mesh that names vertices it does not have or holds NaN, interrupted.
Result<CorrectedSurface> correct_surface(CorrectedSurface surface, const Mesh& measured,
                                         const CorrectionOptions& options, const Work& work);

}  // namespace palpable::sculpt
