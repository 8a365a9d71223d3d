// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/as_published.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/law_options.hpp"
#include "palpable/cli/open_browser.hpp"
#include "palpable/cli/sample_scene.hpp"
#include "palpable/cli/touch_by_keys.hpp"
#include "palpable/cli/view_options.hpp"
#include "palpable/core/build_id.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/safety/zero_force.hpp"
#include "palpable/haptics/servo/kept_rate.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/signal_thread.hpp"
#include "palpable/page/server.hpp"
#include "palpable/page/touch_host.hpp"
#include "palpable/session/touch/headless.hpp"
#include "palpable/voice/voice.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct TouchArguments {
  SceneArguments scene;
  LawArguments law;
  std::string device;
  std::string recording;
  int port = 0;
  bool headless = false;
  bool keys = false;
  bool no_browser = false;
  bool speak = false;
  double seconds = 10.0;
  std::optional<double> rate_hz;
  std::string as_published;
  bool unlimited = false;
  std::string transient = "none";
  double hand_damping_Ns_per_m = haptics::kLeastHandDamping_Ns_per_m;
  ViewArguments view;
};

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

/// Receives notes for the user about the input.
using Notes = std::function<void(const Note&)>;

/// The options of a touch, with or without the page.
struct Plan {
  MakeArguments arguments;
  LawArguments law;
  session::MakeOptions make;
  MaterialArguments material;
  TitleArguments title;
  std::vector<session::WalkStep> walk;
  session::TouchSettings settings;
  session::SessionOptions options;
  std::int64_t begin_ns = 0;
};

/// The scene with the names and words that the command line gives it.
Result<std::shared_ptr<const models::Scene>> named_scene(models::Scene scene, const Plan& plan) {
  apply_title(plan.title, scene);
  if (auto applied = apply_materials(plan.material, scene); !applied) return std::move(applied).error();
  return std::make_shared<const models::Scene>(std::move(scene));
}

/// A note on the numbers that the law of this scene does not have. The law `tool` is replaced for a device
/// without torque, and then others may have an effect.
std::optional<Note> note_on_law(const Plan& plan, const models::Scene& scene) {
  const haptics::Law law = law_for(plan.settings.law.law, scene);
  if (haptics::description_of(law).degrees_of_freedom > 3) return std::nullopt;
  return note_on_unused(plan.law, law);
}

/// Makes the scenes of a touch, the fastest first; each note is given once.
session::SceneMaker maker_of(const Plan& plan, Notes notes) {
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
          auto scene = named_scene(std::move(one.scene), plan);
          if (scene)
            deliver(*std::move(scene));
          else
            named = std::move(scene).error();
        },
        work);
    return named ? std::move(made) : std::move(named);
  };
}

/// A missed deadline and why, for the log.
std::string sentence_of(const haptics::MissedDeadline& missed) {
  constexpr std::array kCauses{"the system woke the servo late", "the servo was delayed while it waited",
                               "the servo was delayed during a tick", "the tick itself was slow"};
  return fmt::format("Tick {}: {} missed, {:.0f} microseconds late; {}.", missed.tick,
                     missed.periods == 1 ? "a deadline" : fmt::format("{} deadlines", missed.periods),
                     missed.late_us, kCauses[static_cast<std::size_t>(missed.cause)]);
}

Answer answer_of(const session::TouchStatistics& statistics) {
  const auto& servo = statistics.servo;
  Answer answer;
  answer.json = Json::parse(session::to_json(statistics));
  answer.text = fmt::format(
      "{}: {} ticks at {:.1f} Hz, {} missed, {} in contact, at most {:.2f} N; real-time priority: {}\n",
      statistics.device, servo.touch.ticks, servo.rate_hz, servo.missed, servo.touch.contact_ticks,
      servo.touch.max_force_N, statistics.realtime_priority);
  answer.exit_code = interrupted() ? static_cast<int>(ErrorCode::interrupted) : 0;
  return answer;
}

/// Speaks faults and the names of touched regions.
void let_speak(session::HeadlessOptions& headless, Console& console) {
  auto speaker = voice::open_speaker();
  if (!speaker) return console.note(speaker.error().sentence());
  const auto speech = std::make_shared<voice::Voice>(std::move(*speaker));
  headless.on_stance = [speech, &console](const session::Stance& stance) {
    console.note(session::words_of(stance));
    speech->say(voice::Importance::news, session::words_of(stance));
  };
  headless.on_event = [speech](const haptics::TouchEvent& event, const models::Scene& scene) {
    using Kind = haptics::TouchEvent::Kind;
    if (event.kind == Kind::fault)
      speech->say(voice::Importance::fault, "The device does not answer. Its force is off.");
    if (event.kind == Kind::not_finite)
      speech->say(voice::Importance::fault, "The force is off: the law gave an invalid value.");
    if (event.kind == Kind::recovered) speech->say(voice::Importance::news, "The device answers again.");
    const bool named = event.kind == Kind::label_entered && event.value < scene.materials.size() &&
                       scene.materials[event.value].name != models::Material{}.name;
    if (named) speech->say(voice::Importance::label, scene.materials[event.value].name);
  };
}

