// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/touch_live.hpp"

#include "palpable/cli/arguments/stereo_options.hpp"
#include "palpable/cli/commands/touch/touch_robot.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/session/touch/live_address.hpp"
#include "palpable/sources/calibration/calibration.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Options of `make` for depth that a live source does not have.
constexpr std::array kWithoutEffect{
    "--kind",    "--as",     "--poses",       "--depth-scale", "--depth-as", "--near-plane", "--far-plane",
    "--detail",  "--smooth", "--compression", "--height-of",   "--resample", "--samples",    "--engrave",
    "--texture", "--ground", "--background",  "--method",      "--rectify",  "--moved",      "--megapixels",
    "--up",      "--lay",    "--resolution",  "--max-error"};

void note_on_options(const MakeArguments& arguments, const Notes& notes) {
  const auto given = arguments.given ? arguments.given() : std::vector<std::string>();
  std::vector<std::string> unused;
  for (const char* option : kWithoutEffect)
    if (std::find(given.begin(), given.end(), option) != given.end()) unused.emplace_back(option);
  if (unused.empty()) return;
  notes(Note(fmt::format("{} {} no effect on a live source.", describe::listed(unused),
                         unused.size() == 1 ? "has" : "have")));
}

Result<session::LiveOptions> live_options(const sculpt::ReliefOptions& relief) {
  session::LiveOptions options;
  options.relief.size_m = relief.size_m.value_or(options.relief.size_m);
  options.relief.size_m.z *= relief.exaggerate;
  options.relief.steepest_slope = relief.steepest_slope;
  if (relief.near.has_value() != relief.far.has_value())
    return Error{ErrorCode::usage, "a live source needs both ends of the depths that it shows, or none",
                 relief.near ? "--near" : "--far"};
  if (relief.near) options.range = vision::DepthRange{*relief.near, *relief.far};
  return options;
}

/// The rig of --calibration; nullopt without it.
Result<std::optional<StereoRig>> rig_of(const std::string& calibration) {
  if (calibration.empty()) return std::optional<StereoRig>();
  const auto read = sources::read_calibration(calibration);
  if (!read) return read.error();
  if (!read->rig)
    return Error{
        ErrorCode::usage,
        "states cameras whose pictures must be rectified first; live pairs are taken as they are, so "
        "give the calibration of rectified pictures",
        calibration};
  return read->rig;
}

}  // namespace

Result<void> open_live(const TouchArguments& arguments, TouchPlan& plan, const Notes& notes,
                       const Work& work) {
  const auto& inputs = arguments.scene.make.inputs;
  const auto address = std::find_if(inputs.begin(), inputs.end(), session::is_live_address);
  if (address == inputs.end()) {
    if (arguments.frames_recording.empty() && !arguments.start_robot && !arguments.memory) return {};
    return Error{ErrorCode::usage, "is for live sources",
                 arguments.start_robot ? "--start-robot"
                 : arguments.memory    ? "--memory"
                                       : "--record-frames"};
  }
  if (inputs.size() > 1)
    return Error{ErrorCode::usage, "a live source is touched alone, without further inputs", *address};
  if (arguments.keys || !arguments.as_published.empty() || !arguments.route.empty())
    return Error{ErrorCode::usage, "not for a live source",
                 arguments.keys                   ? "--keys"
                 : arguments.as_published.empty() ? "--route"
                                                  : "--as-published"};
  auto options = live_options(plan.make.recipes.relief.relief);
  if (!options) return options.error();
  options->record_to = arguments.frames_recording;
  if (arguments.memory) options->memory = session::Memory::on;
  const auto rig = rig_of(arguments.scene.make.stereo.calibration);
  if (!rig) return rig.error();
  std::string opened = *address;
  if (is_sample_robot(opened)) {
    auto sample = start_sample_robot(opened);
    if (!sample) return std::move(sample).error();
    opened = std::move(sample->address);
    plan.sample_robot = std::move(sample->server);
  }
  auto source = session::open_live_source(
      opened, {*rig, layout_of(arguments.scene.make.stereo), arguments.frames_recording}, work);
  if (!source) return std::move(source).error();
  note_on_options(arguments.scene.make, notes);
  auto feed = session::LiveFeed::open(*std::move(source), *options, work);
  if (!feed) return std::move(feed).error();
  plan.live = *std::move(feed);
  if (plan.live->robot() == nullptr && arguments.start_robot)
    return Error{ErrorCode::usage, "is for robots", "--start-robot"};
  if (plan.live->robot() != nullptr && arguments.start_robot) plan.live->robot()->request_start();
  plan.options.servo.tick.fade_s = options->fade_s;
  return {};
}

}  // namespace palpable::cli
