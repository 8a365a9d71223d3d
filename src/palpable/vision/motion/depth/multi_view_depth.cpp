// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include "palpable/vision/motion/depth/plane_sweep.hpp"

namespace palpable::vision {

std::vector<Parameter> parameters_of(MultiViewOptions& o) {
  std::vector<Parameter> out{
      {"step_px", &o.step_px, {0.2, 4}, "px", "Movement of a pixel between the depths that are tried"},
      {"most_steps", &o.most_steps, {16, 1024}, "", "Depths that are tried at most"},
      {"seen_share", &o.seen_share, {0.1, 1}, "", "Share of the other frames that count, the best ones"}};
  append_parameters(out, "volume", parameters_of(o.volume));
  append_parameters(out, "sgm", parameters_of(o.sgm));
  return out;
}

Result<DepthMap> multi_view_depth(const PosedFrame& reference, std::span<const PosedFrame> others,
                                  const Pinhole& camera, DepthSpan span, const MultiViewOptions& options,
                                  const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  if (others.empty() || others.size() > PlaneSweep::kMostOthers || !(span.near > 0 && span.far > span.near))
    return Error{ErrorCode::usage,
                 "multi-view depth needs 1 to 16 other frames and a span of depths",
                 {},
                 Reason::unspecified};
  const PlaneSweep sweep(reference, others, camera, span, options, work);
  CostVolume volume(camera.width, camera.height, sweep.steps()),
      sums(camera.width, camera.height, sweep.steps());
  sweep.fill(volume, work);
  const ColourPlanes& colour = sweep.reference().colour;
  average_over_crosses(colour, options.volume.cross, volume, sums, work);
  aggregate_paths(volume, colour, colour, options.sgm, sums, work);
  if (work.cancelled()) return Work::interrupted();
  const Raster<float> step = least_cost_disparity(sums, work);
  DepthMap out{Raster<float>(camera.width, camera.height), camera};
  for (std::size_t i = 0; i < step.count(); ++i)
    out.depth_m.values()[i] =
        static_cast<float>(1 / sweep.inverse_depth(static_cast<double>(step.values()[i])));
  return out;
}

}  // namespace palpable::vision