Result<Answer> touch_without_page(const TouchArguments& arguments, const Plan& plan, Console& console) {
  session::HeadlessOptions headless;
  headless.settings = plan.settings;
  headless.session = plan.options;
  headless.seconds = arguments.seconds;
  headless.recording = arguments.recording;
  headless.begin_ns = plan.begin_ns;
  headless.walk = plan.walk;
  headless.on_stance = [&console](const session::Stance& stance) { console.note(session::words_of(stance)); };
  if (!arguments.device.empty()) headless.device_url = arguments.device;
  headless.on_notice = [&console](const std::string& sentence) { console.note(sentence); };
  headless.on_missed = [&console](const haptics::MissedDeadline& missed) {
    console.note(sentence_of(missed));
  };
  if (arguments.speak) let_speak(headless, console);
  const auto notes = [&console](const Note& note) { console.note(note); };
  const auto statistics = session::touch_headless(maker_of(plan, notes), headless, console.work());
  if (!statistics) return statistics.error();
  return answer_of(*statistics);
}

Result<Answer> touch_with_keys(const TouchArguments& arguments, const Plan& plan, Console& console) {
  const auto notes = [&console](const Note& note) { console.note(note); };
  const auto statistics = touch_by_keys(
      maker_of(plan, notes),
      {plan.settings, plan.options, plan.begin_ns, arguments.recording, arguments.speak}, console);
  if (!statistics) return statistics.error();
  return answer_of(*statistics);
}

/// Keeps notes until a page can show them. Any thread.
class NoteBox {
 public:
  void put(const Note& note) {
    const std::lock_guard lock(mutex_);
    if (receiver_) {
      receiver_(note);
    } else {
      kept_.push_back(note);
    }
  }
  /// Passes the kept notes and all later ones to `receiver`; an empty one keeps them again.
  void open(Notes receiver) {
    const std::lock_guard lock(mutex_);
    receiver_ = std::move(receiver);
    if (!receiver_) return;
    for (const Note& note : std::exchange(kept_, {})) receiver_(note);
  }

 private:
  std::mutex mutex_;
  Notes receiver_;
  std::vector<Note> kept_;
};

/// The file to which the page saves the scene: the scene's own file, else a new one in the current folder.
std::filesystem::path save_path(const std::vector<std::filesystem::path>& inputs) {
  std::filesystem::path first = inputs.empty() ? "scene" : inputs.front();
  if (inputs.size() == 1 && first.extension() == ".palp") return first;
  const std::string stem = first.has_stem() ? first.stem().string() : "scene";
  std::filesystem::path free = stem + ".palp";
  std::error_code ignored;
  for (int k = 2; std::filesystem::exists(free, ignored); ++k) free = fmt::format("{}-{}.palp", stem, k);
  return free;
}

/// Serves the page of a running touch until the user ends it.
Result<void> serve_page(const TouchArguments& arguments, const Plan& plan, session::TouchSession& session,
                        session::MakerThread& maker, NoteBox& notes, Console& console) {
  page::TouchHost host(session, {std::string("palpable ") + PALPABLE_VERSION,
                                 {},
                                 [&maker] { return maker.take(std::chrono::milliseconds(0)); },
                                 save_path(plan.make.input.files),
                                 !plan.walk.empty()});
  notes.open([&host](const Note& note) { host.say("info", note.sentence); });
  std::optional<OpenedBrowser> browser;
  page::ServeOptions options;
  options.port = static_cast<std::uint16_t>(arguments.port);
  options.on_ready = [&](const std::string& address) {
    console.say(fmt::format("Touch the scene at {}\nEnd with Ctrl-C.", address));
    if (!arguments.no_browser) browser.emplace(address);
  };
  auto served = page::serve(host, options, interrupted());
  notes.open({});
  return served;
}

