// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "reliability.hpp"
#include "stereo_scenes.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

// Runs stereo methods over the tuning set (stereo_scenes.hpp) and reports bad pixels by kind of scene:
//
//   palpable_stereo_set [--methods best,fast] [--seeds N] [--kinds rods,plain] [--set NAME=VALUE]…
//                       [--from-seed N] [--threads N] [--json FILE] [--dump FOLDER]
//                       [--sheet FILE.png] [--sheet-method M]
//
// With --from-seed the seeds from N on, also of the kinds that only the confidence is calibrated on, and a
// table of its reliability (reliability.hpp).
// --dump writes each scene's pictures, truth, what both cameras see, the results and their confidence into
// the folder.
// --sheet writes a picture of all scenes, each with its truth and, with --sheet-method, that method's result.
namespace palpable::bench {
namespace {

struct Arguments {
  std::vector<std::string> methods{"best"};
  std::vector<std::string> kinds;
  std::vector<std::string> parameters;
  int seeds = 4, first_seed = 0;
  unsigned threads = 1;
  std::string json, dump, sheet, sheet_method;
};

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> out;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    out.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

/// Percentages of pixels with an error above 0.5, 1 and 2 px, among those that both cameras see; and above 1
/// px, among all pixels.
struct Score {
  double half = 0.0, one = 0.0, two = 0.0, all = 0.0;
  int scenes = 0;

