// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/ask_to_hold.hpp"
#include "palpable/cli/commands/touch/touch_headless.hpp"
#include "palpable/cli/commands/touch/touch_live.hpp"
#include "palpable/cli/commands/touch/touch_page.hpp"
#include "palpable/cli/commands/touch/touch_plan.hpp"
#include "palpable/core/files/build_id.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/safety/zero_force.hpp"
#include "palpable/haptics/servo/kept_rate.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/signal_thread.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace palpable::cli {
namespace {

/// Errors of laws have no place, those of making a scene the input.
bool is_about_scene(const Error& error, const std::vector<std::string>& inputs) {
  return error.place.empty() || std::find(inputs.begin(), inputs.end(), error.place) != inputs.end();
}

/// The page is told where the head is, so a touch without one has no use for it.
Result<void> open_head(const TouchArguments& arguments, TouchPlan& plan, Console& console) {
  if (arguments.head.empty()) return {};
  if (arguments.headless) {
    console.note(Note("--head has no effect without the page: the camera is not opened."));
    return {};
  }
  const auto& inputs = arguments.scene.make.inputs;
  if (std::find(inputs.begin(), inputs.end(), arguments.head) != inputs.end())
    return Error{ErrorCode::usage, "a camera that is touched does not look at you: give another one",
                 "--head"};
  auto opened = session::open_head_feed(arguments.head, console.work());
  if (!opened) return std::move(opened).error();
  plan.head = *std::move(opened);
  console.note(Note("The depth camera looks for your head: its pictures do not leave the program."));
  return {};
}

Result<Answer> touch(TouchArguments arguments, Console& console) {
  haptics::write_zero_force_on_crash();
  for (const std::string& url : arguments.devices)
    if (auto known = device::check_device_url(url); !known) return known.error();
  const auto published = published_as(arguments.as_published);
  if (!published) return published.error();
  TouchPlan plan;
  if (*published) {
    apply_published(**published, arguments.scene.make);
    plan.options.as_published = (*published)->name;
    console.note(std::string((*published)->differs));
  }
  plan.begin_ns = haptics::monotonic_ns();
  const auto walk = walk_from(arguments.view);
  if (!walk) return walk.error();
  plan.walk = *walk;
  if (const auto possible = check_touch_options(arguments, plan.walk); !possible) return possible.error();
  auto& scene = arguments.scene;
  if (scene.make.inputs.empty()) scene.make.inputs = {kFirstSample};
  if (const auto resolved = resolve_sample(scene.make, scene.title, scene.material); !resolved)
    return resolved.error();
  if (const auto filled = fill_plan(arguments, *published, plan); !filled) return filled.error();
  if (const auto wrong = note_on_cache(arguments.scene.make)) console.note(*wrong);
  const auto live = open_live(
      arguments, plan, [&console](const Note& note) { console.note(note); }, console.work());
  if (!live) return live.error();
  if (const auto head = open_head(arguments, plan, console); !head) return head.error();
  plan.options.seed = console.options().seed;
  plan.options.hold = ask_to_hold(arguments.speak ? Speech::on : Speech::off, console);
  // Without progress: the maker of scenes reports its own at the same time.
  plan.options.work = {console.work().threads, console.work().seed, {}, &interrupted()};
  plan.options.command = console.options().command;
  plan.options.made_by = std::string("palpable ") + PALPABLE_VERSION + " (build " + build_id() + ")";
  constexpr double kRate_Hz = 1000.0;
  plan.options.servo.rate_hz =
      arguments.rate_hz.value_or(*published ? (*published)->rate_hz.value_or(kRate_Hz) : kRate_Hz);
  // The measurement takes a moment, so it is made only for rates above the default.
  constexpr double kMeasure_s = 0.25;
  const auto& servo = plan.options.servo;
  if (servo.rate_hz > kRate_Hz)
    if (auto kept =
            haptics::check_kept(haptics::measure_rate(servo.rate_hz, kMeasure_s, servo.realtime_priority));
        !kept)
      return kept.error();
  const auto run = arguments.keys       ? touch_with_keys
                   : arguments.headless ? touch_without_page
                                        : touch_with_page;
  std::optional<Result<Answer>> answer;
  haptics::run_beside_signals(servo.realtime_priority - 1,
                              [&] { answer.emplace(run(arguments, plan, console)); });
  if (!*answer && *published && is_about_scene(answer->error(), arguments.scene.make.inputs))
    return without_its_scene(std::move(*answer).error(), **published);
  return *std::move(answer);
}

}  // namespace

