// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/law_options.hpp"
#include "palpable/cli/arguments/path_file.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/cli/commands/bench_field.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct BenchArguments {
  std::string scene, path;
  int passes = 1;
  bool rehearsed = false;
  haptics::Rehearsal rehearsal() const {
    return rehearsed ? haptics::Rehearsal::yes : haptics::Rehearsal::no;
  }
  LawArguments law;
};

struct Benchmark {
  std::string name;
  std::size_t ticks = 0;
  haptics::TickTimes times;
  std::size_t memory_bytes = 0;
};

std::string size_text(const models::Scene& scene) {
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model)) {
    const models::FieldGrid& grid = (*field)->distance.grid();
    const Vec3 size = models::size_m(scene);
    return fmt::format("{:.0f}", std::max({size.x, size.y, size.z}) / grid.cell_m);
  }
  if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model)) {
    const Vec3 size = models::size_m(scene);
    return fmt::format("{:.0f}", std::max({size.x, size.y, size.z}) / (*dense)->distance.cell_m());
  }
  if (const auto* grid = std::get_if<std::shared_ptr<const models::Grid>>(&scene.model)) {
    const auto counts = (*grid)->occupancy.counts();
    return fmt::format("{}x{}x{}", counts[0], counts[1], counts[2]);
  }
  const auto& samples = models::relief_of(scene)->samples_m();
  return fmt::format("{}x{}", samples.width(), samples.height());
}

Result<Benchmark> time_one(const models::Scene& scene, const haptics::LawParameters& parameters,
                           std::span<const haptics::PathSample> path, haptics::Rehearsal rehearsal,
                           int passes = 1) {
  const auto touchable = haptics::make_touchable(scene, parameters);
  if (!touchable) return touchable.error();
  Benchmark benchmark;
  benchmark.name =
      fmt::format("{}/{}/{}", models::kind_of(scene.model), bench_name(parameters, scene), size_text(scene));
  benchmark.ticks = path.size();
  benchmark.times = haptics::time_path(**touchable, path, passes, rehearsal);
  benchmark.memory_bytes = std::visit([](const auto& model) { return model->memory_bytes(); }, scene.model);
  return benchmark;
}

/// Times laws with their defaults, one after the other.
Result<void> time_laws(const models::Scene& scene, const std::vector<haptics::Law>& laws,
                       const std::vector<haptics::PathSample>& path, haptics::Rehearsal rehearsal,
                       std::vector<Benchmark>& benchmarks) {
  for (const haptics::Law law : laws) {
    haptics::LawParameters parameters;
    parameters.law = law;
    if (interrupted()) return Work::interrupted();
    auto benchmark = time_one(scene, parameters, path, rehearsal);
    if (!benchmark) return benchmark.error();
    benchmarks.push_back(std::move(*benchmark));
  }
  return {};
}

/// The built-in surface: hills, a ridge and a step of 100 x 75 mm, 640 x 480 samples, 15 mm high.
Result<models::Scene> own_scene() {
  constexpr int kWidth = 640, kHeight = 480;
  Raster<float> height_m(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double u = static_cast<double>(x) / kWidth, v = static_cast<double>(y) / kHeight;
      const double hills =
          0.5 + 0.25 * std::sin(9.0 * u + 2.0) * std::cos(7.0 * v) + 0.1 * std::sin(31.0 * u * v);
      const double step = 0.1 * std::tanh(40.0 * (u - 0.7)),
                   ridge = 0.15 * std::exp(-std::pow(25.0 * (v - 0.4), 2.0));
      height_m(x, y) = static_cast<float>(0.015 * (hills + step + ridge));
    }
  }
  auto relief = models::Relief::from_samples(std::move(height_m), 0.1 / kWidth);
  if (!relief) return relief.error();
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(std::move(*relief));
  return scene;
}

/// A Lissajous figure over 86 % of the relief, half a millimetre below its surface: sliding in contact.
std::vector<haptics::PathSample> own_path(const models::Scene& scene) {
  constexpr int kTicks = 60000;
  constexpr double kTick_s = 0.001, kUnder_m = 0.0005;
  const models::Relief& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  std::vector<haptics::PathSample> path;
  path.reserve(kTicks);
  for (int i = 0; i < kTicks; ++i) {
    const double t = i * kTick_s;
    const double x = 0.43 * relief.size_x_m() * std::sin(2.0 * std::numbers::pi * 0.31 * t);
    const double y = 0.43 * relief.size_y_m() * std::sin(2.0 * std::numbers::pi * 0.47 * t);
    path.push_back({t, {{x, y, relief.sample(x, y).z_m - kUnder_m}}});
  }
  return path;
}

