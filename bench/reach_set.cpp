// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A simulated person drives a robot to a piece of furniture in furnished rooms and touches it, in simulated
// time, a line for each: palpable_reach_set [FIRST LAST]; the rooms' seeds.
#include "palpable/core/text/number_text.hpp"
#include "palpable/study/world/test_person.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

int run(int count, const char* const* words) {
  const auto first = whole_number(count > 1 ? words[1] : "1"),
             last = whole_number(count > 2 ? words[2] : "20");
  if (!first || !last || *first < 0 || *last < *first) {
    fmt::print(stderr, "palpable_reach_set [FIRST LAST]\n");
    return 2;
  }
  int touched = 0, met = 0;
  for (auto seed = static_cast<std::uint64_t>(*first); seed <= static_cast<std::uint64_t>(*last); ++seed) {
    const study::Visit visit = study::visit_in_room(seed);
    touched += visit.has_touched ? 1 : 0;
    met += visit.robot_touched ? 1 : 0;
    fmt::print(
        "{:4} {:12} {} {} | {:5.1f} s, {:4.1f} m, {} detours | believed {:4.1f} cm off | hand {:4.1f} cm "
        "from it\n",
        seed, visit.object,
        visit.has_touched   ? "touched"
        : visit.has_arrived ? "missed "
                            : "never there",
        visit.robot_touched ? "| the robot touched something" : "", visit.time_s, visit.way_m, visit.detours,
        100.0 * visit.lost_m, 100.0 * std::max(visit.away_m, 0.0));
    std::fflush(stdout);
  }
  fmt::print("touched in {} of {} rooms; the robot touched something in {}\n", touched, *last - *first + 1,
             met);
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
