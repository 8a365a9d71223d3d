// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/tracing_study.hpp"

#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/vision/contours/contours.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace palpable::study {
namespace {

constexpr double kLongest_s = 240.0;
constexpr double kRest_s = 5.0;
/// A hand is at rest if it has been slower than kResting_m_per_s for kSettle_s: a turning point is no rest,
/// and the law's estimate of the speed needs some time.
constexpr double kSettle_s = 0.3;
constexpr double kResting_m_per_s = 0.0005;
constexpr int kTicksAPlace = 20;

/// The paper's device: a pen in a plane, 3600 dots per inch, 5 N, almost no friction.
device::HandOptions paper_hand(double rate_hz) {
  device::HandOptions hand;
  hand.degrees_of_freedom = 2;
  hand.device_friction_N = 0.0;
  hand.resolution_m = 0.0254 / 3600.0;
  hand.max_force_N = 5.0;
  hand.delay_samples = 1;
  hand.rate_hz = rate_hz;
  hand.script.kind = device::HandScriptOptions::Kind::hold;
  return hand;
}

/// One simulated hand with the law, or with none.
class SimulatedTrace {
 public:
  SimulatedTrace(const TracedFigure& figure, const TracingStudyOptions& options, Assistance assistance,
                 Vec3 begin_m)
      : law_(figure.boundaries, options.law),
        hand_(paper_hand(options.rate_hz)),
        dt_s_(1.0 / options.rate_hz),
        assists_(assistance == Assistance::tracing) {
    hand_.place(begin_m);
    last_m_ = begin_m;
  }

  /// One tick towards the aim; returns the hand's position.
  Vec3 step(Vec3 aim_m, TraceOutcome& outcome) {
    haptics::Hand felt;
    felt.position.v = hand_.read().position.v;
    felt.velocity_m_per_s.v = (1.0 / dt_s_) * (felt.position.v - last_m_);
    felt.dt_s = dt_s_;
    last_m_ = felt.position.v;
    force_N_ = {};
    if (assists_) {
      force_N_ = law_.evaluate(felt, state_).force_N.v;
      outcome.tank_least_J = std::min(outcome.tank_least_J, haptics::TracingLaw::kTank_J - state_.spent_J);
      if (state_.last_fx_N != 0.0 || state_.last_fy_N != 0.0)
        outcome.fastest_pushed_m_per_s = std::max(outcome.fastest_pushed_m_per_s, speed());
    }
    hand_.set_goal(aim_m);
    hand_.write({force_N_});
    return hand_.true_position_m();
  }
  double speed() const { return norm(hand_.true_velocity_m_per_s()); }
  /// The law's force along the boundary, without its damping.
  double push_N() const { return std::hypot(state_.last_fx_N, state_.last_fy_N); }

 private:
  haptics::TracingLaw law_;
  haptics::TracingLaw::State state_{};
  device::SimulatedHand hand_;
  double dt_s_;
  bool assists_;
  Vec3 last_m_;
  Vec3 force_N_;
};

Spread spread_of(const std::vector<TraceOutcome>& all, double (*value)(const TraceOutcome&)) {
  Spread s;
  int finished = 0;
  for (const auto& one : all)
    if (one.finished) s.mean += value(one), ++finished;
  if (finished == 0) return s;
  s.mean /= finished;
  for (const auto& one : all)
    if (one.finished) s.deviation += (value(one) - s.mean) * (value(one) - s.mean);
  s.deviation = finished > 1 ? std::sqrt(s.deviation / (finished - 1)) : 0.0;
  return s;
}

}  // namespace

Result<TracedFigure> prepare_figure(TracingFigure figure, double neighbourhood_px, const Work& work) {
  vision::ContourOptions method;
  method.method = vision::ContourMethod::best;
  const auto contours = vision::find_contours(image_of(figure), method, work);
  if (!contours) return contours.error();
  sculpt::BoundaryMapOptions options;
  options.width_m = figure.picture.width() * figure.pixel_m;
  options.height_m = figure.picture.height() * figure.pixel_m;
  options.radius_px = neighbourhood_px;
  auto map = sculpt::boundary_map_from_contours(*contours, options, work);
  if (!map) return map.error();
  return TracedFigure{std::move(figure), std::make_shared<const models::BoundaryMap>(std::move(*map))};
}

