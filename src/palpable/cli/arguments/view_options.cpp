// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/view_options.hpp"

#include "palpable/cli/arguments/path_file.hpp"

#include <array>
#include <numbers>

namespace palpable::cli {

void add_view_options(Options& options, ViewArguments& arguments) {
  options.choice("--view", arguments.view, {"exocentric", "egocentric"},
                 "Frame of reference: the scene's, or that of an explorer who walks and turns in the scene");
  options.text("--walk", arguments.walk,
               "Places of the explorer over time: CSV t_s,x_m,y_m,heading_deg (left positive)");
}

Result<std::vector<session::WalkStep>> walk_from(const ViewArguments& arguments) {
  std::vector<session::WalkStep> walk;
  if (arguments.view != "egocentric") {
    if (!arguments.walk.empty())
      return Error{ErrorCode::usage, "an explorer walks only in the egocentric view: add --view egocentric",
                   "--walk"};
    return walk;
  }
  if (arguments.walk.empty()) {
    walk.emplace_back();
    return walk;
  }
  constexpr std::array<std::string_view, 4> kColumns{"t_s", "x_m", "y_m", "heading_deg"};
  const auto table = read_number_table(arguments.walk, kColumns);
  if (!table) return table.error();
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto row = table->row(i);
    walk.push_back({row[0], {row[1], row[2], row[3] * std::numbers::pi / 180.0}});
  }
  if (const auto valid = session::check_walk(walk); !valid)
    return invalid_input(valid.error().message, arguments.walk);
  return walk;
}

}  // namespace palpable::cli
