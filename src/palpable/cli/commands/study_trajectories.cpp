// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/study/simulated/trajectory_study.hpp"

#include <chrono>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct StudyTrajectoriesArguments {
  double trajectories = 1e6;
  int ticks = 100;
  double fastest_m_per_s = 1.0;
  std::string list;
};

Result<void> write_list(const std::vector<study::LargeStep>& steps, const std::string& file) {
  std::string text = "trajectory,tick,x_m,y_m,z_m,hand_moved_m,proxy_moved_m,force_step_N\n";
  for (const auto& s : steps)
    text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g}\n", s.trajectory, s.tick, s.hand_m.x,
                        s.hand_m.y, s.hand_m.z, s.hand_moved_m, s.proxy_moved_m, s.force_step_N);
  return write_file_atomically(file, std::as_bytes(std::span(text)));
}

Answer answer_of(const study::TrajectoryFindings& found, double seconds) {
  Answer answer;
  answer.json = {{"trajectories", found.trajectories},
                 {"ticks", found.ticks},
                 {"under", found.hand_below_surface},
                 {"let_through", found.let_through},
                 {"jumped_through", found.jumped_through},
                 {"sunk", found.proxy_below_surface},
                 {"pulled", found.force_away_from_proxy},
                 {"not_finite", found.not_finite},
                 {"kicked", found.step_beyond_both_motions},
                 {"beyond_the_hand", found.step_beyond_hand_motion},
                 {"large_steps", found.large_steps},
                 {"large_and_unlimited", found.large_and_unlimited},
                 {"largest_step_N", found.largest.empty() ? 0.0 : found.largest.front().force_step_N},
                 {"seconds", seconds}};
  const auto line = [&answer](const char* what, std::int64_t count) {
    answer.text += fmt::format("{:58}{:>12}\n", what, count);
  };
  answer.text = fmt::format("{} trajectories, {} ticks, {} of them under the surface\n", found.trajectories,
                            found.ticks, found.hand_below_surface);
  line("under the surface without a force", found.let_through);
  line("proxy jumped through an obstacle", found.jumped_through);
  line("proxy under the surface", found.proxy_below_surface);
  line("force away from the proxy", found.force_away_from_proxy);
  line("not a number", found.not_finite);
  line("force step larger than the motion of hand and proxy explains", found.step_beyond_both_motions);
  line("force step larger than the motion of the hand explains", found.step_beyond_hand_motion);
  line("large steps of the proxy, rate-limited", found.large_steps);
  line("large steps of the proxy, not rate-limited", found.large_and_unlimited);
  return answer;
}

Result<Answer> study(const StudyTrajectoriesArguments& arguments, const Work& work) {
  study::TrajectoryStudyOptions options;
  options.trajectories = static_cast<std::int64_t>(arguments.trajectories);
  options.ticks = arguments.ticks;
  options.fastest_m_per_s = arguments.fastest_m_per_s;
  const auto begin = std::chrono::steady_clock::now();
  const auto found = study::study_trajectories(options, work);
  if (!found) return found.error();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (!arguments.list.empty())
    if (const auto written = write_list(found->largest, arguments.list); !written) return written.error();
  return answer_of(*found, seconds.count());
}

}  // namespace

void add_study_trajectories(Program& program) {
  const auto arguments = std::make_shared<StudyTrajectoriesArguments>();
  Options options = add_command(
      program, "study-trajectories",
      "Random strokes over walls, grooves and spikes: how often does a hand pass through the surface?",
      "  palpable study-trajectories\n"
      "  palpable study-trajectories --trajectories 10000 --list steps.csv",
      [arguments](Console& console) { return study(*arguments, console.work()); });
  options.number("--trajectories", arguments->trajectories, {1.0, 1e8}, "Number of strokes");
  options.integer("--ticks", arguments->ticks, {2, 100000}, "Length of each stroke in ticks of 1 ms");
  options.number("--fastest", arguments->fastest_m_per_s, {0.001, 10.0}, "Greatest speed of the hand, m/s");
  options.output("--list", arguments->list, {}, "CSV to write with the thousand greatest steps of the force");
}

}  // namespace palpable::cli
