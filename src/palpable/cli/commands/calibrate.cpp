// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/input/input.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/vision/rectification/chessboard_calibration.hpp"

#include <algorithm>
#include <filesystem>
#include <span>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  std::string folder, output;
  std::string board = "9x6";
  double square_mm = 25.0;
};

/// The pictures of a folder; those of two cameras are paired by their names.
struct Boards {
  std::vector<vision::StereoPair> pairs;
  /// Pictures of one camera, if no name says left or right.
  std::vector<Image> pictures;
};

Result<vision::ChessboardOptions> board_of(const CalibrateArguments& arguments) {
  vision::ChessboardOptions options;
  options.square_m = arguments.square_mm / 1000.0;
  const std::string_view board = arguments.board;
  const std::size_t cross = std::min(board.find('x'), board.size());
  const auto columns = whole_number(board.substr(0, cross));
  const auto rows = whole_number(board.substr(std::min(cross + 1, board.size())));
  if (!columns || !rows || std::min(*columns, *rows) < 3 || std::max(*columns, *rows) > 50)
    return Error{ErrorCode::usage,
                 fmt::format("'{}' is not a board: write the inner corners along its sides, 3 to 50, as 9x6",
                             arguments.board),
                 "--board"};
  options.columns = static_cast<int>(*columns);
  options.rows = static_cast<int>(*rows);
  return options;
}

/// left01.jpg → right01.jpg; empty where the name does not say left.
fs::path partner_of(const fs::path& file) {
  std::string name = file.filename().string();
  for (const auto& [left, right] :
       {std::pair{"left", "right"}, std::pair{"Left", "Right"}, std::pair{"LEFT", "RIGHT"}})
    if (const std::size_t at = name.find(left); at != std::string::npos)
      return file.parent_path() / name.replace(at, 4, right);
  return {};
}

Result<Boards> read_boards(const CalibrateArguments& arguments, const Work& work) {
  const fs::path folder(arguments.folder);
  const auto found = sources::recognise_input(std::span(&folder, 1), sources::InputKind::video);
  if (!found) return found.error();
  if (!fs::is_directory(folder))
    return invalid_input("is not a folder of pictures of a chessboard", arguments.folder);
  Boards boards;
  for (std::size_t i = 0; i < found->files.size(); ++i) {
    if (work.cancelled()) return Work::interrupted();
    work.report(0.2 * static_cast<double>(i) / static_cast<double>(found->files.size()),
                "reading the pictures");
    const fs::path& file = found->files[i];
    const fs::path partner = partner_of(file);
    if (partner.empty() || !fs::exists(partner)) continue;
    auto left = sources::read_picture(file), right = sources::read_picture(partner);
    if (!left) return left.error();
    if (!right) return right.error();
    boards.pairs.push_back({std::move(*left), std::move(*right), {}});
  }
  if (!boards.pairs.empty()) return boards;
  for (const fs::path& file : found->files) {
    if (work.cancelled()) return Work::interrupted();
    auto picture = sources::read_picture(file);
    if (!picture) return picture.error();
    boards.pictures.push_back(std::move(*picture));
  }
  return boards;
}

sources::CameraModel model_of(const vision::LensCamera& lens, const Image& picture) {
  return {lens.matrix, lens.distortion, picture.width, picture.height};
}

/// The calibration, and the sizes and numbers for the answer.
struct Found {
  sources::Calibration calibration;
  double reprojection_px = 0.0;
  int used = 0;
  std::size_t given = 0;
};

Result<Found> calibrated(const Boards& boards, const vision::ChessboardOptions& board, const Work& work) {
  Found found;
  if (!boards.pairs.empty()) {
    const auto pair = vision::calibrate_from_chessboards(boards.pairs, board, work);
    if (!pair) return pair.error();
    found.calibration.left = model_of(pair->cameras.left, boards.pairs.front().left);
    found.calibration.right = model_of(pair->cameras.right, boards.pairs.front().right);
    found.calibration.rotation = pair->cameras.rotation;
    found.calibration.translation_m = pair->cameras.translation_m;
    found.reprojection_px = pair->reprojection_px;
    found.used = pair->pairs_used;
    found.given = boards.pairs.size();
    return found;
  }
  const auto single = vision::calibrate_camera(boards.pictures, board, work);
  if (!single) return single.error();
  found.calibration.left = model_of(single->camera, boards.pictures.front());
  found.reprojection_px = single->reprojection_px;
  found.used = single->pictures_used;
  found.given = boards.pictures.size();
  return found;
}

Result<Answer> calibrate(const CalibrateArguments& arguments, Console& console) {
  const auto board = board_of(arguments);
  if (!board) return board.error();
  const auto boards = read_boards(arguments, console.work());
  if (!boards) return boards.error();
  auto found = calibrated(*boards, *board, console.work());
  if (!found) {
    if (found.error().place.empty()) found.error().place = arguments.folder;
    return found.error();
  }
  const std::string yml = sources::encode_calibration(found->calibration, found->reprojection_px);
  if (const auto written = write_file_atomically(arguments.output, std::as_bytes(std::span(yml))); !written)
    return written.error();
  const sources::Calibration& c = found->calibration;
  const char* const what = c.right ? "pairs" : "pictures";
  constexpr double kPoor_px = 1.0;
  if (found->reprojection_px > kPoor_px)
    console.note(
        fmt::format("The reprojection error is {:.2f} pixels (RMS), which is poor: is the board flat, and is "
                    "--board correct?",
                    found->reprojection_px));
  Answer answer;
  answer.json = {{"output", arguments.output},
                 {"cameras", c.right ? 2 : 1},
                 {"reprojection_px", found->reprojection_px},
                 {c.right ? "pairs" : "pictures", found->given},
                 {"used", found->used},
                 {"width", c.left.width},
                 {"height", c.left.height},
                 {"focal_px", c.left.matrix[0]}};
  std::string apart;
  if (c.translation_m) {
    answer.json["baseline_m"] = norm(*c.translation_m);
    apart = fmt::format(", cameras {:.1f} mm apart (with squares of {:g} mm)",
                        1000.0 * norm(*c.translation_m), arguments.square_mm);
  }
  answer.text = fmt::format(
      "{}: from {} of {} {}, reprojection error {:.3f} px RMS, focal length {:.1f} px{}\n", arguments.output,
      found->used, found->given, what, found->reprojection_px, c.left.matrix[0], apart);
  return answer;
}

}  // namespace

void add_calibrate(Program& program) {
  const auto arguments = std::make_shared<CalibrateArguments>();
  Options options =
      add_command(program, "calibrate", "Calibrate one or two cameras from pictures of a chessboard",
                  "  palpable calibrate boards -o cameras.yml --board 9x6 --square 25\n"
                  "  palpable depth left.png right.png -o depth.pfm --calibration cameras.yml",
                  [arguments](Console& console) { return calibrate(*arguments, console); });
  options.argument(
      "FOLDER", arguments->folder,
      "Pictures: left01.jpg and right01.jpg … of two cameras; any other names belong to one camera");
  options.required_output("-o,--output", arguments->output, {}, "Calibration to write (OpenCV yml)");
  options.text("--board", arguments->board, "Inner corners along the board's sides; default: 9x6");
  options.number("--square", arguments->square_mm, {0.1, 10000.0}, "Side of one square, mm");
}

}  // namespace palpable::cli
