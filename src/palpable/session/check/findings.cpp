// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/findings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

struct FindingWords {
  std::string_view name;
  std::string_view unit;
  bool is_problem;
  /// The first {} stands for the size, the second for the time in ms that a force was held.
  std::string_view sentence;
};
constexpr std::array<FindingWords, kFindingKinds> kFindingWords{{
    {"law-force", "N", true, "the law's force differs from the recomputed one by {:.3g} N"},
    {"written-force", "N", true, "the written force differs from the recomputed one by {:.3g} N"},
    {"energy-balance", "J", true, "the energy balance differs from the recomputed one by {:.3g} J"},
    {"state", "", true,
     "other values of the ticks (position, velocity, proxy, flags) differ from the recomputed ones"},
    {"force-step", "N", true, "the force grew by {:.3g} N more than the rise limit allows"},
    {"force-cap", "N", true, "the force was {:.3g} N above the device's greatest"},
    {"not-finite", "", true, "a force was written that is not a finite number"},
    {"held-force", "N", true, "a force of {:.3g} N was held for {:.3g} ms without a tick"},
    {"free-air-force", "N", true, "{:.3g} N were written while the hand did not touch the surface"},
    {"energy-made", "J", true, "the hand received {:.3g} J more than it gave"},
    {"damage", "", true, "the file is damaged"},
    {"lost-ticks", "ticks", true, "{:.0f} ticks are missing in the file"},
    {"missed-ticks", "ticks", false, "up to {:.0f} ticks in a row were missed because the machine was busy"},
    {"interrupted", "", false, "the recording was cut off after this tick"},
    {"not-recomputed", "", false, "not recomputed as a whole"},
}};

const FindingWords& words_of(FindingKind kind) { return kFindingWords[static_cast<std::size_t>(kind)]; }

}  // namespace

std::string_view name_of(FindingKind kind) { return words_of(kind).name; }
bool is_problem(FindingKind kind) { return words_of(kind).is_problem; }
std::string_view unit_of(FindingKind kind) { return words_of(kind).unit; }

std::string sentence_of(const Finding& finding) {
  const std::string where =
      finding.ticks < 2 ? fmt::format("Tick {} ({:.3f} s)", finding.first_tick, finding.t_s)
                        : fmt::format("Ticks {} to {} (from {:.3f} s, {} of them)", finding.first_tick,
                                      finding.last_tick, finding.t_s, finding.ticks);
  const std::string what =
      std::isfinite(finding.size)
          ? fmt::format(fmt::runtime(words_of(finding.kind).sentence), finding.size, 1e3 * finding.held_s)
          : fmt::format("{}: one of the two values is not a finite number", words_of(finding.kind).name);
  return fmt::format("{}: {}{}{}.", where, what, finding.detail.empty() ? "" : ": ", finding.detail);
}

void Findings::add(FindingKind kind, const device::TouchSample& at, double size, std::string_view detail,
                   double held_s) {
  const auto index = static_cast<std::size_t>(kind);
  ++counts_[index];
  Finding& open = open_[index];
  if (open.ticks > 0 && (at.tick > open.last_tick + kTogether || detail != open.detail)) close(open);
  if (open.ticks == 0) open = {kind, at.tick, at.tick, at.t_s, 0, size, held_s, std::string(detail)};
  open.last_tick = at.tick;
  ++open.ticks;
  open.size = std::max(open.size, size);
  open.held_s = std::max(open.held_s, held_s);
}

void Findings::close(Finding& finding) {
  if (finding.ticks == 0) return;
  auto& kept = kept_of_[static_cast<std::size_t>(finding.kind)];
  if (kept < most_of_a_kind_) {
    ++kept;
    kept_.push_back(std::move(finding));
  } else {
    ++not_kept_;
  }
  finding = {};
}

std::vector<Finding> Findings::take() {
  for (Finding& finding : open_) close(finding);
  std::stable_sort(kept_.begin(), kept_.end(),
                   [](const Finding& a, const Finding& b) { return a.first_tick < b.first_tick; });
  return std::exchange(kept_, {});
}

}  // namespace palpable::session
