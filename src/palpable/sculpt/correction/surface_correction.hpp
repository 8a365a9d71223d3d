// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace palpable::sculpt {

/// Where a correction gives the field new distances (field_update.hpp).
enum class CorrectedVolume { near_measured, everywhere };

/// How a surface is corrected. reach_m and transition_m depend on the measurement.
struct CorrectionOptions {
  /// Greatest distance along its normal, outwards or inwards, at which a sample of the predicted surface is
  /// matched with the measured one. 1e-6 … 10 m.
  double reach_m = 0.01;
  /// Width of the transition around the measured part: delta of Moustakas 2007, eq. 2. 1e-6 … 10 m.
  double transition_m = 0.005;
  CorrectedVolume volume = CorrectedVolume::near_measured;
  /// Paths along the mesh's edges are followed up to this multiple of the transition, since edges zigzag.
  /// 1 … 4.
  double longest_path = 1.25;
  /// A sample is matched only where the measured surface's outward normal differs from its own by at most
  /// this angle: so the back of a thin slab does not move onto its front. 180 for a measured surface whose
  /// triangles have no known orientation. 1 … 180 degrees.
  double most_match_angle_deg = 180.0;
  /// A correction that turns a triangle by more than this angle is taken back at its corners, repeatedly, and
  /// they follow as in the transition: so the surface does not fold. 180 allows any. 1 … 180 degrees.
  double most_turn_deg = 180.0;
  /// The place of a sample that is measured again is the mean of all measurements so far, of which at most
  /// this many count; 1: the last one. 1 … 10 000.
  int averaged_measurements = 1;
};

std::vector<Parameter> parameters_of(CorrectionOptions& options);

/// The neighbourhood graph of a predicted surface's samples: built once, for all corrections.
struct SampleNetwork;

/// A predicted surface and its displacement towards the measured one.
struct CorrectedSurface {
  /// As predicted, closed. Its vertices are the samples.
  Mesh predicted;
  /// Of `predicted`; never null.
  std::shared_ptr<const SampleNetwork> network;
  /// The displacement of each sample; 0 far from the measured surface.
  std::vector<Vec3> translations_m;
  /// Whether a sample belongs to the set W: samples that lie on the measured surface itself.
  std::vector<bool> measured;
  /// How often a sample was measured, at most CorrectionOptions::averaged_measurements.
  std::vector<std::int32_t> measurements;
  /// A sample that the last correction moved, and its translation before that.
  struct Moved {
    std::uint32_t sample = 0;
    Vec3 before_m;
  };
  std::vector<Moved> moved;
  /// Samples that the last correction matched with the measured surface, moved or not; ascending.
  std::vector<std::uint32_t> matched;

  /// The corrected surface.
  Mesh adapted() const;
  /// The triangles that the last correction changed, before and after it, with their neighbours that share a
  /// vertex, whose normals changed. Only cells of a field for which one of these triangles is the nearest
  /// have to be sampled again. Empty if nothing changed.
  Mesh changed() const;
  /// The part of the corrected surface that the last correction matched with the measured one: the triangles
  /// between samples of `matched`. Samples without such a triangle are degenerate triangles.
  Mesh matched_surface() const;
  /// The greatest displacement of a sample by the last correction.
  double greatest_step_m() const;
};

/// A surface without a correction. Sheets that touch at an edge are separated (with_pinches_divided()).
/// Errors: invalid_input for a mesh that is not closed then either.
Result<CorrectedSurface> predicted_surface(Mesh mesh);

/// Force-field correction of Moustakas et al. 2007, on the surface that the field is then made of. Samples
/// whose normal meets the measured surface, outside or inside, move onto it; they are the set W. Samples
/// within the transition's geodesic distance delta of W follow by eq. 2 with its weights corrected:
///   t(y) = phi(min GD / delta) sum w_i t_i / sum w_i,  w_i = ((delta - GD_i)+ / (delta GD_i))^2,
///   phi(s) = 1 - 10 s^3 + 15 s^4 - 6 s^5.
/// So the transition has no step, no crease and no jump of curvature. Correcting again with more data keeps
/// what was measured before (a later measurement of the same sample replaces it, or is averaged with it) and
/// recomputes translations only within the transition of the samples that changed. Errors: usage for options
/// out of range, invalid_input for a measured mesh that refers to missing vertices or contains NaN,
/// interrupted.
Result<CorrectedSurface> correct_surface(CorrectedSurface surface, const Mesh& measured,
                                         const CorrectionOptions& options, const Work& work);

}  // namespace palpable::sculpt
