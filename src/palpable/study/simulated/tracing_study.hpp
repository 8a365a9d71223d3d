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
/// figure's outline with and without the law `tracing`, both ways round, three times each.
struct TracingStudyOptions {
  int tracers = 20;
  int repeats = 3;
  TracerParameters tracer;
  /// Standard deviation of speed and noise from one tracer to the next, as a share.
  double spread = 0.07;
  /// m of eq. 7, px; and F_m.
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
  /// The fastest that a hand went while the law pushed it, the least that the tank held, and the greatest
  /// force after the trace's end, at rest: below 0.5 mm/s for 0.3 s. Whether it came to rest within two
  /// seconds.
  double fastest_pushed_m_per_s = 0.0;
  double tank_least_J = haptics::TracingLaw::kTank_J;
  double resting_N = 0.0;
  bool rested = false;
  /// It came to its end within four minutes.
  bool finished = false;
  /// The hand's places, one each 20 ms.
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
  /// How many of the hands did not come to rest after the trace.
  int restless = 0;
  Spread seconds;
  Spread error;
  Spread roughness_deg_per_mm;
  double fastest_pushed_m_per_s = 0.0;
  double tank_least_J = haptics::TracingLaw::kTank_J;
  double resting_N = 0.0;
};

/// A figure ready to be traced: its boundaries as the program finds them.
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

/// All traces of one figure in one condition. The same tracers, with the same noise, trace in both
/// conditions. Errors: interrupted.
Result<TracingSummary> study_tracing(const TracedFigure& figure, const TracingStudyOptions& options,
                                     Assistance assistance, const Work& work);

}  // namespace palpable::study
