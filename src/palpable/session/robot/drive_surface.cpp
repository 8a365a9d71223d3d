// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/drive_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::session {
namespace {

constexpr int kColumns = 17;
constexpr int kRows = 9;
constexpr double kSpringSlope = 1.0;
constexpr double kGuidanceSlope = 2.0;

/// Integrals over the way ahead of the share by which the robot goes slower than the hand asks for, on a
/// lattice of the hand's places: columns from left to right, rows from the middle ahead.
class Resistance {
 public:
  explicit Resistance(const RobotDrive& drive) {
    for (int i = 0; i < kColumns; ++i) {
      double before = 0.0;
      for (int j = 1; j < kRows; ++j) {
        const RobotVelocity asked =
            drive.asked({2.0 * i / (kColumns - 1) - 1.0, double{1.0} * j / (kRows - 1)});
        double slower = 0.0;
        if (asked.forward_m_per_s > 0.0)
          slower = 1.0 -
                   drive.allowed_m_per_s(asked.turn_rad_per_s, asked.forward_m_per_s) / asked.forward_m_per_s;
        at(i, j) = at(i, j - 1) + 0.5 * (before + slower) / (kRows - 1);
        before = slower;
      }
    }
  }

  double operator()(const DriveHand& hand) const {
    const double x = 0.5 * (std::clamp(hand.right, -1.0, 1.0) + 1.0) * (kColumns - 1);
    const double y = std::clamp(hand.ahead, 0.0, 1.0) * (kRows - 1);
    const int i = std::min(static_cast<int>(x), kColumns - 2), j = std::min(static_cast<int>(y), kRows - 2);
    const double u = x - i, v = y - j;
    return (1.0 - v) * ((1.0 - u) * at(i, j) + u * at(i + 1, j)) +
           v * ((1.0 - u) * at(i, j + 1) + u * at(i + 1, j + 1));
  }

 private:
  double& at(int i, int j) { return values_[static_cast<std::size_t>(j * kColumns + i)]; }
  double at(int i, int j) const { return values_[static_cast<std::size_t>(j * kColumns + i)]; }
  std::array<double, kColumns * kRows> values_{};
};

/// Half the shorter side.
double reach_m(const models::Relief& relief) { return 0.5 * std::min(relief.size_x_m(), relief.size_y_m()); }

}  // namespace

DriveHand drive_hand_at(double x_m, double y_m, const models::Relief& relief) {
  const double reach = reach_m(relief);
  return {x_m / reach, y_m / reach};
}

Result<std::shared_ptr<const models::Relief>> drive_surface(const RobotDrive& drive,
                                                            const models::Relief& like) {
  const Resistance resistance(drive);
  const double reach = reach_m(like);
  const auto& samples = like.samples_m();
  // Coarser by a whole factor, if that keeps the size.
  constexpr int kCoarser = 4;
  const int k = samples.width() % kCoarser == 0 && samples.height() % kCoarser == 0 ? kCoarser : 1;
  const double pixel_m = k * like.pixel_m();
  Raster<float> height_m(samples.width() / k, samples.height() / k);
  for (int row = 0; row < height_m.height(); ++row)
    for (int column = 0; column < height_m.width(); ++column) {
      const DriveHand hand{(column - 0.5 * (height_m.width() - 1)) * pixel_m / reach,
                           (0.5 * (height_m.height() - 1) - row) * pixel_m / reach};
      const double beyond =
          std::clamp((std::hypot(hand.right, hand.ahead) - kDeadZone) / (1.0 - kDeadZone), 0.0, 1.0);
      const double spring = 0.5 * kSpringSlope * (1.0 - kDeadZone) * beyond * beyond;
      height_m(column, row) = static_cast<float>(reach * (spring + kGuidanceSlope * resistance(hand)));
    }
  auto relief = models::Relief::from_samples(std::move(height_m), pixel_m);
  if (!relief) return std::move(relief).error();
  return std::make_shared<const models::Relief>(*std::move(relief));
}

}  // namespace palpable::session
