// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/sample_scene.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/input_files.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/session/check/check_recording.hpp"
#include "palpable/session/check/recorded_forces.hpp"
#include "palpable/session/make/make_scene.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

using session::CheckReport;
using session::FindingKind;

struct CheckArguments {
  std::string recording;
  std::vector<std::string> scenes;
  int list = 20;
  bool strict = false;
};

using Scenes = std::vector<std::shared_ptr<const models::Scene>>;

bool is_sample(const std::string& word) { return word.starts_with(kSamplePrefix); }

/// The scene files that the recorded command named, if they still exist, and the samples; the first sample
/// for a touch without an input.
std::vector<std::string> named_scenes(const CheckArguments& arguments,
                                      const session::RecordedSession& session) {
  std::vector<std::string> found;
  const auto beside = std::filesystem::path(arguments.recording).parent_path();
  std::error_code ignored;
  bool has_input = false;
  for (const std::string& word : session.command) {
    const std::filesystem::path path(word);
    const bool is_recording = path.filename() == std::filesystem::path(arguments.recording).filename();
    has_input = has_input || (!is_recording && path.has_extension() && !word.starts_with("-"));
    if (is_sample(word)) found.push_back(word);
    if (path.extension() != ".palp") continue;
    for (const auto& place : {path, beside / path.filename()})
      if (std::filesystem::is_regular_file(place, ignored)) {
        found.push_back(place.string());
        break;
      }
  }
  if (found.empty() && !has_input) found.emplace_back(kFirstSample);
  return found;
}

/// Adds what a touch of this sample makes if it is given no other options.
Result<void> make_sample(const std::string& word, Scenes& scenes, const Work& work) {
  SceneArguments sample;
  sample.make.inputs = {word};
  if (auto resolved = resolve_sample(sample.make, sample.title, sample.material); !resolved) return resolved;
  const auto options = make_options(sample.make);
  if (!options) return options.error();
  Result<void> labelled;
  auto done = session::make_scenes(
      *options,
      [&](recipes::MadeScene made) {
        // A sample's labels and materials are felt too.
        if (auto applied = apply_materials(sample.material, made.scene); !applied)
          labelled = std::move(applied);
        else
          scenes.push_back(std::make_shared<const models::Scene>(std::move(made.scene)));
      },
      work);
  return labelled ? std::move(done) : std::move(labelled);
}

