// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include "palpable/vision/motion/depth/plane_sweep.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace palpable::vision {
namespace {

// Whether the lines of sight of all pixels meet planes with this normal in front of the camera.
bool all_meet(const Pinhole& camera, const Vec3& normal) {
  for (const int x : {0, camera.width - 1})
    for (const int y : {0, camera.height - 1})
      if (!(dot(normal, line_of_sight(camera, x, y)) > 0)) return false;
  return true;
}

// The depth of least cost over several sweeps.
class BestDepth {
 public:
  explicit BestDepth(const Pinhole& camera)
      : out_{Raster<float>(camera.width, camera.height), camera},
        costs_(camera.width, camera.height, std::numeric_limits<std::uint16_t>::max()) {}

  void add(const PlaneSweep& sweep, const MultiViewOptions& options, const Work& work) {
    const int width = costs_.width(), height = costs_.height();
    CostVolume volume(width, height, sweep.steps()), sums(width, height, sweep.steps());
    sweep.fill(volume, work);
    const ColourPlanes& colour = sweep.reference().colour;
    average_over_crosses(colour, options.volume.cross, volume, sums, work);
    aggregate_paths(volume, colour, colour, options.sgm, sums, work);
    const Raster<float> steps = least_cost_disparity(sums, work);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::uint16_t cost = sums.at(x, y)[std::lround(steps(x, y))];
        if (cost >= costs_(x, y)) continue;
        costs_(x, y) = cost;
        out_.depth_m(x, y) =
            static_cast<float>(1 / sweep.inverse_depth(x, y, static_cast<double>(steps(x, y))));
      }
  }
  DepthMap take() { return std::move(out_); }

 private:
  DepthMap out_;
  Raster<std::uint16_t> costs_;
};

}  // namespace

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
                                  const Pinhole& camera, std::span<const SweptPlanes> sweeps,
                                  const MultiViewOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  if (others.empty() || others.size() > PlaneSweep::kMostOthers || sweeps.empty())
    return Error{
        ErrorCode::usage, "multi-view depth needs 1 to 16 other frames and planes", {}, Reason::unspecified};
  for (const SweptPlanes& planes : sweeps)
    if (!(planes.near > 0 && planes.far > planes.near) || !all_meet(camera, planes.normal))
      return Error{ErrorCode::usage,
                   "lines of sight do not meet the planes, or they have no range",
                   {},
                   Reason::unspecified};
  BestDepth best(camera);
  for (const SweptPlanes& planes : sweeps) {
    best.add(PlaneSweep(reference, others, camera, planes, options, work), options, work);
    if (work.cancelled()) return Work::interrupted();
  }
  return best.take();
}

}  // namespace palpable::vision
