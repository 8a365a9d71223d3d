// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/text/number_table.hpp"
#include "palpable/formats/picture/picture.hpp"
#include "palpable/study/simulated/tracing_study.hpp"

#include <array>
#include <filesystem>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct StudyTracingArguments {
  int tracers = 20;
  int repeats = 3;
  double force_N = study::TracingStudyOptions{}.law.force_N;
  double neighbourhood_px = study::TracingStudyOptions{}.neighbourhood_px;
  std::optional<double> speed_mm_per_s;
  bool sensitivity = false;
  std::string pictures;
};

/// Means of the paper's twenty people: seconds and percent of the area.
struct People {
  std::string_view figure;
  double seconds_without;
  double seconds_with;
  double error_without;
  double error_with;
};
constexpr std::array kPeople{People{"rectangle", 26.12, 20.2, 0.647, 0.508},
                             People{"letter-h", 35.32, 27.9, 0.347, 0.294},
                             People{"ultrasound", 7.25, 4.85, 0.299, 0.224}};

constexpr const char* kCaution =
    "A simulation: these are figures of a model of a hand, not of people. The people are the paper's.";

study::TracingStudyOptions options_of(const StudyTracingArguments& arguments) {
  study::TracingStudyOptions options;
  options.tracers = arguments.tracers;
  options.repeats = arguments.repeats;
  options.law.force_N = arguments.force_N;
  options.neighbourhood_px = arguments.neighbourhood_px;
  if (arguments.speed_mm_per_s) options.tracer.speed_m_per_s = *arguments.speed_mm_per_s / 1000.0;
  return options;
}

struct Compared {
  study::TracingSummary without;
  study::TracingSummary with;
};

Result<Compared> compare(const study::TracedFigure& figure, const study::TracingStudyOptions& options,
                         const Work& work) {
  auto without = study::study_tracing(figure, options, study::Assistance::none, work);
  if (!without) return without.error();
  auto with = study::study_tracing(figure, options, study::Assistance::tracing, work);
  if (!with) return with.error();
  return Compared{*without, *with};
}

double percent(double with, double without) { return 100.0 * (with / without - 1.0); }

Json json_of(const study::TracingSummary& s) {
  return {{"traces", s.traces},
          {"unfinished", s.unfinished},
          {"restless", s.restless},
          {"seconds", {s.seconds.mean, s.seconds.deviation}},
          {"error_percent", {100.0 * s.error.mean, 100.0 * s.error.deviation}},
          {"roughness_deg_per_mm", {s.roughness_deg_per_mm.mean, s.roughness_deg_per_mm.deviation}},
          {"fastest_pushed_m_per_s", s.fastest_pushed_m_per_s},
          {"tank_least_J", s.tank_least_J},
          {"resting_N", s.resting_N}};
}

/// A change of one parameter of the model, to a smaller and a greater value.
struct Change {
  const char* what;
  void (*make)(study::TracingStudyOptions& options, double factor);
};
constexpr std::array kChanges{
    Change{"speed", [](study::TracingStudyOptions& o, double f) { o.tracer.speed_m_per_s *= f; }},
    Change{"delay", [](study::TracingStudyOptions& o, double f) { o.tracer.delay_s *= f; }},
    Change{"interval",
           [](study::TracingStudyOptions& o, double f) {
             o.tracer.interval_s *= f;
             o.tracer.duration_s *= f;
           }},
    Change{"motor noise", [](study::TracingStudyOptions& o, double f) { o.tracer.motor_noise *= f; }},
    Change{"visual noise", [](study::TracingStudyOptions& o, double f) { o.tracer.visual_noise_m *= f; }},
    Change{"correction", [](study::TracingStudyOptions& o, double f) { o.tracer.correction *= f; }},
    Change{"compliance",
           [](study::TracingStudyOptions& o, double f) { o.tracer.compliance *= f < 1.0 ? 0.0 : 0.5; }},
    Change{"force F_m", [](study::TracingStudyOptions& o, double f) { o.law.force_N *= f; }}};

/// The sensitivity of the gains on the rectangle to each parameter.
Result<void> add_sensitivity(const study::TracedFigure& rectangle, const study::TracingStudyOptions& options,
                             const Work& work, Answer& answer) {
  answer.json["sensitivity"] = Json::array();
  answer.text +=
      fmt::format("\nOn the rectangle, one value changed at a time\n{:22}{:>10}{:>10}{:>10}{:>10}\n", "",
                  "s without", "s with", "time %", "error %");
  for (const Change& change : kChanges)
    for (const double factor : {0.5, 2.0}) {
      study::TracingStudyOptions other = options;
      change.make(other, factor);
      work.report(0.0, "sensitivity");
      const auto compared = compare(rectangle, other, work);
      if (!compared) return compared.error();
      const bool is_compliance = std::string_view(change.what) == "compliance";
      const std::string name =
          fmt::format("{} {}", change.what,
                      is_compliance ? (factor < 1.0 ? "= 0" : "= 0.5") : fmt::format("x {:g}", factor));
      const double time = percent(compared->with.seconds.mean, compared->without.seconds.mean);
      const double error = percent(compared->with.error.mean, compared->without.error.mean);
      answer.json["sensitivity"].push_back(
          {{"changed", name}, {"without", json_of(compared->without)}, {"with", json_of(compared->with)}});
      answer.text += fmt::format("{:22}{:>10.1f}{:>10.1f}{:>+10.1f}{:>+10.1f}\n", name,
                                 compared->without.seconds.mean, compared->with.seconds.mean, time, error);
    }
  return {};
}

