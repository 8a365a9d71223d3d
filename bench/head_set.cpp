// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The head of simulated viewers, found in the pictures of a depth camera, beside the truth:
// palpable_head_set [FIRST LAST] [DOWN] [WIDTH] [places]; the viewers' seeds, degrees by which the camera
// looks down, and pixels of a row. With `places`: a line for each picture (seed, time in s, eyes' place in m
// as the page is told it, and the truth; empty where none was found), which web/scripts/depth_head.mjs reads.
#include "palpable/core/text/number_text.hpp"
#include "palpable/study/world/viewer.hpp"
#include "palpable/vision/depth_camera/head_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

constexpr double kRate_hz = 30.0;

struct Found {
  double time_s = 0.0;
  std::optional<Point<vision::LevelFrame>> eyes;
  Point<vision::LevelFrame> truth;
};

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string place_text(Point<vision::LevelFrame> p) {
  return fmt::format("{:.6f} {:.6f} {:.6f}", -p.v.x, -p.v.y, p.v.z);
}

/// Of the errors: root mean squares, mm.
void print(std::uint64_t seed, const std::vector<Found>& all, double cost_ms) {
  int found = 0, hidden = 0, hidden_found = 0;
  Vec3 squares;
  double worst_m = 0.0;
  for (const Found& one : all) {
    const bool is_hidden = one.time_s >= study::Viewer::kHidden_s;
    if (is_hidden) {
      ++hidden;
      hidden_found += one.eyes ? 1 : 0;
    }
    if (!one.eyes || is_hidden) continue;
    ++found;
    const Vec3 error = (*one.eyes - one.truth).v;
    squares += Vec3{error.x * error.x, error.y * error.y, error.z * error.z};
    worst_m = std::max(worst_m, norm(error));
  }
  const int open = static_cast<int>(all.size()) - hidden;
  const auto rms = [&](double square) { return 1000.0 * std::sqrt(square / std::max(1, found)); };
  fmt::print(
      "{:4} found {:6.2f} % of {} | error x {:4.1f} y {:4.1f} z {:4.1f} mm, worst {:5.1f} | hand before the "
      "face: "
      "found {:5.1f} % of {} | {:.2f} ms a picture\n",
      seed, 100.0 * found / open, open, rms(squares.x), rms(squares.y), rms(squares.z), 1000.0 * worst_m,
      100.0 * hidden_found / std::max(1, hidden), hidden, cost_ms);
  std::fflush(stdout);
}

void run_viewer(const study::ViewerOptions& options, bool prints_places) {
  study::Viewer viewer(options);
  vision::HeadFinder finder;
  std::vector<Found> all;
  double spent_s = 0.0;
  for (double time_s = 0.0; time_s < study::Viewer::kSeconds; time_s += 1.0 / kRate_hz) {
    const auto pose = viewer.pose_at(time_s);
    const auto depth_m = viewer.depth(pose);
    const double begin_s = processor_s();
    const auto head = finder.find(depth_m, {options.camera, options.down_rad});
    spent_s += processor_s() - begin_s;
    Found one{time_s, {}, viewer.eyes(pose)};
    if (head) one.eyes = head->eyes;
    all.push_back(one);
  }
  if (!prints_places) return print(options.seed, all, 1000.0 * spent_s / static_cast<double>(all.size()));
  for (const Found& one : all)
    fmt::print("{} {:.6f} {} {}\n", options.seed, one.time_s, place_text(one.truth),
               one.eyes ? place_text(*one.eyes) : "");
}

int run(int count, const char* const* words) {
  const auto number = [&](int k, const char* usual) { return whole_number(count > k ? words[k] : usual); };
  const auto first = number(1, "201"), last = number(2, "210"), down = number(3, "0"),
             width = number(4, "640");
  const bool prints_places = count > 5 && std::string_view(words[5]) == "places";
  if (!first || !last || !down || !width || *first < 0 || *last < *first || *width < 80) {
    fmt::print(stderr, "palpable_head_set [FIRST LAST] [DOWN] [WIDTH] [places]\n");
    return 2;
  }
  const int w = static_cast<int>(*width), h = 3 * w / 4;
  // The angle of view of a camera with structured light.
  const double f = 0.89 * w;
  for (auto seed = *first; seed <= *last; ++seed)
    run_viewer({static_cast<std::uint64_t>(seed),
                {f, f, (w - 1) / 2.0, (h - 1) / 2.0, w, h},
                static_cast<double>(*down) * std::numbers::pi / 180.0},
               prints_places);
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
