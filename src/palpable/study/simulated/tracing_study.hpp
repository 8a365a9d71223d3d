// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/haptics/law/tracing.hpp"
#include "palpable/study/simulated/simulated_tracer.hpp"
#include "palpable/study/simulated/tracing_figure.hpp"

#include <memory>
#include <string>
#include <vector>

namespace palpable::study {

/// A simulation of the paper's study (graphic-haptic display 2006, section 4): simulated tracers follow a
/// figure's outline with and without the law `tracing`, in both directions, three times each.
struct TracingStudyOptions {
  int tracers = 20;
  int repeats = 3;
  TracerParameters tracer;
  /// Relative standard deviation of speed and noise between tracers.
  double spread = 0.07;
  /// m of eq. 7, px; the law holds F_m.
  double neighbourhood_px = 6.0;
  haptics::TracingParameters law;
  double rate_hz = 1000.0;
};

/// One trace.
struct TraceOutcome {
  double seconds = 0.0;
  /// S'/S; NaN for open lines.
  double error = 0.0;
  double roughness_deg_per_mm = 0.0;
  /// The hand's greatest speed while the law pushed it, the tank's least energy, and the greatest force at
  /// rest after the trace's end; `rested`: whether it came to rest. At rest means below 0.5 mm/s for 0.3 s.
  double fastest_pushed_m_per_s = 0.0;
  double tank_least_J = haptics::TracingLaw::kTank_J;
  double resting_N = 0.0;
  bool rested = false;
  /// The trace reached its end within four minutes.
  bool finished = false;
  /// The hand's positions, one per 20 ms.
  std::vector<Vec3> trace;
};

/// Mean and standard deviation over all traces.
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

struct TracingSummary {
  int traces = 0;
  int unfinished = 0;
  /// How many hands did not come to rest after the trace.
  int restless = 0;
  Spread seconds;
  Spread error;
  Spread roughness_deg_per_mm;
  double fastest_pushed_m_per_s = 0.0;
  double tank_least_J = haptics::TracingLaw::kTank_J;
  double resting_N = 0.0;
};

/// A figure with the boundaries that the program finds in its picture.
struct TracedFigure {
  TracingFigure figure;
  std::shared_ptr<const models::BoundaryMap> boundaries;
};
Result<TracedFigure> prepare_figure(TracingFigure figure, double neighbourhood_px, const Work& work);

enum class Assistance { none, tracing };
enum class Direction { as_drawn, backwards };

/// One trace by one tracer, simulated time. Deterministic.
TraceOutcome trace_once(const TracedFigure& figure, const TracingStudyOptions& options, Assistance assistance,
                        Direction direction, std::uint64_t seed);

/// All traces of one figure in one condition. Both conditions have the same tracers with the same noise.
/// Errors: interrupted.
Result<TracingSummary> study_tracing(const TracedFigure& figure, const TracingStudyOptions& options,
                                     Assistance assistance, const Work& work);

}  // namespace palpable::study