Result<Scenes> read_scenes(const std::vector<std::string>& files, const Work& work) {
  Scenes scenes;
  for (const std::string& file : files) {
    if (is_sample(file)) {
      if (auto made = make_sample(file, scenes, work); !made) return std::move(made).error();
      continue;
    }
    auto scene = read_scene_argument(file);
    if (!scene) return std::move(scene).error();
    scenes.push_back(std::make_shared<const models::Scene>(std::move(scene->scene)));
  }
  return scenes;
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string_view name_of(device::RecordingEnd end) {
  using End = device::RecordingEnd;
  switch (end) {
    case End::complete:
      return "complete";
    case End::cut:
      return "interrupted";
    default:
      return "damaged";
  }
}

/// Whether anything was recomputed; otherwise the forces were not checked.
bool is_judged(const CheckReport& report) { return report.recomputed + report.law_recomputed > 0; }

bool is_clean(const CheckReport& report, const CheckArguments& arguments) {
  return is_judged(report) && report.is_clean() && !(arguments.strict && report.missed > 0);
}

Json finding_json(const session::Finding& finding) {
  return {{"kind", session::name_of(finding.kind)},
          {"problem", session::is_problem(finding.kind)},
          {"first_tick", finding.first_tick},
          {"last_tick", finding.last_tick},
          {"ticks", finding.ticks},
          {"t_s", finding.t_s},
          {"size", number_or_null(finding.size)},
          {"unit", session::unit_of(finding.kind)},
          {"sentence", session::sentence_of(finding)}};
}

Json report_json(const CheckReport& report, const CheckArguments& arguments) {
  Json json{{"clean", is_clean(report, arguments)},
            {"judged", is_judged(report)},
            {"problems", report.problems},
            {"format", report.session.format},
            {"made_by", report.session.made_by},
            {"device", report.session.device_name},
            {"device_url", report.session.device_url},
            {"as_published", report.session.as_published},
            {"rate_hz", report.session.rate_hz},
            {"laws", report.laws},
            {"scene_hashes", report.scene_hashes},
            {"end", name_of(report.end)}};
  json["ticks"] = report.ticks;
  json["further_probes_ticks"] = report.further_ticks;
  json["contact_ticks"] = report.contact_ticks;
  json["seconds"] = report.duration_s;
  json["recomputed"] = {{"ticks", report.recomputed},
                        {"law_only_ticks", report.law_recomputed},
                        {"differing_ticks", report.differing},
                        {"max_difference_N", report.max_difference_N}};
  json["force"] = {{"max_N", report.max_force_N}, {"max_step_N", report.max_step_N}};
  json["energy"] = {{"made_max_J", number_or_null(report.made_max_J)},
                    {"made_max_without_controller_J", number_or_null(report.made_max_without_controller_J)},
                    {"clean_to_J", session::kEnergyMade_J},
                    {"work_made_max_J", number_or_null(report.work_made_max_J)},
                    {"work_since_zero_force_max_J", number_or_null(report.work_since_zero_force_max_J)},
                    {"scene_change_J", number_or_null(report.scene_change_J)}};
  json["missed"] = {{"ticks", report.missed}, {"longest_period_ms", 1e-6 * report.periods.max_ns}};
  json["lost_ticks"] = report.lost;
  json["findings"] = Json::array();
  for (const auto& finding : report.findings) json["findings"].push_back(finding_json(finding));
  json["not_listed"] = report.not_listed;
  return json;
}

std::string recomputed_sentence(const CheckReport& report) {
  if (report.recomputed + report.law_recomputed == 0) return "Recomputed: nothing.";
  std::vector<std::string> parts;
  if (report.recomputed > 0)
    parts.push_back(fmt::format("{} of {} ticks as a whole", report.recomputed, report.ticks));
  if (report.law_recomputed > 0)
    parts.push_back(fmt::format("of {} ticks the law's force alone", report.law_recomputed));
  std::string text = "Recomputed: " + describe::listed(parts);
  text += report.differing == 0 ? "; all are equal to the last bit."
                                : fmt::format("; {} differ, forces by up to {:.3g} N.", report.differing,
                                              report.max_difference_N);
  return text;
}

std::string energy_sentence(const CheckReport& report) {
  const auto by_work = [&] {
    return std::isfinite(report.work_made_max_J)
               ? fmt::format("{:.2g} J by the recorded work alone", report.work_made_max_J)
               : std::string();
  };
  if (!std::isfinite(report.made_max_J))
    return std::isfinite(report.work_made_max_J) ? "Energy made: " + by_work() + "."
                                                 : "Energy made: not known without the scene.";
  std::string text = fmt::format("Energy made: {:.2g} J by the touch's account", report.made_max_J);
  if (const std::string work = by_work(); !work.empty()) text += ", " + work;
  text += fmt::format(" (clean to {:.2g} J, whatever the law).", session::kEnergyMade_J);
  if (report.scene_change_J > 0.0)
    text += fmt::format(" Changes of scene and of parameters brought up to {:.2g} J.", report.scene_change_J);
  return text;
}

std::string text_of(const CheckReport& report, const CheckArguments& arguments) {
  std::string text =
      fmt::format("{}: {:.1f} s, {} ticks at {:.0f} Hz on {}, {} in contact; law {}.\n", arguments.recording,
                  report.duration_s, report.ticks, report.session.rate_hz, report.session.device_name,
                  report.contact_ticks, describe::listed(report.laws));
  text += recomputed_sentence(report) + "\n";
  text += fmt::format("Force: at most {:.2f} N, changed by at most {:.2f} N in a tick. {}\n",
                      report.max_force_N, report.max_step_N, energy_sentence(report));
  text += fmt::format("Periods: median {:.3f} ms, 99.9 % {:.3f} ms, longest {:.3f} ms; {} ticks missed.\n",
                      1e-6 * report.periods.p50_ns, 1e-6 * report.periods.p99_9_ns,
                      1e-6 * report.periods.max_ns, report.missed);
  std::size_t listed = 0;
  for (const bool problems : {true, false})
    for (const auto& finding : report.findings) {
      if (session::is_problem(finding.kind) != problems) continue;
      if (++listed > static_cast<std::size_t>(arguments.list)) continue;
      text += fmt::format("{:8}{}\n", problems ? "problem " : "note ", session::sentence_of(finding));
    }
  const std::uint64_t rest = report.not_listed + (listed > static_cast<std::size_t>(arguments.list)
                                                      ? listed - static_cast<std::size_t>(arguments.list)
                                                      : 0);
  if (rest > 0) text += fmt::format("        and {} more (--list N, --json).\n", rest);
  if (!is_judged(report) && report.is_clean())
    text +=
        "Not judged: no force could be recomputed; name the scene that was touched, if it was one of a "
        "file.\n";
  else if (!is_clean(report, arguments))
    text += "Not clean.\n";
  else
    text += report.end == device::RecordingEnd::cut
                ? "Clean up to its end; the recording was cut off there: its end mark is missing.\n"
                : "Clean.\n";
  return text;
}

Result<Answer> check(const CheckArguments& arguments, Console& console) {
  const auto session = session::read_recorded_session(arguments.recording);
  if (!session) return session.error();
  const auto scenes = read_scenes(
      arguments.scenes.empty() ? named_scenes(arguments, *session) : arguments.scenes, console.work());
  if (!scenes) return scenes.error();
  session::CheckOptions options;
  options.scenes = *scenes;
  const auto report = session::check_recording(arguments.recording, options, console.work());
  if (!report) return report.error();
  Answer answer;
  answer.json = report_json(*report, arguments);
  answer.text = text_of(*report, arguments);
  answer.exit_code = is_clean(*report, arguments) ? 0 : static_cast<int>(ErrorCode::failed);
  return answer;
}

}  // namespace

void add_check(Program& program) {
  const auto arguments = std::make_shared<CheckArguments>();
  Options options = add_command(
      program, "check",
      "Recompute a recording's forces and energy, and list every difference, step and missed tick",
      "  palpable check touch.rec\n"
      "  palpable check touch.rec room.palp\n"
      "  palpable check touch.rec room.palp --json\n"
      "  palpable check touch.rec sample:church\n"
      "Exit code 0: clean; 1: not clean, or nothing could be recomputed. Missed ticks are the machine's and "
      "count only with --strict.",
      [arguments](Console& console) { return check(*arguments, console); });
  options.argument("RECORDING", arguments->recording, "The recording");
  options.optional_arguments(
      "SCENE", arguments->scenes, 1000,
      "The scenes that were touched (.palp, or sample:NAME); default: those that the recorded command names");
  options.integer("--list", arguments->list, {0, 10000}, "Greatest number of findings that are listed");
  options.flag("--strict", arguments->strict, "Missed ticks make a recording not clean too");
}

}  // namespace palpable::cli
