// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/touch_headless.hpp"

#include "palpable/cli/commands/touch/touch_robot.hpp"
#include "palpable/cli/keys/touch_by_keys.hpp"
#include "palpable/cli/say_aloud.hpp"
#include "palpable/voice/voice.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// A missed deadline and why, for the log.
std::string sentence_of(const haptics::MissedDeadline& missed) {
  constexpr std::array kCauses{"the system woke the servo late", "the servo was delayed while it waited",
                               "the servo was delayed during a tick", "the tick itself was slow"};
  return fmt::format("Tick {}: {} missed, {:.0f} microseconds late; {}.", missed.tick,
                     missed.periods == 1 ? "a deadline" : fmt::format("{} deadlines", missed.periods),
                     missed.late_us, kCauses[static_cast<std::size_t>(missed.cause)]);
}

/// Speaks faults, steps at a device, and the names of touched regions.
void let_speak(session::HeadlessOptions& headless, Console& console) {
  auto speaker = voice::open_speaker();
  if (!speaker) return console.note(speaker.error().sentence());
  const auto speech = std::make_shared<voice::Voice>(std::move(*speaker));
  headless.on_pose = [speech, &console](const session::ExplorerPose& pose) {
    console.note(session::words_of(pose));
    speech->say(voice::Importance::news, session::words_of(pose));
  };
  // That the force is back must not wait behind, or give way to, that it is off.
  headless.on_device = [speech, &console](const std::string& sentence, bool tells_of_force) {
    console.note(sentence);
    speech->say(tells_of_force ? voice::Importance::fault : voice::Importance::news, sentence);
  };
  headless.on_notice = [speech, &console](const std::string& sentence) {
    console.note(sentence);
    speech->say(voice::Importance::news, sentence);
  };
  headless.on_event = [speech](const haptics::TouchEvent& event, const models::Scene& scene) {
    using Kind = haptics::TouchEvent::Kind;
    if (event.kind == Kind::not_finite)
      speech->say(voice::Importance::fault, "The force is off: the law gave an invalid value.");
    const bool named = event.kind == Kind::label_entered && event.value < scene.materials.size() &&
                       scene.materials[event.value].name != models::Material{}.name;
    if (named) speech->say(voice::Importance::label, scene.materials[event.value].name);
  };
}

/// With a seed that was chosen, simulated hands on a scene that does not change by the clock.
bool is_repeatable(const TouchArguments& arguments, const TouchPlan& plan) {
  const auto given = arguments.scene.make.given ? arguments.scene.make.given() : std::vector<std::string>();
  return std::find(given.begin(), given.end(), "--seed") != given.end() && plan.live == nullptr &&
         plan.walk.empty() &&
         std::all_of(arguments.devices.begin(), arguments.devices.end(),
                     [](const std::string& url) { return url == "sim" || url.starts_with("sim:"); });
}

}  // namespace

Result<Answer> touch_without_page(const TouchArguments& arguments, const TouchPlan& plan, Console& console) {
  session::HeadlessOptions headless;
  headless.settings = plan.settings;
  headless.session = plan.options;
  headless.seconds = arguments.seconds;
  headless.repeatable = is_repeatable(arguments, plan);
  headless.recording = arguments.recording;
  headless.begin_ns = plan.begin_ns;
  headless.walk = plan.walk;
  headless.live = plan.live.get();
  headless.on_pose = [&console](const session::ExplorerPose& pose) { console.note(session::words_of(pose)); };
  if (!arguments.devices.empty()) headless.device_url = arguments.devices.front();
  headless.on_notice = [&console](const std::string& sentence) { console.note(sentence); };
  headless.on_device = [&console](const std::string& sentence, bool) { console.note(sentence); };
  headless.on_missed = [&console](const haptics::MissedDeadline& missed) {
    console.note(sentence_of(missed));
  };
  if (arguments.speak) let_speak(headless, console);
  const auto notes = [&console](const Note& note) { console.note(note); };
  const RobotTerminal terminal(plan.live ? plan.live->robot() : nullptr, console);
  const auto statistics = session::touch_headless(maker_of(plan, notes), headless, console.work());
  if (!statistics) {
    if (arguments.speak && statistics.error().code != ErrorCode::interrupted)
      say_aloud(statistics.error().sentence(), console);
    return statistics.error();
  }
  return answer_of(*statistics);
}

Result<Answer> touch_with_keys(const TouchArguments& arguments, const TouchPlan& plan, Console& console) {
  const auto notes = [&console](const Note& note) { console.note(note); };
  const auto statistics = touch_by_keys(maker_of(plan, notes),
                                        {plan.settings, plan.options, plan.begin_ns, arguments.recording,
                                         arguments.speak, plan.make.recipes.map, save_path(plan)},
                                        console);
  if (!statistics) return statistics.error();
  return answer_of(*statistics);
}

}  // namespace palpable::cli