Result<void> write_figures(const std::string& folder, std::uint64_t seed) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Error{ErrorCode::invalid_input, "cannot be made: " + error.message(), folder};
  for (const auto& figure : study::all_tracing_figures(seed)) {
    const auto base = std::filesystem::path(folder) / figure.name;
    if (auto written = formats::write_png(base.string() + ".png", figure.picture); !written) return written;
    std::string csv = "x_px,y_px,x_m,y_m\n";
    for (const Vec3& p : figure.nominal) {
      append_number(csv, p.x / figure.pixel_m + 0.5 * (figure.picture.width() - 1));
      csv += ',';
      append_number(csv, 0.5 * (figure.picture.height() - 1) - p.y / figure.pixel_m);
      csv += ',';
      append_number(csv, p.x);
      csv += ',';
      append_number(csv, p.y);
      csv += '\n';
    }
    if (auto written = write_file_atomically(base.string() + ".csv", std::as_bytes(std::span(csv))); !written)
      return written;
  }
  return {};
}

Result<Answer> study_figures(const StudyTracingArguments& arguments, const Work& work) {
  const auto options = options_of(arguments);
  Answer answer;
  answer.json = {{"simulation", true}, {"caution", kCaution}, {"figures", Json::array()}};
  answer.text =
      fmt::format("{}\n\n{:12}{:>22}{:>22}{:>9}{:>9}{:>22}\n", kCaution, "", "seconds without, with",
                  "error % without, with", "time %", "error %", "people: time, error %");
  const Work quiet{work.threads, work.seed, {}, work.cancel};
  std::array figures{study::rectangle_figure(), study::letter_h_figure(),
                     study::ultrasound_figure(work.seed)};
  for (std::size_t k = 0; k < figures.size(); ++k) {
    work.report(static_cast<double>(k) / static_cast<double>(figures.size()), "tracing");
    const auto figure = study::prepare_figure(std::move(figures[k]), options.neighbourhood_px, quiet);
    if (!figure) return figure.error();
    const auto compared = compare(*figure, options, quiet);
    if (!compared) return compared.error();
    const People& people = kPeople[k];
    const auto& [without, with] = *compared;
    answer.json["figures"].push_back({{"name", figure->figure.name},
                                      {"without", json_of(without)},
                                      {"with", json_of(with)},
                                      {"people",
                                       {{"seconds", {people.seconds_without, people.seconds_with}},
                                        {"error_percent", {people.error_without, people.error_with}}}}});
    answer.text += fmt::format(
        "{:12}{:>15.2f} {:>6.2f}{:>15.2f} {:>6.2f}{:>+9.1f}{:>+9.1f}{:>+15.1f} {:>+6.1f}\n",
        figure->figure.name, without.seconds.mean, with.seconds.mean, 100.0 * without.error.mean,
        100.0 * with.error.mean, percent(with.seconds.mean, without.seconds.mean),
        percent(with.error.mean, without.error.mean), percent(people.seconds_with, people.seconds_without),
        percent(people.error_with, people.error_without));
    if (with.restless > 0)
      answer.text += fmt::format("{:12}{} of {} hands kept oscillating along the line after the trace\n", "",
                                 with.restless, with.traces);
    if (k == 0 && arguments.sensitivity)
      if (const auto added = add_sensitivity(*figure, options, quiet, answer); !added) return added.error();
  }
  return answer;
}

Result<Answer> run_study(const StudyTracingArguments& arguments, const Work& work) {
  if (arguments.pictures.empty()) return study_figures(arguments, work);
  if (const auto written = write_figures(arguments.pictures, work.seed); !written) return written.error();
  Answer answer;
  answer.json["pictures"] = arguments.pictures;
  answer.text =
      fmt::format("The paper's pictures, each with its nominal line, are in {}\n", arguments.pictures);
  return answer;
}

}  // namespace

void add_study_tracing(Program& program) {
  const auto arguments = std::make_shared<StudyTracingArguments>();
  Options options = add_command(
      program, "study-tracing",
      "Tracing with and without assistance by simulated hands (a simulation, no evidence about people)",
      "  palpable study-tracing\n"
      "  palpable study-tracing --sensitivity --tracers 10\n"
      "  palpable study-tracing --pictures FOLDER",
      [arguments](Console& console) { return run_study(*arguments, console.work()); });
  options.integer("--tracers", arguments->tracers, {1, 1000},
                  "Number of simulated hands, each with slightly different parameters");
  options.integer("--repeats", arguments->repeats, {1, 100}, "Traces of each hand, in both directions");
  options.number("--force", arguments->force_N, {0.0, 5.0}, "F_m, newtons");
  options.number("--neighbourhood", arguments->neighbourhood_px, {1.0, 32.0}, "m, px");
  options.number("--speed", arguments->speed_mm_per_s, {0.1, 200.0}, "Speed that the hands aim at, mm/s");
  options.flag("--sensitivity", arguments->sensitivity,
               "Also change each parameter of the model, one at a time");
  options.output_folder(
      "--pictures", arguments->pictures,
      "Only write the paper's pictures and their nominal lines (PNG, CSV) into this folder");
}

}  // namespace palpable::cli
