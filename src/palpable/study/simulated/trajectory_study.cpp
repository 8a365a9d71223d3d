// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/trajectory_study.hpp"

#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/safety/limits.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <random>
#include <string>
#include <tuple>
#include <utility>

namespace palpable::study {
namespace {

constexpr double kTick_s = 0.001;
constexpr double kPixel_m = 0.00015625;
constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kGround_m = 0.002;
/// The default slope limit of reliefs.
constexpr double kSteepest = 3.0;
constexpr double kTolerance_N = 1e-6;

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
int between(std::mt19937_64& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// A hand that moves at random above, through and under the surface.
class RandomHand {
 public:
  RandomHand(std::uint64_t seed, const models::Relief& surface, double fastest_m_per_s)
      : random_(seed),
        fastest_(fastest_m_per_s),
        half_x_m_(0.48 * surface.size_x_m()),
        half_y_m_(0.48 * surface.size_y_m()),
        low_m_(surface.lowest_m() - 0.001),
        high_m_(surface.highest_m() + 0.003) {
    place_.x = between(random_, -half_x_m_, half_x_m_);
    place_.y = between(random_, -half_y_m_, half_y_m_);
    place_.z = std::min(high_m_, surface.sample(place_.x, place_.y).z_m + between(random_, 0.0, 0.003));
    choose();
  }
  Vec3 place() const { return place_; }
  Vec3 velocity() const { return velocity_; }
  void move() {
    if (--left_ == 0) choose();
    place_ += kTick_s * velocity_;
    turn(place_.x, velocity_.x, -half_x_m_, half_x_m_);
    turn(place_.y, velocity_.y, -half_y_m_, half_y_m_);
    turn(place_.z, velocity_.z, low_m_, high_m_);
  }

 private:
  static void turn(double& place, double& speed, double low, double high) {
    if (place < low || place > high) speed = -speed;
    place = std::clamp(place, low, high);
  }
  void choose() {
    std::normal_distribution<double> direction;
    const double speed = fastest_ * std::pow(10.0, between(random_, -2.0, 0.0));
    const Vec3 way{direction(random_), direction(random_), 0.5 * direction(random_)};
    velocity_ = (speed / std::max(norm(way), 1e-12)) * way;
    left_ = between(random_, 5, 80);
  }

  std::mt19937_64 random_;
  double fastest_;
  double half_x_m_;
  double half_y_m_;
  double low_m_;
  double high_m_;
  Vec3 place_;
  Vec3 velocity_;
  int left_ = 1;
};

/// The surface's greatest height along the straight path between two points.
double top_between(const models::Relief& surface, Vec3 from, Vec3 to) {
  const Vec3 way = to - from;
  const int steps = 1 + static_cast<int>(4.0 * std::hypot(way.x, way.y) / surface.pixel_m());
  double top_m = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const Vec3 p = from + (static_cast<double>(k) / steps) * way;
    top_m = std::max(top_m, surface.sample(p.x, p.y).z_m);
  }
  return top_m;
}

/// Whether a path connects two points over ground nowhere higher than `ceiling_m`, within 3 mm of the
/// straight path: a breadth-first search on a grid of half pixels.
bool path_leads_around(const models::Relief& surface, Vec3 from, Vec3 to, double ceiling_m) {
  constexpr double kRound_m = 0.003;
  const double step_m = 0.5 * surface.pixel_m();
  const double left_m = std::min(from.x, to.x) - kRound_m;
  const double low_m = std::min(from.y, to.y) - kRound_m;
  const int width = 1 + static_cast<int>((std::abs(to.x - from.x) + 2.0 * kRound_m) / step_m);
  const int height = 1 + static_cast<int>((std::abs(to.y - from.y) + 2.0 * kRound_m) / step_m);
  const auto cell = [&](Vec3 p) {
    return static_cast<int>((p.y - low_m) / step_m + 0.5) * width +
           static_cast<int>((p.x - left_m) / step_m + 0.5);
  };
  const int goal = cell(to);
  std::vector<bool> known(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<int> reached{cell(from)};
  known[static_cast<std::size_t>(reached.front())] = true;
  for (std::size_t n = 0; n < reached.size(); ++n) {
    if (reached[n] == goal) return true;
    const int i = reached[n] % width;
    const int j = reached[n] / width;
    for (const auto& [x, y] : {std::pair(i - 1, j), {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
      if (x < 0 || x >= width || y < 0 || y >= height) continue;
      const int next = y * width + x;
      if (known[static_cast<std::size_t>(next)]) continue;
      known[static_cast<std::size_t>(next)] = true;
      if (next == goal || surface.sample(left_m + x * step_m, low_m + y * step_m).z_m <= ceiling_m)
        reached.push_back(next);
    }
  }
  return false;
}

/// Whether the first share `end` of the straight path from the proxy's last position to the hand is in free
/// air.
bool is_clear(const models::Relief& surface, Vec3 from, Vec3 hand, double end) {
  constexpr double kTolerance_m = 1e-6;
  const Vec3 way = end * (hand - from);
  const int steps = 1 + static_cast<int>(4.0 * std::hypot(way.x, way.y) / surface.pixel_m());
  for (int k = 0; k <= steps; ++k) {
    const Vec3 p = from + (static_cast<double>(k) / steps) * way;
    if (p.z < surface.sample(p.x, p.y).z_m - kTolerance_m) return false;
  }
  return true;
}

/// Whether a proxy jumped through an obstacle: between the two points the surface rises above both by more
/// than half of its height over the ground, no path leads around it, and the straight path to the hand was
/// blocked. (The proxy may go around a spike within a tick, but not around a wall.)
bool jumps_through(const models::Relief& surface, Vec3 from, Vec3 to, Vec3 hand) {
  if (std::hypot(to.x - from.x, to.y - from.y) <= surface.pixel_m()) return false;
  constexpr double kLeast_m = 0.0005;
  const double ends_m = std::max(from.z, to.z);
  const double foot_m = std::min({from.z, to.z, kGround_m});
  const double top_m = top_between(surface, from, to);
  const double ceiling_m = ends_m + std::max(kLeast_m, 0.5 * (top_m - foot_m));
  if (top_m <= ceiling_m || path_leads_around(surface, from, to, ceiling_m)) return false;
  const double whole_m = std::hypot(hand.x - from.x, hand.y - from.y);
  const double share = std::min(1.0, std::hypot(to.x - from.x, to.y - from.y) / std::max(whole_m, 1e-12));
  return !is_clear(surface, from, hand, share);
}

struct Moment {
  Vec3 hand_m;
  haptics::LawOutput output;
};

/// Whether the contact is a crest that the hand cut within the tick: it is in the air again, and the spring
/// is weaker than the distance to the place of the contact (docs/laws.md).
bool is_cut(const Moment& now, double stiffness_N_per_m) {
  const double whole_N = stiffness_N_per_m * norm(now.output.proxy.v - now.hand_m);
  return now.output.contact && norm(now.output.force_N) < 0.99 * whole_N;
}

/// Classifies one change of the force.
void classify_step(const Moment& before, const Moment& now, const TrajectoryStudyOptions& options,
                   LargeStep step, Vec3& written_N, TrajectoryFindings& findings) {
  step.hand_moved_m = norm(now.hand_m - before.hand_m);
  step.proxy_moved_m = norm(now.output.proxy.v - before.output.proxy.v);
  step.force_step_N = norm(now.output.force_N - before.output.force_N);
  const double k = 1.05 * options.stiffness_N_per_m;
  const bool beyond = step.force_step_N > k * step.hand_moved_m + kTolerance_N;
  const Vec3 last_N =
      std::exchange(written_N, haptics::cap_rise(now.output.force_N, Vector<SceneFrame>{written_N},
                                                 options.max_force_rate_N_per_s * kTick_s)
                                   .force_N.v);
  if (step.proxy_moved_m <= 2.0 * step.hand_moved_m) {
    findings.step_beyond_hand_motion += beyond ? 1 : 0;
    const bool beyond_both = step.force_step_N > k * (step.hand_moved_m + step.proxy_moved_m) + kTolerance_N;
    findings.step_beyond_both_motions += beyond_both && !is_cut(now, options.stiffness_N_per_m) ? 1 : 0;
    return;
  }
  if (!beyond) return;
  ++findings.large_steps;
  const double grown_N = norm(written_N) - norm(last_N);
  findings.large_and_unlimited += grown_N > options.max_force_rate_N_per_s * kTick_s + kTolerance_N ? 1 : 0;
  findings.largest.push_back(step);
}

void keep_largest(std::vector<LargeStep>& steps, int most) {
  std::sort(steps.begin(), steps.end(), [](const LargeStep& a, const LargeStep& b) {
    return std::tuple(-a.force_step_N, a.trajectory, a.tick) <
           std::tuple(-b.force_step_N, b.trajectory, b.tick);
  });
  if (steps.size() > static_cast<std::size_t>(most)) steps.resize(static_cast<std::size_t>(most));
}

void add(const TrajectoryFindings& part, int listed, TrajectoryFindings& sum) {
  sum.trajectories += part.trajectories;
  sum.ticks += part.ticks;
  sum.hand_below_surface += part.hand_below_surface;
  sum.let_through += part.let_through;
  sum.jumped_through += part.jumped_through;
  sum.proxy_below_surface += part.proxy_below_surface;
  sum.force_away_from_proxy += part.force_away_from_proxy;
  sum.not_finite += part.not_finite;
  sum.step_beyond_both_motions += part.step_beyond_both_motions;
  sum.step_beyond_hand_motion += part.step_beyond_hand_motion;
  sum.large_steps += part.large_steps;
  sum.large_and_unlimited += part.large_and_unlimited;
  sum.largest.insert(sum.largest.end(), part.largest.begin(), part.largest.end());
  // Not for every trajectory: sorting would take longer than simulating.
  if (sum.largest.size() > 4 * static_cast<std::size_t>(listed) + 1000) keep_largest(sum.largest, listed);
}

Result<void> check(const TrajectoryStudyOptions& o) {
  const auto usage = [](std::string message) { return Error{ErrorCode::usage, std::move(message), {}}; };
  if (o.trajectories < 1 || o.trajectories > 100'000'000)
    return usage("a study needs 1 to 100 million trajectories");
  if (o.reliefs < 1 || o.reliefs > 1000) return usage("a study needs 1 to 1000 reliefs");
  if (o.ticks < 2 || o.ticks > 100'000) return usage("a trajectory needs 2 to 100000 ticks");
  if (!(o.fastest_m_per_s > 0.0 && o.fastest_m_per_s <= 10.0))
    return usage("the fastest speed must be above 0 and at most 10 m/s");
  return {};
}

/// One ground with one law, which many trajectories share.
struct Variant {
  std::shared_ptr<const models::Relief> surface;
  std::shared_ptr<const haptics::Touchable> touchable;
};

Result<Variant> variant_of(int ground, const TrajectoryStudyOptions& options, std::uint64_t seed) {
  const auto number = static_cast<unsigned>(ground);
  auto relief = obstacle_relief(seed + number, (number & 1U) == 0 ? kSteepest : 0.0);
  if (!relief) return relief.error();
  haptics::LawParameters p;
  p.stiffness_N_per_m = options.stiffness_N_per_m;
  p.damping_Ns_per_m = 0.0;
  p.static_friction = (number & 2U) == 0 ? 0.0 : options.friction;
  p.radius_m = (number & 4U) == 0 ? 0.0 : options.radius_m;
  models::Scene scene;
  scene.model = *relief;
  haptics::DilatedRelief dilated;
  auto touchable = haptics::make_touchable(scene, p, &dilated);
  if (!touchable) return touchable.error();
  if (*p.radius_m > 0.0) return Variant{dilated.surface, *touchable};
  return Variant{*relief, *touchable};
}

}  // namespace

Result<std::shared_ptr<const models::Relief>> obstacle_relief(std::uint64_t seed, double steepest_slope) {
  std::mt19937_64 random(seed);
  Raster<float> z(kWidth, kHeight, static_cast<float>(kGround_m));
  const auto bar = [&z](int from, int wide, bool upright, double height_m) {
    for (int k = from; k < from + wide; ++k)
      for (int along = 0; along < (upright ? kHeight : kWidth); ++along)
        (upright ? z(k, along) : z(along, k)) = static_cast<float>(height_m);
  };
  // In pixels: a wall of 1 mm is 6.5 wide, a groove one to seven, a spike two. Walls come after grooves, or a
  // groove would leave slivers of a wall.
  for (int i = between(random, 10, 30); i < kWidth - 20; i += between(random, 30, 70))
    bar(i, between(random, 1, 7), true, between(random, 0.0, 0.001));
  for (int i = between(random, 10, 30); i < kWidth - 20; i += between(random, 25, 60))
    bar(i, between(random, 6, 7), true, between(random, 0.005, 0.010));
  for (int j = between(random, 40, 80); j < kHeight - 20; j += between(random, 80, 120))
    bar(j, between(random, 6, 7), false, between(random, 0.005, 0.010));
  for (int k = 0; k < 40; ++k) {
    const int i = between(random, 5, kWidth - 7);
    const int j = between(random, 5, kHeight - 7);
    z(i, j) = z(i + 1, j) = z(i, j + 1) = z(i + 1, j + 1) = static_cast<float>(between(random, 0.005, 0.010));
  }
  if (steepest_slope > 0.0) models::limit_slope(z, kPixel_m, steepest_slope);
  auto relief = models::Relief::from_samples(std::move(z), kPixel_m);
  if (!relief) return relief.error();
  return std::make_shared<const models::Relief>(std::move(*relief));
}

TrajectoryFindings follow_trajectory(const haptics::Touchable& touchable, const models::Relief& surface,
                                     std::uint64_t seed, const TrajectoryStudyOptions& options) {
  TrajectoryFindings findings;
  haptics::TouchState state;
  RandomHand hand(seed, surface, options.fastest_m_per_s);
  Moment before;
  Vec3 written_N;
  for (int k = 0; k < options.ticks; ++k) {
    if (k > 0) hand.move();
    haptics::Hand now;
    now.position = {hand.place()};
    now.velocity_m_per_s = {hand.velocity()};
    now.dt_s = kTick_s;
    const Moment tick{hand.place(), touchable.evaluate(now, state)};
    const Vec3 proxy = tick.output.proxy.v;
    const bool under = tick.hand_m.z < surface.sample(tick.hand_m.x, tick.hand_m.y).z_m;
    findings.hand_below_surface += under ? 1 : 0;
    findings.let_through += under && !(tick.output.contact && norm(tick.output.force_N) > 0.0) ? 1 : 0;
    findings.not_finite += is_finite(tick.output.force_N) && is_finite(tick.output.proxy) ? 0 : 1;
    findings.proxy_below_surface += proxy.z - surface.sample(proxy.x, proxy.y).z_m < -1e-9 ? 1 : 0;
    findings.force_away_from_proxy += dot(proxy - tick.hand_m, tick.output.force_N.v) < -1e-9 ? 1 : 0;
    if (k > 0) {
      findings.jumped_through += jumps_through(surface, before.output.proxy.v, proxy, tick.hand_m) ? 1 : 0;
      classify_step(before, tick, options, {0, k, tick.hand_m, 0.0, 0.0, 0.0}, written_N, findings);
    }
    before = tick;
  }
  findings.trajectories = 1;
  findings.ticks = options.ticks;
  return findings;
}

Result<TrajectoryFindings> study_trajectories(const TrajectoryStudyOptions& options, const Work& work) {
  if (const auto valid = check(options); !valid) return valid.error();
  TrajectoryFindings sum;
  const int reliefs = static_cast<int>(std::min<std::int64_t>(options.reliefs, options.trajectories));
  for (int relief = 0; relief < reliefs; ++relief) {
    work.report(static_cast<double>(relief) / reliefs, "following trajectories");
    const auto variant = variant_of(relief, options, work.seed);
    if (!variant) return variant.error();
    const std::int64_t first = options.trajectories * relief / reliefs;
    const std::int64_t end = options.trajectories * (relief + 1) / reliefs;
    std::mutex mutex;
    parallel_for(work, static_cast<int>(end - first), 64, [&](int from, int to) {
      TrajectoryFindings part;
      for (int k = from; k < to && !work.cancelled(); ++k) {
        const std::int64_t number = first + k;
        TrajectoryFindings one = follow_trajectory(
            *variant->touchable, *variant->surface,
            work.seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(number), options);
        for (LargeStep& step : one.largest) step.trajectory = number;
        add(one, options.listed, part);
      }
      const std::lock_guard lock(mutex);
      add(part, options.listed, sum);
    });
    if (work.cancelled()) return Work::interrupted();
  }
  keep_largest(sum.largest, options.listed);
  return sum;
}

}  // namespace palpable::study
