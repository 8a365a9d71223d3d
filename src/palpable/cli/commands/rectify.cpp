// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/number_list.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/hints.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/vision/rectification/plane_rectification.hpp"

#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct RectifyArguments {
  std::string picture, output;
  std::string corners, aspect, lines, orthogonal;
};

vision::PictureLine line_at(const std::vector<double>& numbers, std::size_t i) {
  return {{numbers[4 * i], numbers[4 * i + 1]}, {numbers[4 * i + 2], numbers[4 * i + 3]}};
}

Result<vision::RectifiedPlane> rectified_by_lines(const RectifyArguments& arguments, const Image& picture) {
  const auto given = numbers_of(arguments.lines, 16, "--lines", "x1,y1,x2,y2 for each of four lines");
  if (!given) return given.error();
  vision::PlaneLines lines{
      {line_at(*given, 0), line_at(*given, 1)}, {line_at(*given, 2), line_at(*given, 3)}, {}};
  if (!arguments.orthogonal.empty()) {
    const auto pairs =
        numbers_of(arguments.orthogonal, 16, "--orthogonal", "x1,y1,x2,y2 for each of four lines");
    if (!pairs) return pairs.error();
    lines.orthogonal = {{line_at(*pairs, 0), line_at(*pairs, 1)}, {line_at(*pairs, 2), line_at(*pairs, 3)}};
  }
  return vision::rectify_plane(picture, lines);
}

// By what the picture shows; as it is where that does not tell how it is tilted.
Result<vision::RectifiedPlane> rectified_by_tilt(const Image& picture, const Work& work) {
  const auto tilt = vision::find_plane_tilt(picture, work);
  if (!tilt) return tilt.error();
  if (*tilt) return vision::rectify_tilt(picture, **tilt);
  return vision::RectifiedPlane{picture,
                                vision::kIdentity3,
                                {{"The picture is unchanged: it looks straight, or shows too few right "
                                  "angles to tell how it is tilted; "
                                  "if it is tilted, mark something rectangular on it.",
                                  Reason::needs_plane_marks}}};
}

Result<vision::RectifiedPlane> rectified_by_corners(const RectifyArguments& arguments, const Image& picture) {
  const auto corners =
      numbers_of(arguments.corners, 8, "--corners", "x,y of each corner, from the upper left clockwise");
  if (!corners) return corners.error();
  vision::PlaneRectangle rectangle;
  for (std::size_t i = 0; i < 4; ++i) rectangle.corners[i] = {(*corners)[2 * i], (*corners)[2 * i + 1]};
  if (!arguments.aspect.empty()) {
    const auto sides = numbers_of(arguments.aspect, 2, "--aspect", "WIDTH:HEIGHT");
    if (!sides) return sides.error();
    if (!((*sides)[0] > 0.0 && (*sides)[1] > 0.0))
      return Error{ErrorCode::usage, "width and height must be positive", "--aspect"};
    rectangle.aspect = (*sides)[0] / (*sides)[1];
  }
  return vision::rectify_rectangle(picture, rectangle);
}

Result<Answer> rectify(const RectifyArguments& arguments, Console& console) {
  if (std::filesystem::path(arguments.output).extension() != ".png")
    return Error{ErrorCode::usage, "the rectified picture is written as .png", arguments.output};
  if (!arguments.corners.empty() && !(arguments.lines.empty() && arguments.orthogonal.empty()))
    return Error{ErrorCode::usage, "give the corners or the lines, not both", "--corners"};
  if (arguments.lines.empty() && !arguments.orthogonal.empty())
    return Error{ErrorCode::usage, "is stated together with --lines", "--orthogonal"};
  const auto picture = sources::read_picture(arguments.picture);
  if (!picture) return picture.error();
  auto plane = [&]() -> Result<vision::RectifiedPlane> {
    if (!arguments.corners.empty()) return rectified_by_corners(arguments, *picture);
    if (!arguments.lines.empty()) return rectified_by_lines(arguments, *picture);
    return rectified_by_tilt(*picture, console.work());
  }();
  if (!plane) {
    if (plane.error().place.empty()) plane.error().place = arguments.picture;
    return plane.error();
  }
  for (const Note& note : plane->notes) console.note(note);
  if (const auto written = formats::write_png(arguments.output, plane->picture); !written)
    return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output},
                 {"width", plane->picture.width},
                 {"height", plane->picture.height},
                 {"output_from_input", plane->picture_from_input},
                 {"notes", sentences_of(plane->notes)}};
  answer.text =
      fmt::format("{}: {} x {} pixels\n", arguments.output, plane->picture.width, plane->picture.height);
  return answer;
}

}  // namespace

void add_rectify(Program& program) {
  const auto arguments = std::make_shared<RectifyArguments>();
  Options options = add_command(
      program, "rectify", "Rectify a photographed map or painting, as seen from directly above",
      "  palpable rectify photo.jpg -o map.png\n"
      "  palpable rectify photo.jpg -o map.png --corners '120,80 900,60 980,700 60,720' --aspect 4:3\n"
      "  palpable rectify photo.jpg -o map.png --lines '0,10,600,30 0,400,600,380 10,0,60,400 500,0,480,400'",
      [arguments](Console& console) { return rectify(*arguments, console); });
  options.argument("PICTURE", arguments->picture, "A picture of something flat");
  options.required_output("-o,--output", arguments->output, {".png"}, "Picture to write (.png)");
  options.text("--corners", arguments->corners,
               "Corners of a rectangle on it: four x,y in pixels, from the upper left clockwise");
  options.text("--aspect", arguments->aspect, "That rectangle's WIDTH:HEIGHT; default: from the perspective");
  options.text(
      "--lines", arguments->lines,
      "Four lines x1,y1,x2,y2: two that are parallel on it, and two across; default: by its right angles");
  options.text("--orthogonal", arguments->orthogonal,
               "Four lines: two pairs at right angles, for the proportions; default: from the perspective");
}

}  // namespace palpable::cli