TraceOutcome trace_once(const TracedFigure& figure, const TracingStudyOptions& options, Assistance assistance,
                        Direction direction, std::uint64_t seed) {
  auto nominal = figure.figure.nominal;
  // A closed line starts at the same point in both directions.
  const bool open = figure.figure.ends == LineByLength::Ends::open;
  if (direction == Direction::backwards) std::reverse(nominal.begin() + (open ? 0 : 1), nominal.end());
  const auto line = std::make_shared<const LineByLength>(nominal, figure.figure.ends);
  SimulatedTracer tracer(line, options.tracer, seed);
  TraceOutcome outcome;
  SimulatedTrace simulation(figure, options, assistance, line->point(0.0));
  const double dt_s = 1.0 / options.rate_hz;
  Vec3 hand_m = line->point(0.0);
  const int most = static_cast<int>(kLongest_s * options.rate_hz);
  int tick = 0;
  for (; tick < most && !tracer.finished(); ++tick) {
    if (tick % kTicksAPlace == 0) outcome.trace.push_back(hand_m);
    hand_m = simulation.step(tracer.step(hand_m, dt_s), outcome);
  }
  outcome.finished = tracer.finished();
  outcome.seconds = tick * dt_s;
  const int rest = static_cast<int>(kRest_s * options.rate_hz);
  double rested_s = 0.0;
  for (int k = 0; k < rest; ++k) {
    simulation.step(tracer.aim(), outcome);
    rested_s = simulation.speed() < kResting_m_per_s ? rested_s + dt_s : 0.0;
    if (rested_s > kSettle_s) outcome.resting_N = std::max(outcome.resting_N, simulation.push_N());
  }
  outcome.rested = rested_s > kSettle_s;
  outcome.error = area_error(outcome.trace, figure.figure.nominal);
  outcome.roughness_deg_per_mm = roughness_deg_per_mm(outcome.trace);
  return outcome;
}

Result<TracingSummary> study_tracing(const TracedFigure& figure, const TracingStudyOptions& options,
                                     Assistance assistance, const Work& work) {
  const int each = 2 * options.repeats;
  std::vector<TraceOutcome> all(static_cast<std::size_t>(options.tracers * each));
  parallel_for(work, options.tracers, 1, [&](int from, int to) {
    for (int who = from; who < to && !work.cancelled(); ++who) {
      std::mt19937_64 random(work.seed * 1000003U + static_cast<std::uint64_t>(who));
      std::normal_distribution<double> normal;
      TracingStudyOptions own = options;
      own.tracer.speed_m_per_s *= std::exp(options.spread * normal(random));
      own.tracer.motor_noise *= std::exp(options.spread * normal(random));
      for (int k = 0; k < each; ++k) {
        TraceOutcome& one = all[static_cast<std::size_t>(who * each + k)];
        one = trace_once(figure, own, assistance, k % 2 == 0 ? Direction::as_drawn : Direction::backwards,
                         random());
        one.trace.clear();
      }
    }
  });
  if (work.cancelled()) return Work::interrupted();
  TracingSummary s;
  s.traces = static_cast<int>(all.size());
  s.unfinished = static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const TraceOutcome& one) { return !one.finished; }));
  s.restless = static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const TraceOutcome& one) { return !one.rested; }));
  s.seconds = spread_of(all, [](const TraceOutcome& one) { return one.seconds; });
  s.error = spread_of(all, [](const TraceOutcome& one) { return one.error; });
  s.roughness_deg_per_mm = spread_of(all, [](const TraceOutcome& one) { return one.roughness_deg_per_mm; });
  for (const auto& one : all) {
    s.fastest_pushed_m_per_s = std::max(s.fastest_pushed_m_per_s, one.fastest_pushed_m_per_s);
    s.tank_least_J = std::min(s.tank_least_J, one.tank_least_J);
    s.resting_N = std::max(s.resting_N, one.resting_N);
  }
  return s;
}

}  // namespace palpable::study
