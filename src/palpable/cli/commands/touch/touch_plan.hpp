// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/arguments/as_published.hpp"
#include "palpable/cli/arguments/law_options.hpp"
#include "palpable/cli/arguments/route_option.hpp"
#include "palpable/cli/arguments/sample_scene.hpp"
#include "palpable/cli/arguments/view_options.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/session/touch/head_feed.hpp"
#include "palpable/session/touch/headless.hpp"
#include "palpable/study/world/robot_server.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::cli {

/// What the command line of `touch` says.
struct TouchArguments {
  SceneArguments scene;
  LawArguments law;
  /// URLs, one for each hand; empty: the command's own default.
  std::vector<std::string> devices;
  double magnification = 1.0;
  /// The number of a button, from 1; 0: none. Not given: the first one of a magnified scene.
  std::optional<int> clutch;
  int stop_button = 0;
  bool no_cushion = false;
  std::string recording;
  /// The folder to which the pictures of a live stereo camera are recorded; empty: none.
  std::string frames_recording;
  /// Start the robot at once, without a person at a terminal.
  bool start_robot = false;
  /// A live touch keeps what left the picture.
  bool memory = false;
  /// The depth camera that looks at the viewer; empty: none.
  std::string head;
  int port = 0;
  bool headless = false;
  bool keys = false;
  bool no_browser = false;
  /// Shares the touch with phones and tablets, at this address and port; empty and 0: those that are free.
  bool share = false;
  std::string share_address;
  int share_port = 0;
  bool speak = false;
  double seconds = 10.0;
  std::optional<double> rate_hz;
  std::string as_published;
  bool unlimited = false;
  std::string transient = "none";
  double hand_damping_Ns_per_m = haptics::kLeastHandDamping_Ns_per_m;
  ViewArguments view;
  /// "A to B" on a map; empty: none.
  std::string route;
  std::optional<double> pull_N;
};

/// Receives notes for the user about the input.
using Notes = std::function<void(const Note&)>;

/// The options of a touch, with or without the page.
struct TouchPlan {
  MakeArguments arguments;
  LawArguments law;
  session::MakeOptions make;
  MaterialArguments material;
  TitleArguments title;
  std::string route;
  RouteGuidance guidance;
  std::vector<session::WalkStep> walk;
  session::TouchSettings settings;
  session::SessionOptions options;
  std::int64_t begin_ns = 0;
  /// The simulated robot that is touched; null: none.
  std::shared_ptr<study::RobotServer> sample_robot;
  /// Null unless the input is a live source.
  std::shared_ptr<session::LiveFeed> live;
  /// Null: nothing finds the viewer's head.
  std::shared_ptr<session::HeadFeed> head;
};

/// Errors: usage, for options that exclude each other.
Result<void> check_touch_options(const TouchArguments& arguments, const std::vector<session::WalkStep>& walk);

/// Sets what is made and how it is touched. Errors: usage; invalid_input for files of names and materials.
Result<void> fill_plan(TouchArguments& arguments, const std::optional<Published>& published, TouchPlan& plan);

/// A new scene file in the current folder, named "STEM.palp", or "STEM-2.palp", …
std::filesystem::path free_scene_file(const std::string& stem);
/// The file to which a touch saves its scene: the scene's own file, else a new one in the current folder.
std::filesystem::path save_path(const TouchPlan& plan);

/// Makes the scenes of a touch, the fastest first; each note is given once.
session::SceneMaker maker_of(const TouchPlan& plan, Notes notes);

/// What the command prints at the end of a touch.
Answer answer_of(const session::TouchStatistics& statistics);

}  // namespace palpable::cli
