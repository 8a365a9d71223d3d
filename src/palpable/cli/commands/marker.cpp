// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/draw/view/marker_sheet.hpp"
#include "palpable/vision/motion/tracks/printed_marker.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct MarkerArguments {
  std::string output;
  int side_mm = 60;
};

std::string marker_sides() {
  std::string out;
  for (const int side : vision::kMarkerSides_mm) out += fmt::format("{}{}", out.empty() ? "" : ", ", side);
  return out;
}

Result<Answer> write_marker(const MarkerArguments& arguments) {
  const auto& sides = vision::kMarkerSides_mm;
  if (std::find(sides.begin(), sides.end(), arguments.side_mm) == sides.end())
    return Error{
        ErrorCode::usage,
        fmt::format("there is no marker of {} mm; its side is one of {}", arguments.side_mm, marker_sides()),
        "--side"};
  const auto written = draw::write_figure(
      draw::marker_sheet(vision::marker_cells(arguments.side_mm), arguments.side_mm), arguments.output);
  if (!written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output}, {"side_mm", arguments.side_mm}, {"code", arguments.side_mm}};
  answer.text = fmt::format("{}: a marker of {} mm; print it at 100 % and lay it beside the model\n",
                            arguments.output, arguments.side_mm);
  return answer;
}

}  // namespace

void add_marker(Program& program) {
  const auto arguments = std::make_shared<MarkerArguments>();
  Options options =
      add_command(program, "marker", "Write a sheet with a printed marker, which gives a video its scale",
                  "  palpable marker -o sheet.pdf\n"
                  "  palpable marker -o sheet.svg --side 100",
                  [arguments](Console&) { return write_marker(*arguments); });
  options.required_output("-o,--output", arguments->output, {".pdf", ".svg", ".png"}, "Sheet to write, A4");
  options.integer("--side", arguments->side_mm, {30, 150}, "Side of the black square, mm: " + marker_sides());
}

}  // namespace palpable::cli
