// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/bundle.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Core>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

namespace palpable::vision {
namespace {

struct ProjectionError {
  const Pinhole* camera;
  ImagePoint seen;

  template <class T>
  bool operator()(const T* pose, const T* point, const T* focal_scale, T* residual) const {
    T p[3];
    ceres::AngleAxisRotatePoint(pose, point, p);
    for (int i = 0; i < 3; ++i) p[i] += pose[3 + i];
    if (p[2] < T(1e-9)) return false;
    residual[0] = focal_scale[0] * camera->fx * p[0] / p[2] + camera->cx - seen.x;
    residual[1] = focal_scale[0] * camera->fy * p[1] / p[2] + camera->cy - seen.y;
    return true;
  }
};

// The same for a rolling shutter: the place is moved along its track to where it was when the middle of the
// frame was read.
struct RolledProjectionError {
  ProjectionError error;
  PlaceMotion motion;
  ImagePoint at;

  template <class T>
  bool operator()(const T* pose, const T* point, const T* focal_scale, const T* readout, T* residual) const {
    if (!error(pose, point, focal_scale, residual)) return false;
    const T t = readout[0] * at.y + readout[1] * at.x;
    residual[0] += t * motion.velocity.x - t * t * (motion.acceleration.x / 2);
    residual[1] += t * motion.velocity.y - t * t * (motion.acceleration.y / 2);
    return true;
  }
};

Eigen::Vector3d centre_of(const BundlePose& pose) {
  const Vec3 c = camera_pose(pose).translation_m;
  return {c.x, c.y, c.z};
}

// Fixes the scale, which images do not determine: one coordinate of the translation of the camera farthest
// from the first. A free scale makes the normal equations singular once the damping is small, and every such
// step is lost.
void fix_scale(Bundle& bundle, ceres::Problem& problem) {
  const Eigen::Vector3d first = centre_of(bundle.poses.front());
  std::size_t farthest = 0;
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < bundle.poses.size(); ++i) {
    if (!problem.HasParameterBlock(bundle.poses[i].data())) continue;
    // By a change of scale about the first camera, the translation changes in this direction.
    const Eigen::Vector3d offset = centre_of(bundle.poses[i]) - first;
    if (offset.norm() <= moved.norm()) continue;
    farthest = i;
    ceres::AngleAxisRotatePoint(bundle.poses[i].data(), offset.data(), moved.data());
  }
  if (farthest == 0) return;
  int greatest = 0;
  moved.cwiseAbs().maxCoeff(&greatest);
  problem.SetManifold(bundle.poses[farthest].data(),
                      new ceres::SubsetManifold(6, {3 + greatest}));  // owned by the problem
}

class StopWhenCancelled : public ceres::IterationCallback {
 public:
  explicit StopWhenCancelled(const Work& work) : work_(work) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return work_.cancelled() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const Work& work_;
};

}  // namespace

BundlePose bundle_pose(const CameraPose& world_from_camera) {
  const auto inverse = world_from_camera.inverse();
  BundlePose out{};
  ceres::RotationMatrixToAngleAxis(ceres::RowMajorAdapter3x3(inverse.rotation.data()), out.data());
  out[3] = inverse.translation_m.x, out[4] = inverse.translation_m.y, out[5] = inverse.translation_m.z;
  return out;
}

CameraPose camera_pose(const BundlePose& pose) {
  Transform<CameraFrame, WorldFrame> camera_from_world;
  ceres::AngleAxisToRotationMatrix(pose.data(), ceres::RowMajorAdapter3x3(camera_from_world.rotation.data()));
  camera_from_world.translation_m = {pose[3], pose[4], pose[5]};
  return camera_from_world.inverse();
}

double projection_error_px(const Pinhole& camera, const BundlePose& pose, const std::array<double, 3>& point,
                           ImagePoint seen) {
  double residual[2];
  const double focal_scale = 1.0;
  if (!ProjectionError{&camera, seen}(pose.data(), point.data(), &focal_scale, residual))
    return std::numeric_limits<double>::infinity();
  return std::hypot(residual[0], residual[1]);
}

BundleCosts adjust_bundle(Bundle& bundle, const Pinhole& camera, const BundleOptions& options,
                          const Work& work) {
  ceres::Problem problem;
  std::array<double, 2> readout{bundle.readout.rows, bundle.readout.columns};
  for (const Observation& observation : bundle.observations) {
    double* pose = bundle.poses[static_cast<std::size_t>(observation.pose)].data();
    double* point = bundle.points[static_cast<std::size_t>(observation.point)].data();
    const ProjectionError error{&camera, observation.place};
    auto* loss = new ceres::HuberLoss(options.robust_px);
    // All owned by the problem.
    if (options.refine_readout)
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<RolledProjectionError, 2, 6, 3, 1, 2>(new RolledProjectionError{
              error, observation.motion, reading_place(observation.place, camera.width, camera.height)}),
          loss, pose, point, &bundle.focal_scale, readout.data());
    else
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<ProjectionError, 2, 6, 3, 1>(new ProjectionError(error)), loss,
          pose, point, &bundle.focal_scale);
  }
  if (problem.HasParameterBlock(bundle.poses[0].data()))
    problem.SetParameterBlockConstant(bundle.poses[0].data());
  fix_scale(bundle, problem);
  auto* ordering = new ceres::ParameterBlockOrdering;  // owned by the options
  for (auto& point : bundle.points) {
    if (!problem.HasParameterBlock(point.data())) continue;
    ordering->AddElementToGroup(point.data(), 0);
  }
  for (auto& pose : bundle.poses)
    if (problem.HasParameterBlock(pose.data())) ordering->AddElementToGroup(pose.data(), 1);
  if (problem.HasParameterBlock(&bundle.focal_scale)) {
    ordering->AddElementToGroup(&bundle.focal_scale, 1);
    if (options.refine_focal_length) {
      problem.SetParameterLowerBound(&bundle.focal_scale, 0, 0.5);
      problem.SetParameterUpperBound(&bundle.focal_scale, 0, 2.0);
    } else {
      problem.SetParameterBlockConstant(&bundle.focal_scale);
    }
  }
  if (problem.HasParameterBlock(readout.data())) ordering->AddElementToGroup(readout.data(), 1);
  StopWhenCancelled stop(work);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_SCHUR;
  solver.linear_solver_ordering.reset(ordering);
  solver.max_num_iterations = options.most_iterations;
  // More threads would change the order of summation, and so the rounding, from run to run.
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  solver.function_tolerance = 1e-7;
  solver.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  bundle.readout = {readout[0], readout[1]};
  return {summary.initial_cost, summary.final_cost};
}

}  // namespace palpable::vision
