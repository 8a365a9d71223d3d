// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/touch_plan.hpp"

#include "palpable/cli/arguments/route_option.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/url.hpp"

#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// A button that ends the force, or moves the scene, must be one that can be pressed.
Result<void> check_buttons(const TouchArguments& arguments) {
  if (arguments.stop_button == 0 && arguments.clutch.value_or(0) == 0) return {};
  for (const std::string& url : arguments.devices)
    if (!device::has_buttons(url))
      return Error{ErrorCode::usage, "this device has no button: leave out --clutch and --stop-button",
                   device::url_as_place(url)};
  return {};
}

Result<session::TouchSettings> settings_of(const TouchArguments& arguments,
                                           const std::optional<Published>& published) {
  if (published && !arguments.law.law.empty())
    return Error{ErrorCode::usage, "--as-published sets the law: leave out --law", {}};
  const auto law = law_parameters(arguments.law, published ? published->law.law : session::default_law().law);
  if (!law) return law.error();
  session::TouchSettings settings;
  settings.law = *law;
  settings.law_is_chosen = published.has_value() || !arguments.law.law.empty();
  settings.law_is_required = published.has_value();
  if (published) apply_published(*published, settings.law);
  if (!settings.law.radius_m) settings.law.radius_m = published ? 0.0 : session::default_law().radius_m;
  const auto transient = haptics::transient_kind_from(arguments.transient);
  settings.transient = transient.value_or(haptics::TransientKind::none);
  settings.hand_damping_Ns_per_m = arguments.hand_damping_Ns_per_m;
  if (!arguments.unlimited) return settings;
  if (!published)
    return Error{ErrorCode::usage, "the limits are off only with --as-published", "--unlimited"};
  settings.limits = session::Limits::off;
  return settings;
}

/// The scene with the names and words that the command line gives it.
Result<std::shared_ptr<const models::Scene>> named_scene(models::Scene scene, const TouchPlan& plan,
                                                         const Notes& notes) {
  apply_title(plan.title, scene);
  if (!plan.route.empty()) {
    const auto words = apply_route(plan.route, plan.guidance, scene);
    if (!words) return words.error();
    for (const std::string& sentence : *words) notes(Note(sentence));
  }
  if (auto applied = apply_materials(plan.material, scene); !applied) return std::move(applied).error();
  return std::make_shared<const models::Scene>(std::move(scene));
}

/// A note on the numbers that the law of this scene does not have. The law `tool` is replaced for a device
/// without torque, and then others may have an effect.
std::optional<Note> note_on_law(const TouchPlan& plan, const models::Scene& scene) {
  const haptics::Law law = law_for(plan.settings.law.law, scene);
  if (haptics::description_of(law).degrees_of_freedom > 3) return std::nullopt;
  return note_on_unused(plan.law, law);
}

std::string line_of(const session::TouchStatistics& hand) {
  const auto& servo = hand.servo;
  return fmt::format(
      "{}: {} ticks at {:.1f} Hz, {} missed, {} in contact, at most {:.2f} N; real-time priority: {}\n",
      hand.device, servo.touch.ticks, servo.rate_hz, servo.missed, servo.touch.contact_ticks,
      servo.touch.max_force_N, hand.realtime_priority);
}

}  // namespace

session::SceneMaker maker_of(const TouchPlan& plan, Notes notes) {
  if (plan.live)
    return
        [plan, notes = std::move(notes)](const session::DeliverScene& deliver, const Work&) -> Result<void> {
          auto scene = named_scene(*plan.live->first_scene(), plan, notes);
          if (!scene) return std::move(scene).error();
          deliver(*std::move(scene));
          return {};
        };
  return [plan, notes = std::move(notes)](const session::DeliverScene& deliver,
                                          const Work& work) -> Result<void> {
    std::set<std::string> given;
    Result<void> named;
    auto made = session::make_scenes(
        plan.make,
        [&](recipes::MadeScene one) {
          if (const auto unused = note_on_unused(plan.arguments, plan.make, one.scene))
            one.notes.push_back(*unused);
          if (const auto unused = note_on_law(plan, one.scene)) one.notes.push_back(*unused);
          if (const auto lay = note_on_lay(plan.arguments, plan.make, one.scene)) one.notes.push_back(*lay);
          for (const Note& note : one.notes)
            if (given.insert(note.sentence).second) notes(note);
          auto scene = named_scene(std::move(one.scene), plan, notes);
          if (scene)
            deliver(*std::move(scene));
          else
            named = std::move(scene).error();
        },
        work);
    return named ? std::move(made) : std::move(named);
  };
}