Result<Answer> touch_with_page(const TouchArguments& arguments, const Plan& plan, Console& console) {
  NoteBox notes;
  session::MakerThread maker(maker_of(plan,
                                      [&](const Note& note) {
                                        console.note(note);
                                        notes.put(note);
                                      }),
                             console.work());
  auto scene = maker.first_scene(console.work());
  if (!scene) return scene.error();
  session::SessionOptions options = plan.options;
  options.further_probes = haptics::kMaxLiveProbes - 1;
  options.recording = arguments.recording;
  auto opened = session::TouchSession::open(std::move(*scene), plan.settings,
                                            arguments.device.empty() ? "pointer:" : arguments.device, options,
                                            plan.begin_ns);
  if (!opened) return opened.error();
  session::TouchSession& session = **opened;
  const auto served = serve_page(arguments, plan, session, maker, notes, console);
  const auto recorded = session.stop_recording();
  session.stop();
  if (!served) return served.error();
  if (!recorded) return recorded.error();
  return answer_of(session.statistics());
}

/// Errors: usage, for options that exclude each other.
Result<void> check_options(const TouchArguments& arguments, const std::vector<session::WalkStep>& walk) {
  if (arguments.keys && !arguments.headless)
    return Error{ErrorCode::usage,
                 "the keys of the terminal are for a touch without the page: add --headless", "--keys"};
  if (arguments.keys && (!arguments.device.empty() || !walk.empty()))
    return Error{ErrorCode::usage, "the keys move the probe themselves: leave out --device and --view",
                 "--keys"};
  if (!arguments.view.walk.empty() && !arguments.headless)
    return Error{ErrorCode::usage, "on the page the user walks: leave out --walk, or add --headless",
                 "--walk"};
  if (arguments.scene.make.detail == kCompareDetails)
    return Error{ErrorCode::usage, "cannot be touched: compare the operators with palpable make", "--detail"};
  return {};
}

/// Sets what is made and how it is touched. Errors: usage; invalid_input for files of names and materials.
Result<void> fill_plan(TouchArguments& arguments, const std::optional<Published>& published, Plan& plan) {
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
  const auto settings = settings_of(arguments, published);
  if (!settings) return settings.error();
  plan.settings = *settings;
  if (arguments.unlimited) {
    plan.options.servo.tick.max_force_rate_N_per_s = std::numeric_limits<double>::infinity();
    plan.options.servo.tick.passivity = haptics::Passivity::observe;
  }
  return {};
}

Result<Answer> touch(TouchArguments arguments, Console& console) {
  haptics::write_zero_force_on_crash();
  if (!arguments.device.empty())
    if (auto known = device::check_device_url(arguments.device); !known) return known.error();
  const auto published = published_as(arguments.as_published);
  if (!published) return published.error();
  Plan plan;
  if (*published) {
    apply_published(**published, arguments.scene.make);
    plan.options.as_published = (*published)->name;
    console.note(std::string((*published)->differs));
  }
  plan.begin_ns = haptics::monotonic_ns();
  const auto walk = walk_from(arguments.view);
  if (!walk) return walk.error();
  plan.walk = *walk;
  if (const auto possible = check_options(arguments, plan.walk); !possible) return possible.error();
  if (arguments.scene.make.inputs.empty()) {
    auto with_input = with_sample(std::move(arguments.scene));
    if (!with_input) return with_input.error();
    arguments.scene = *std::move(with_input);
  }
  if (const auto filled = fill_plan(arguments, *published, plan); !filled) return filled.error();
  plan.options.seed = console.options().seed;
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
  return *std::move(answer);
}

}  // namespace

void add_touch(Program& program) {
  const auto arguments = std::make_shared<TouchArguments>();
  Options options =
      add_command(program, "touch",
                  "Touch a scene with a device, in the browser or in the terminal; without INPUT the sample",
                  "  palpable touch\n"
                  "  palpable touch left.png right.png\n"
                  "  palpable touch room.palp --law rolling\n"
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
  options.text("--device", arguments->device,
               "Device (palpable devices lists them); default: the page's pointer");
  options.integer("--port", arguments->port, {0, 65535}, "Port of the page on 127.0.0.1; 0 = any free one");
  options.flag("--no-browser", arguments->no_browser, "Do not open the browser");
  options.flag("--headless", arguments->headless, "No page: a scripted hand explores");
  options.flag("--keys", arguments->keys,
               "With --headless: explore with the keys of this terminal; H lists them (braille, speech)");
  add_view_options(options, arguments->view);
  options.flag("--speak", arguments->speak, "Speak faults, names and answers in a headless touch");
  options.number("--seconds", arguments->seconds, {0.01, 86400.0}, "How long a headless touch lasts");
  options.number("--rate", arguments->rate_hz, {100.0, 4000.0},
                 "Servo rate in Hz (1000 unless a paper states another)");
  options.output("--record", arguments->recording, {}, "Record every tick into this file");
}

}  // namespace palpable::cli