void add_touch(Program& program) {
  const auto arguments = std::make_shared<TouchArguments>();
  Options options = add_command(
      program, "touch",
      "Touch a scene with a device, in the browser or in the terminal; without INPUT the sample",
      "  palpable touch\n"
      "  palpable touch left.png right.png\n"
      "  palpable touch sample:map --route \"Mill Lane to Church Lane\"\n"
      "  palpable touch room.palp --law rolling\n"
      "  palpable touch room.palp --share    also on phones and tablets\n"
      "  palpable touch room.palp --device falcon:0 --device falcon:1    two hands\n"
      "  palpable touch http://192.168.1.20:8080/video    a stereo camera (MJPEG), live\n"
      "  palpable touch rtsp://NAME:PASSWORD@192.168.1.21/stream1    a stereo camera (H.264 and others)\n"
      "  palpable touch \"camera:0?size=1280x480\"    a stereo camera of this machine\n"
      "  palpable touch \"frames:folder?fps=30&loop=1\"    frames of a depth camera, live\n"
      "  palpable touch \"ros://robot.local:9090?depth=/depth\"    a depth camera of a rosbridge server\n"
      "  palpable touch robot:sample    drive a simulated robot, and touch what it sees, wide or near\n"
      "  palpable touch left.png right.png --headless --seconds 10 --json",
      [arguments](Console& console) { return touch(*arguments, console); });
  add_make_options(options, arguments->scene.make);
  add_title_options(options, arguments->scene.title);
  add_material_options(options, arguments->scene.material);
  add_law_options(options, arguments->law);
  options.under("The touch");
  add_as_published(options, arguments->as_published);
  options.flag("--unlimited", arguments->unlimited,
               "With --as-published: no stiffness limit, rise limit and passivity controller; for simulated "
               "devices and those of at most 4 N");
  options.choice("--transients", arguments->transient, {"none", "rubber", "wood", "metal"},
                 "Material whose vibration an impact starts; for devices with motors");
  options.number("--hand-damping", arguments->hand_damping_Ns_per_m, {0.1, 40.0},
                 "Least damping that the hand adds to the device, N·s/m; the stiffness limit depends on it "
                 "(doctor --measure-hand measures it)");
  options.texts(
      "--device", arguments->devices,
      "Device (palpable devices lists them); default: the page's pointer. Again for each further hand");
  options.number(
      "--magnify", arguments->magnification, {1.0, 10.0},
      "The scene is that many times larger than what fits into the device's workspace; at the border "
      "it moves beneath the hand");
  options.integer(
      "--clutch", arguments->clutch, {0, 32},
      "While this button of the device is pressed the scene moves with the hand; 0 = none; default: 1 "
      "with --magnify, else none");
  options.integer("--stop-button", arguments->stop_button, {0, 32},
                  "Pressing this button of the device ends its force until it is pressed again; 0 = none");
  options.flag("--no-cushion", arguments->no_cushion,
               "No soft spring at the border of the device's workspace");
  options.integer("--port", arguments->port, {0, 65535}, "Port of the page on 127.0.0.1; 0 = any free one");
  options.flag("--no-browser", arguments->no_browser, "Do not open the browser");
  options.flag(
      "--share", arguments->share,
      "Share the touch with phones and tablets of the local network, over TLS: prints a one-time link "
      "with its QR code");
  options.text("--share-address", arguments->share_address,
               "With --share: which IP address of this computer they connect to");
  options.integer("--share-port", arguments->share_port, {0, 65535},
                  "With --share: the port that they connect to; 0 = any free one");
  options.text(
      "--head", arguments->head,
      "The view follows your head, found by a depth camera at the screen that looks at you: frames:FOLDER, "
      "openni:N, freenect:N, realsense:N or ros://HOST:PORT; its pictures do not leave the program");
  options.flag("--headless", arguments->headless, "No page: a scripted hand explores");
  options.flag("--keys", arguments->keys,
               "With --headless: explore with the keys of this terminal; H lists them (braille, speech)");
  options.text("--route", arguments->route,
               "Street map: the way 'A to B' is spoken, its streets are smooth and all others rough, and a "
               "device with "
               "motors pulls gently along it; A and B are streets, places, or junctions as 'A & B'");
  options.number("--pull", arguments->pull_N, {0.0, models::kMaxGuideForce_N},
                 "With --route: greatest pull along the way, N; 0 = none; default: 0.5");
  add_view_options(options, arguments->view);
  options.flag("--speak", arguments->speak, "Speak faults, names and answers in a headless touch");
  options.number("--seconds", arguments->seconds, {0.01, 86400.0}, "How long a headless touch lasts");
  options.number("--rate", arguments->rate_hz, {100.0, 4000.0},
                 "Servo rate in Hz (1000 unless a paper states another)");
  options.flag(
      "--start-robot", arguments->start_robot,
      "Start the robot of robot:HOST:PORT at once; without it, only the page's button or the word start at "
      "the "
      "terminal does, and nothing is sent to it before. Further words: stop, drive, look, touch, near, wide");
  options.output_folder(
      "--record-frames", arguments->frames_recording,
      "Record the pairs or depth frames of a live camera into this folder, for frames:FOLDER");
  options.flag("--memory", arguments->memory,
               "Live source: what left the picture stays under the hand, rougher and named by its age");
  options.output("--record", arguments->recording, {},
                 "Record every tick into this file; the second hand's into FILE-2, and so on");
  options.last_output_writes([arguments](const std::string& file) {
    std::vector<std::string> files;
    for (std::size_t hand = 0; hand < std::max<std::size_t>(1, arguments->devices.size()); ++hand)
      files.push_back(session::recording_of_hand(file, hand).string());
    return files;
  });
}

}  // namespace palpable::cli