  void add(const Score& other) {
    half += other.half;
    one += other.one;
    two += other.two;
    all += other.all;
    scenes += other.scenes;
  }
  Score mean() const { return {half / scenes, one / scenes, two / scenes, all / scenes, scenes}; }
};

Score score_of(const StereoScene& scene, const Raster<float>& disparity_px) {
  int seen = 0, half = 0, one = 0, two = 0, all = 0;
  for (std::size_t i = 0; i < disparity_px.count(); ++i) {
    const float error = std::fabs(disparity_px.values()[i] - scene.truth_px.values()[i]);
    all += error <= 1.0F ? 0 : 1;
    if (scene.seen_by_both.values()[i] == 0) continue;
    ++seen;
    half += error <= 0.5F ? 0 : 1;
    one += error <= 1.0F ? 0 : 1;
    two += error <= 2.0F ? 0 : 1;
  }
  return {100.0 * half / seen, 100.0 * one / seen, 100.0 * two / seen,
          100.0 * all / static_cast<double>(disparity_px.count()), 1};
}

nlohmann::ordered_json json_of(const Score& s) {
  return {
      {"bad_0.5", s.half}, {"bad_1", s.one}, {"bad_2", s.two}, {"bad_1_all", s.all}, {"scenes", s.scenes}};
}

void set_parameters(const Arguments& arguments, vision::StereoMethod method, vision::StereoOptions& options) {
  for (const std::string& given : arguments.parameters) {
    const std::vector<std::string> words = parts_of(given, '=');
    double value = 0.0;
    bool known = words.size() == 2 &&
                 std::from_chars(words[1].data(), words[1].data() + words[1].size(), value).ec == std::errc{};
    bool found = false;
    for (const Parameter& p : vision::parameters_of(options, method))
      if (known && p.name == words[0]) found = set_parameter(p, value).has_value();
    if (!found)
      fmt::print(stderr, "{} has no parameter {}, or it may not have this value\n", vision::name_of(method),
                 given);
  }
}

void report_failure(const Result<void>& written) {
  if (!written) fmt::print(stderr, "{}\n", written.error().sentence());
}

/// FOLDER/SCENE.left.png, .right.png, .truth.pfm (px) and .seen.pfm (0 or 1).
void dump_scenes(const std::string& folder, const std::vector<StereoScene>& scenes) {
  for (const StereoScene& scene : scenes) {
    const std::string name = folder + "/" + scene.name;
    Raster<float> seen(scene.truth_px.width(), scene.truth_px.height());
    std::copy(scene.seen_by_both.values().begin(), scene.seen_by_both.values().end(), seen.values().begin());
    report_failure(formats::write_png(name + ".left.png", rgb8(scene.pair.left)));
    report_failure(formats::write_png(name + ".right.png", rgb8(scene.pair.right)));
    report_failure(formats::write_pfm(name + ".truth.pfm", scene.truth_px));
    report_failure(formats::write_pfm(name + ".seen.pfm", seen));
  }
}

/// Runs one method over the set: prints rows of a table and returns them as JSON.
nlohmann::ordered_json run(const std::string& name, const std::vector<StereoScene>& scenes,
                           const Arguments& arguments) {
  nlohmann::ordered_json out;
  const auto method = vision::stereo_method_from(name);
  if (!method) {
    fmt::print(stderr, "there is no method {}\n", name);
    return out;
  }
  vision::StereoOptions options;
  set_parameters(arguments, *method, options);
  Work work;
  work.threads = arguments.threads;
  std::vector<Score> by_kind(kAllSceneKinds);
  Score total;
  Reliability reliability;
  const std::clock_t begin = std::clock();
  for (const StereoScene& scene : scenes) {
    const auto match = vision::match(scene.pair, *method, options, work);
    if (!match) {
      fmt::print(stderr, "{}: {}\n", scene.name, match.error().sentence());
      continue;
    }
    if (!arguments.dump.empty())
      report_failure(formats::write_pfm(fmt::format("{}/{}.{}.pfm", arguments.dump, scene.name, name),
                                        match->disparity.disparity_px));
    if (!arguments.dump.empty() && !match->confidence.empty())
      report_failure(formats::write_pfm(
          fmt::format("{}/{}.{}.confidence.pfm", arguments.dump, scene.name, name), match->confidence));
    const Score score = score_of(scene, match->disparity.disparity_px);
    by_kind[static_cast<std::size_t>(scene.kind)].add(score);
    total.add(score);
    reliability.add(scene, match->disparity.disparity_px, match->confidence);
    out["scenes"][scene.name] = json_of(score);
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  fmt::print("{:<10} {:<11} {:>8} {:>8} {:>8} {:>8}\n", name, "kind", "bad 0.5", "bad 1", "bad 2", "all, 1");
  for (int k = 0; k < kAllSceneKinds; ++k) {
    if (by_kind[static_cast<std::size_t>(k)].scenes == 0) continue;
    const Score mean = by_kind[static_cast<std::size_t>(k)].mean();
    out["kinds"][std::string(name_of(static_cast<SceneKind>(k)))] = json_of(mean);
    fmt::print("{:<10} {:<11} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f}\n", "", name_of(static_cast<SceneKind>(k)),
               mean.half, mean.one, mean.two, mean.all);
  }
  const Score mean = total.mean();
  out["overall"] = json_of(mean);
  if (arguments.first_seed > 0) fmt::print("{}", reliability.table());
  out["processor_seconds"] = seconds;
  fmt::print("{:<10} {:<11} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f}   {} scenes, {:.0f} s of processor time\n",
             "", "overall", mean.half, mean.one, mean.two, mean.all, mean.scenes, seconds);
  return out;
}

/// A picture with every scene at half its size: left picture, truth and, if a method is given, its result.
Result<void> write_sheet(const Arguments& arguments, const std::vector<StereoScene>& scenes) {
  const auto method = vision::stereo_method_from(arguments.sheet_method);
  const int panels = method ? 3 : 2, columns = method ? 3 : 4;
  const int width = scenes.front().truth_px.width() / 2, height = scenes.front().truth_px.height() / 2;
  const int rows = (static_cast<int>(scenes.size()) + columns - 1) / columns;
  Raster<Rgb8> sheet(columns * (panels * width + 6), rows * (height + 6), Rgb8{255, 255, 255});
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const StereoScene& scene = scenes[i];
    const int x0 = static_cast<int>(i) % columns * (panels * width + 6),
              y0 = static_cast<int>(i) / columns * (height + 6);
    const auto grey = [](float d) {
      const auto level = static_cast<std::uint8_t>(std::clamp(d * 5.0F, 0.0F, 255.0F));
      return Rgb8{level, level, level};
    };
    Raster<float> found;
    if (method) {
      auto match = vision::match(scene.pair, *method, {}, {});
      if (!match) return match.error();
      found = std::move(match->disparity.disparity_px);
    }
    const Raster<Rgb8> left = rgb8(scene.pair.left);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        sheet(x0 + x, y0 + y) = left(2 * x, 2 * y);
        sheet(x0 + width + x, y0 + y) =
            scene.seen_by_both(2 * x, 2 * y) != 0 ? grey(scene.truth_px(2 * x, 2 * y)) : Rgb8{120, 0, 0};
        if (method) sheet(x0 + 2 * width + x, y0 + y) = grey(found(2 * x, 2 * y));
      }
  }
  return formats::write_png(arguments.sheet, sheet);
}

std::optional<Arguments> parsed(int count, char** words) {
  Arguments out;
  for (int i = 1; i < count; ++i) {
    const std::string name = words[i];
    if (i + 1 == count) return std::nullopt;
    const std::string value = words[++i];
    if (name == "--methods")
      out.methods = parts_of(value, ',');
    else if (name == "--kinds")
      out.kinds = parts_of(value, ',');
    else if (name == "--set")
      out.parameters.push_back(value);
    else if (name == "--seeds")
      out.seeds = std::stoi(value);
    else if (name == "--from-seed")
      out.first_seed = std::stoi(value);
    else if (name == "--threads")
      out.threads = static_cast<unsigned>(std::stoul(value));
    else if (name == "--json")
      out.json = value;
    else if (name == "--dump")
      out.dump = value;
    else if (name == "--sheet")
      out.sheet = value;
    else if (name == "--sheet-method")
      out.sheet_method = value;
    else
      return std::nullopt;
  }
  return out;
}

int main_program(int count, char** words) {
  const auto arguments = parsed(count, words);
  if (!arguments) {
    fmt::print(stderr, "see the head of bench/stereo_set.cpp for the options\n");
    return 2;
  }
  std::vector<StereoScene> scenes =
      arguments->first_seed > 0
          ? confidence_set(arguments->first_seed, arguments->first_seed + arguments->seeds - 1)
          : tuning_set(arguments->seeds);
  if (!arguments->kinds.empty())
    std::erase_if(scenes, [&](const StereoScene& scene) {
      return std::find(arguments->kinds.begin(), arguments->kinds.end(), name_of(scene.kind)) ==
             arguments->kinds.end();
    });
  if (scenes.empty()) return 2;
  if (!arguments->sheet.empty()) {
    const auto written = write_sheet(*arguments, scenes);
    if (!written) fmt::print(stderr, "{}\n", written.error().sentence());
    return written ? 0 : 1;
  }
  if (!arguments->dump.empty()) dump_scenes(arguments->dump, scenes);
  nlohmann::ordered_json all;
  all["seeds_per_kind"] = arguments->seeds;
  all["parameters"] = arguments->parameters;
  for (const std::string& method : arguments->methods)
    all["methods"][method] = run(method, scenes, *arguments);
  if (!arguments->json.empty()) std::ofstream(arguments->json) << all.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::main_program(count, words); }
