// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The map that a depth camera makes on a drive round furnished rooms, beside their truth, a line for each:
// palpable_room_set [exact | odometry | none] [FIRST LAST]; the motion that is stated to it, and the rooms'
// seeds.
#include "palpable/core/text/number_text.hpp"
#include "palpable/study/world/map_study.hpp"

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

std::optional<study::StatedMotion> motion_of(std::string_view word) {
  if (word == "exact") return study::StatedMotion::exact;
  if (word == "odometry") return study::StatedMotion::odometry;
  if (word == "none") return study::StatedMotion::none;
  return std::nullopt;
}

void print(std::uint64_t seed, const study::MapScore& score) {
  fmt::print(
      "{:4} {:4} frames {:5.1f} m | map within 2, 4 cm {:5.1f} {:5.1f} % | seen {:5.1f} {:5.1f} % | depth "
      "{:4.2f} % "
      "| camera {:4.1f} cm off, odometry {:5.1f} | {:4.1f} MiB | {:4.1f} + {:4.1f} ms a frame\n",
      seed, score.frames, score.driven_m, 100 * score.right_2cm, 100 * score.right_4cm, 100 * score.kept_2cm,
      100 * score.kept_4cm, score.depth_rms_percent, 100 * score.worst_place_m, 100 * score.worst_odometry_m,
      score.map_mib, score.locate_ms, score.add_ms);
  std::fflush(stdout);
}

int run(int count, const char* const* words) {
  study::MapStudyOptions options;
  const auto motion = motion_of(count > 1 ? words[1] : "odometry");
  const auto first = whole_number(count > 2 ? words[2] : "201"),
             last = whole_number(count > 3 ? words[3] : "210");
  if (!motion || !first || !last || *first < 0 || *last < *first) {
    fmt::print(stderr, "palpable_room_set [exact | odometry | none] [FIRST LAST]\n");
    return 2;
  }
  options.motion = *motion;
  for (auto seed = static_cast<std::uint64_t>(*first); seed <= static_cast<std::uint64_t>(*last); ++seed) {
    if (const auto drive = study::run_map_study(seed, options))
      print(seed, drive->score);
    else
      fmt::print("{:4} has no way round\n", seed);
  }
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