Result<void> check_touch_options(const TouchArguments& arguments,
                                 const std::vector<session::WalkStep>& walk) {
  if (arguments.devices.size() > haptics::kMaxLiveProbes)
    return Error{ErrorCode::usage, fmt::format("at most {} devices", haptics::kMaxLiveProbes), "--device"};
  if (auto together = device::check_together(arguments.devices); !together) return together;
  if (auto pressed = check_buttons(arguments); !pressed) return pressed;
  if (arguments.keys && !arguments.headless)
    return Error{ErrorCode::usage,
                 "the keys of the terminal are for a touch without the page: add --headless", "--keys"};
  if (arguments.keys && (!arguments.devices.empty() || !walk.empty()))
    return Error{ErrorCode::usage, "the keys move the probe themselves: leave out --device and --view",
                 "--keys"};
  if (!arguments.view.walk.empty() && !arguments.headless)
    return Error{ErrorCode::usage, "on the page the user walks: leave out --walk, or add --headless",
                 "--walk"};
  if (arguments.share && arguments.headless)
    return Error{ErrorCode::usage, "what is shared is the page: leave out --headless", "--share"};
  if (!arguments.share && (!arguments.share_address.empty() || arguments.share_port != 0))
    return Error{ErrorCode::usage, "is for a touch that is shared: add --share",
                 arguments.share_address.empty() ? "--share-port" : "--share-address"};
  if (arguments.pull_N && arguments.route.empty())
    return Error{ErrorCode::usage, "the pull is along a route: add --route", "--pull"};
  if (arguments.scene.make.detail == kCompareDetails)
    return Error{ErrorCode::usage, "cannot be touched: compare the operators with palpable make", "--detail"};
  return {};
}

Result<void> fill_plan(TouchArguments& arguments, const std::optional<Published>& published,
                       TouchPlan& plan) {
  const auto make = make_options(arguments.scene.make);
  if (!make) return make.error();
  plan.arguments = arguments.scene.make;
  plan.law = arguments.law;
  plan.make = *make;
  if (published && arguments.scene.make.as.empty()) plan.make.as = published->as;
  if (const auto readable = read_materials(arguments.scene.material); !readable) return readable.error();
  plan.material = arguments.scene.material;
  const auto title = read_title(arguments.scene.title);
  if (!title) return title.error();
  plan.title = *title;
  plan.route = arguments.route;
  plan.guidance.pull_N = arguments.pull_N.value_or(plan.guidance.pull_N);
  const auto settings = settings_of(arguments, published);
  if (!settings) return settings.error();
  plan.settings = *settings;
  auto& workspace = plan.options.workspace;
  workspace.magnification = arguments.magnification;
  workspace.cushion = !arguments.no_cushion;
  const int clutch = arguments.clutch.value_or(arguments.magnification > 1.0 ? 1 : 0);
  if (clutch > 0) workspace.clutch_button = clutch - 1;
  if (arguments.stop_button > 0) workspace.stop_button = arguments.stop_button - 1;
  for (std::size_t hand = 1; hand < arguments.devices.size(); ++hand)
    plan.options.further_devices.push_back(arguments.devices[hand]);
  if (arguments.unlimited) {
    plan.options.servo.tick.max_force_rate_N_per_s = std::numeric_limits<double>::infinity();
    plan.options.servo.tick.passivity = haptics::Passivity::observe;
  }
  return {};
}

Answer answer_of(const session::TouchStatistics& statistics) {
  Answer answer;
  answer.json = Json::parse(session::to_json(statistics));
  answer.text = line_of(statistics);
  for (const auto& hand : statistics.further_hands) answer.text += line_of(hand);
  answer.exit_code = interrupted() ? static_cast<int>(ErrorCode::interrupted) : 0;
  return answer;
}

std::filesystem::path free_scene_file(const std::string& stem) {
  std::filesystem::path free = stem + ".palp";
  std::error_code ignored;
  for (int k = 2; std::filesystem::exists(free, ignored); ++k) free = fmt::format("{}-{}.palp", stem, k);
  return free;
}

std::filesystem::path save_path(const TouchPlan& plan) {
  const auto& inputs = plan.make.input.files;
  const std::filesystem::path first = plan.live != nullptr ? "live"
                                      : inputs.empty()     ? "scene"
                                                           : inputs.front();
  if (inputs.size() == 1 && first.extension() == ".palp") return first;
  return free_scene_file(first.has_stem() ? first.stem().string() : "scene");
}

}  // namespace palpable::cli
