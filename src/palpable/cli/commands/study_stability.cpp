// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/draw/view/traces_view.hpp"
#include "palpable/study/simulated/groove_study.hpp"

#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct StudyStabilityArguments {
  std::string output;
  double rate_hz = 1000.0;
  int delay = 1;
  double resolution_um = 10.0;
};

/// A light hand with a normal grip on a device almost without friction, so that any vibration becomes
/// visible.
study::GrooveStudyOptions options_of(const StudyStabilityArguments& arguments) {
  study::GrooveStudyOptions options;
  options.rate_hz = arguments.rate_hz;
  options.hand.device_mass_kg = 0.05;
  options.hand.arm_mass_kg = 0.1;
  options.hand.arm_damping_Ns_per_m = 3.0;
  options.hand.arm_stiffness_N_per_m = 300.0;
  options.hand.max_force_N = 10.0;
  options.hand.delay_samples = arguments.delay;
  options.hand.resolution_m = 1e-6 * arguments.resolution_um;
  return options;
}

/// The hand's position across the groove in the last 0.2 s; one row per law, one column per stiffness.
draw::Figure figure_of(const std::vector<study::GrooveResult>& results, int columns,
                       const StudyStabilityArguments& arguments) {
  std::vector<draw::Trace> traces;
  for (const auto& result : results) {
    traces.push_back(
        {fmt::format("{}, {:g} N/m: {:.0f} µm", result.law, result.stiffness_N_per_m, 1e6 * result.across_m),
         result.end_m, 1.0 / arguments.rate_hz});
    for (double& place : traces.back().values) place *= 1000.0;
  }
  const std::string delay =
      arguments.delay == 1 ? std::string("1 tick") : fmt::format("{} ticks", arguments.delay);
  return draw::traces_figure(
      std::move(traces), columns, "across, mm",
      {"A hand at rest in a V-shaped groove",
       fmt::format(
           "Walls of 45 degrees, a simulated hand of 0.15 kg pressed against the bottom, {:g} Hz, {} of "
           "delay, "
           "sensor steps of {:g} µm, no friction on the surface. Where it oscillates, the law vibrates.",
           arguments.rate_hz, delay, arguments.resolution_um)});
}

Result<Answer> study(const StudyStabilityArguments& arguments) {
  const auto options = options_of(arguments);
  const auto results = study::study_groove(options);
  if (!results) return results.error();
  Answer answer;
  answer.json["results"] = Json::array();
  answer.text = fmt::format("{:10}{:>12}{:>12}{:>12}{:>12}{:>14}\n", "law", "N/m", "across µm", "height µm",
                            "reversals/s", "step of force");
  for (const auto& r : *results) {
    answer.json["results"].push_back({{"law", r.law},
                                      {"stiffness_N_per_m", r.stiffness_N_per_m},
                                      {"across_m", r.across_m},
                                      {"height_m", r.height_m},
                                      {"turns_per_s", r.turns_per_s},
                                      {"force_step_N", r.force_step_N}});
    answer.text +=
        fmt::format("{:10}{:>12g}{:>12.1f}{:>12.1f}{:>12.0f}{:>12.3f} N\n", r.law, r.stiffness_N_per_m,
                    1e6 * r.across_m, 1e6 * r.height_m, r.turns_per_s, r.force_step_N);
  }
  if (arguments.output.empty()) return answer;
  const auto figure = figure_of(*results, static_cast<int>(options.stiffnesses_N_per_m.size()), arguments);
  if (const auto written = draw::write_figure(figure, arguments.output); !written) return written.error();
  answer.json["output"] = arguments.output;
  return answer;
}

}  // namespace

void add_study_stability(Program& program) {
  const auto arguments = std::make_shared<StudyStabilityArguments>();
  Options options =
      add_command(program, "study-stability", "Which laws vibrate in a groove: a simulated hand rests in one",
                  "  palpable study-stability\n"
                  "  palpable study-stability --delay 2 -o groove.png",
                  [arguments](Console&) { return study(*arguments); });
  options.output("-o,--output", arguments->output, {".png", ".svg", ".pdf"},
                 "Picture to write (.png, .svg, .pdf)");
  options.number("--rate", arguments->rate_hz, {100.0, 4000.0}, "Servo rate in Hz");
  options.integer("--delay", arguments->delay, {0, 8}, "Delay from a reading to its force, ticks");
  options.number("--resolution-um", arguments->resolution_um, {0.0, 1000.0}, "The sensor's step");
}

}  // namespace palpable::cli