/// The field alone, then every law on it that moves in space.
Result<void> add_field_set(haptics::Rehearsal rehearsal, std::vector<Benchmark>& benchmarks,
                           const Work& work) {
  const auto scene = own_field_scene(work);
  if (!scene) return scene.error();
  const auto& field = *std::get<std::shared_ptr<const models::Field>>(scene->model);
  const auto path = own_field_path(field.distance);
  benchmarks.push_back({fmt::format("field/value-gradient/{}", size_text(*scene)), path.size(),
                        time_samples(field.distance, path), field.distance.memory_bytes()});
  return time_laws(*scene, {haptics::Law::proxy, haptics::Law::penalty}, path, rehearsal, benchmarks);
}

Result<std::vector<Benchmark>> own_set(haptics::Rehearsal rehearsal, const Work& work) {
  const auto scene = own_scene();
  if (!scene) return scene.error();
  const auto path = own_path(*scene);
  std::vector<Benchmark> benchmarks;
  if (auto timed = time_laws(*scene, haptics::laws_for(*scene), path, rehearsal, benchmarks); !timed)
    return timed.error();
  // The settings of a fingertip on the page: a ball of 1 mm, friction and a texture.
  models::Scene textured = *scene;
  textured.materials.front().texture.kind = models::TouchTexture::Kind::grain;
  haptics::LawParameters fingertip;
  fingertip.radius_m = 0.001;
  auto benchmark = time_one(textured, fingertip, path, rehearsal);
  if (!benchmark) return benchmark.error();
  benchmarks.push_back(std::move(*benchmark));
  if (const auto added = add_field_set(rehearsal, benchmarks, work); !added) return added.error();
  return benchmarks;
}

Result<std::vector<Benchmark>> given_set(const BenchArguments& arguments, Console& console) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  const auto path = read_path(arguments.path);
  if (!path) return path.error();
  const auto parameters = law_parameters(arguments.law, scene);
  if (!parameters) return parameters.error();
  if (const auto unused = note_on_unused(arguments.law, parameters->law)) console.note(*unused);
  auto benchmark = time_one(scene, *parameters, *path, arguments.rehearsal(), arguments.passes);
  if (!benchmark) return benchmark.error();
  return std::vector{std::move(*benchmark)};
}

Answer answer_of(const std::vector<Benchmark>& benchmarks) {
  Answer answer;
  answer.json["benchmarks"] = Json::array();
  answer.text = fmt::format("{:40}{:>9}{:>10}{:>11}{:>9}{:>11}{:>10}\n", "", "ticks", "contact", "median ns",
                            "p99 ns", "p99.9 ns", "max ns");
  for (const Benchmark& b : benchmarks) {
    const haptics::LatencySummary& l = b.times.latency;
    answer.json["benchmarks"].push_back({{"name", b.name},
                                         {"ticks", b.ticks},
                                         {"contact_fraction", b.times.contact_fraction},
                                         {"median_ns", l.p50_ns},
                                         {"p99_ns", l.p99_ns},
                                         {"p99_9_ns", l.p99_9_ns},
                                         {"max_ns", l.max_ns},
                                         {"memory_bytes", b.memory_bytes}});
    answer.text += fmt::format("{:40}{:>9}{:>9.1f}%{:>11.1f}{:>9.1f}{:>11.1f}{:>10.0f}\n", b.name, b.ticks,
                               100.0 * b.times.contact_fraction, l.p50_ns, l.p99_ns, l.p99_9_ns, l.max_ns);
  }
  return answer;
}

Result<Answer> bench(const BenchArguments& arguments, Console& console) {
  if (arguments.scene.empty() != arguments.path.empty())
    return Error{ErrorCode::usage, "give --scene and --path together", {}};
  if (arguments.scene.empty() && arguments.passes > 1)
    return Error{ErrorCode::usage, "--passes needs --scene and --path", {}};
  if (arguments.scene.empty() && !arguments.law.law.empty())
    return Error{ErrorCode::usage, "--law needs --scene and --path; without them every law is timed", {}};
  const auto benchmarks = arguments.scene.empty() ? own_set(arguments.rehearsal(), console.work())
                                                  : given_set(arguments, console);
  if (!benchmarks) return benchmarks.error();
  return answer_of(*benchmarks);
}

}  // namespace

void add_bench(Program& program) {
  const auto arguments = std::make_shared<BenchArguments>();
  Options options =
      add_command(program, "bench",
                  "Time the force computation tick by tick; without options, every law on a built-in surface",
                  "  palpable bench\n"
                  "  palpable bench --scene aloe.palp --path path.csv --law proxy --radius 1",
                  [arguments](Console& console) { return bench(*arguments, console); });
  options.text("--scene", arguments->scene, "A .palp scene");
  options.text("--path", arguments->path, "CSV with the columns t_s,x_m,y_m,z_m (scene frame, metres)");
  options.integer("--passes", arguments->passes, {1, 1000},
                  "Time each tick in this many passes over the path, and take its least time");
  options.flag("--rehearsed", arguments->rehearsed,
               "Before each timed tick, evaluate the one that is expected, as a touch does while it waits");
  add_law_options(options, arguments->law);
}

}  // namespace palpable::cli
