// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/check_recording.hpp"

#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/session/check/recorded_forces.hpp"
#include "palpable/session/check/recorded_scenes.hpp"
#include "palpable/session/check/replayed_touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace palpable::session {
namespace {

namespace flag = haptics::flag;

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
/// The size of a difference; infinite if one of the values is not finite.
double difference(double size) {
  return std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
}
bool same(Vec3 a, Vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

void keep_once(std::vector<std::string>& list, std::string_view word) {
  if (std::find(list.begin(), list.end(), word) == list.end()) list.emplace_back(word);
}

/// One pass over a recording.
class Check {
 public:
  Check(RecordedSession session, const CheckOptions& options)
      : scenes_(options.scenes),
        findings_(options.most_of_a_kind),
        forces_(kept(std::move(session)), findings_),
        touch_(report_.session, scenes_),
        law_(report_.session, scenes_) {}

  Result<void> take(const device::Recording& piece);
  CheckReport finish(const device::RecordingReader& reader);

 private:
  const RecordedSession& kept(RecordedSession session) { return report_.session = std::move(session); }
  void take(const device::TouchSample& tick);
  std::string why_not_whole(const device::TouchSample& tick, bool has_law);
  void compare(const device::TouchSample& tick, const device::TouchSample& again);
  bool compare_force(FindingKind kind, const device::TouchSample& tick, Vec3 recorded_N, Vec3 again_N);
  void check_observed(const device::TouchSample& tick);
  void compare_law(const device::TouchSample& tick, const haptics::LawOutput& again);
  void check_air(const device::TouchSample& tick, const RecordedTouch& touch);
  void add_end(const device::RecordingReader& reader);

  CheckReport report_;
  RecordedScenes scenes_;
  Findings findings_;
  RecordedForces forces_;
  ReplayedTouch touch_;
  ReplayedLaw law_;
  device::TouchSample before_;
  bool has_before_ = false;
  double observed_J_ = 0.0;
};

Result<void> Check::take(const device::Recording& piece) {
  for (const auto& scene : piece.scenes)
    if (auto noted = scenes_.note(scene.id, scene.json); !noted)
      findings_.add(FindingKind::damage, before_, 0.0, noted.error().message);
    else if (const RecordedTouch* touch = scenes_.touch(scene.id)) {
      keep_once(report_.laws, haptics::name_of(touch->law.law));
      keep_once(report_.scene_hashes, touch->hashes.scene);
    }
  for (const auto& tick : piece.ticks) take(tick);
  for (const auto& tick : piece.further)
    if (tick.probe == 0 || tick.probe >= haptics::kMaxLiveProbes)
      findings_.add(FindingKind::damage, tick, 0.0, "a tick of a further probe has the number of none");
  report_.further_ticks += piece.further.size();
  return {};
}

std::string Check::why_not_whole(const device::TouchSample& tick, bool has_law) {
  const std::string before = "ticks before it could not be, because " + touch_.why();
  if (has_law) return "only the law's force was recomputed: " + before;
  if (scenes_.scene(tick.scene_id) == nullptr) return touch_.why();
  return "the law's state is not known until the hand has left the surface: " + before;
}

void Check::take(const device::TouchSample& tick) {
  const RecordedTouch* touch = scenes_.touch(tick.scene_id);
  forces_.take(tick, touch);
  if (const device::TouchSample* again = touch_.step(tick)) {
    ++report_.recomputed;
    compare(tick, *again);
  } else {
    const auto output = law_.step(tick);
    findings_.add(FindingKind::not_recomputed, tick, 0.0, why_not_whole(tick, output.has_value()));
    if (output) {
      ++report_.law_recomputed;
      compare_law(tick, *output);
    }
    if (touch != nullptr) scenes_.forget_before(tick.scene_id);
  }
  // The replay may have released the scene, so it is looked up again.
  if (const RecordedTouch* still = scenes_.touch(tick.scene_id)) check_air(tick, *still);
  before_ = tick;
  has_before_ = true;
}

bool Check::compare_force(FindingKind kind, const device::TouchSample& tick, Vec3 recorded_N, Vec3 again_N) {
  if (same(recorded_N, again_N)) return true;
  const double size_N = difference(norm(recorded_N - again_N));
  report_.max_difference_N = std::max(report_.max_difference_N, size_N);
  findings_.add(kind, tick, size_N);
  return false;
}

void Check::compare(const device::TouchSample& tick, const device::TouchSample& again) {
  check_observed(tick);
  bool equal = compare_force(FindingKind::law_force, tick, tick.raw_force_N.v, again.raw_force_N.v);
  equal = compare_force(FindingKind::written_force, tick, tick.written_force_N.v, again.written_force_N.v) &&
          equal;
  if (!same(tick.energy_J, again.energy_J)) {
    findings_.add(FindingKind::energy_balance, tick, difference(std::abs(tick.energy_J - again.energy_J)));
    equal = false;
  }
  const bool same_state =
      same(tick.position.v, again.position.v) && same(tick.velocity_m_per_s.v, again.velocity_m_per_s.v) &&
      (!tick.has(flag::kHasProxy) || same(tick.proxy.v, again.proxy.v)) &&
      same(tick.angular_velocity_rad_per_s.v, again.angular_velocity_rad_per_s.v) &&
      same(tick.raw_torque_Nm.v, again.raw_torque_Nm.v) &&
      same(tick.written_torque_Nm.v, again.written_torque_Nm.v) && tick.flags == again.flags &&
      tick.label == again.label && tick.scene_id == again.scene_id && tick.status == again.status;
  if (!same_state) findings_.add(FindingKind::state, tick, 0.0);
  report_.differing += equal && same_state ? 0 : 1;
}

/// The bar is the same for every law: what the servo's own observer says. Where the recorded work alone shows
/// as much, it is found there (RecordedForces); for laws with a weight the work proves nothing. Once ticks
/// were missed, the observer also counts what a hand got because forces and dampers came late, which is not
/// the law's: from then on contact laws are judged by the work.
void Check::check_observed(const device::TouchSample& tick) {
  const RecordedTouch* touch = scenes_.touch(tick.scene_id);
  const double made_J = touch_.counts().made_max_J;
  if (touch == nullptr || made_J <= observed_J_) return;
  observed_J_ = made_J;
  const bool is_contact = haptics::description_of(touch->law.law).is_contact;
  if (made_J > kEnergyMade_J && (!is_contact || forces_.missed() == 0) &&
      !(made_J <= forces_.work_made_max_J()))
    findings_.add(FindingKind::energy_made, tick, made_J);
}

void Check::compare_law(const device::TouchSample& tick, const haptics::LawOutput& again) {
  // Not felt: with an assumed state, such a difference proves nothing.
  constexpr double kUnfelt_N = 0.05;
  const double size_N = norm(tick.raw_force_N.v - again.force_N.v);
  if (law_.is_assumed() && size_N > 0.0 && size_N <= kUnfelt_N) {
    report_.max_difference_N = std::max(report_.max_difference_N, size_N);
    ++report_.differing;
    findings_.add(FindingKind::not_recomputed, tick, size_N,
                  "the law's state was assumed in free air, and its force differs by less than 0.05 N");
    return;
  }
  bool equal = compare_force(FindingKind::law_force, tick, tick.raw_force_N.v, again.force_N.v);
  if (again.contact != tick.has(flag::kContact) || again.label != tick.label) {
    findings_.add(FindingKind::state, tick, 0.0);
    equal = false;
  }
  report_.differing += equal ? 0 : 1;
}

void Check::check_air(const device::TouchSample& tick, const RecordedTouch& touch) {
  const bool known = has_before_ && tick.tick == before_.tick + 1 && tick.scene_id == before_.scene_id &&
                     tick.status == device::Status::ok && before_.status == device::Status::ok &&
                     !tick.has(flag::kFading | flag::kNoReading) && !before_.has(flag::kNoReading) &&
                     haptics::description_of(touch.law.law).is_contact;
  const double size_N = norm(tick.written_force_N);
  if (!known || size_N < kForceInAir_N) return;
  const haptics::HapticScene* scene = scenes_.scene(tick.scene_id);
  const bool in_air = scene != nullptr ? is_in_free_air(*scene, before_, tick) : !tick.has(flag::kContact);
  if (in_air) findings_.add(FindingKind::free_air, tick, size_N);
}

void Check::add_end(const device::RecordingReader& reader) {
  using End = device::RecordingEnd;
  report_.end = reader.end();
  report_.lost = reader.lost();
  if (report_.end == End::cut) findings_.add(FindingKind::interrupted, before_, 0.0);
  if (report_.end == End::damaged)
    findings_.add(FindingKind::damage, before_, 0.0, "the file cannot be read after this tick");
  if (report_.end == End::more_after_end)
    findings_.add(FindingKind::damage, before_, 0.0, "there is data after the end mark");
  if (report_.lost > 0)
    findings_.add(FindingKind::lost_ticks, before_, static_cast<double>(report_.lost),
                  "the disk was too slow when it was recorded");
}

CheckReport Check::finish(const device::RecordingReader& reader) {
  add_end(reader);
  report_.ticks = forces_.ticks();
  report_.contact_ticks = forces_.contact_ticks();
  report_.duration_s = forces_.duration_s();
  report_.max_force_N = forces_.max_force_N();
  report_.max_step_N = forces_.max_step_N();
  report_.periods = forces_.periods();
  report_.missed = forces_.missed();
  report_.work_made_max_J = forces_.work_made_max_J();
  report_.work_since_zero_force_max_J = forces_.work_since_zero_max_J();
  if (report_.recomputed > 0) {
    const auto counts = touch_.counts();
    report_.scene_change_J = counts.scene_change_J;
    report_.made_max_J = counts.made_max_J;
    report_.made_max_without_controller_J = counts.made_max_without_controller_J;
  }
  report_.findings = findings_.take();
  report_.not_listed = findings_.not_kept();
  for (std::size_t kind = 0; kind < kFindingKinds; ++kind)
    if (is_problem(static_cast<FindingKind>(kind)))
      report_.problems += findings_.count(static_cast<FindingKind>(kind));
  return std::move(report_);
}

}  // namespace

Result<CheckReport> check_recording(const std::filesystem::path& file, const CheckOptions& options,
                                    const Work& work) {
  auto reader = device::RecordingReader::open(file);
  if (!reader) return std::move(reader).error();
  auto session = parse_header((*reader)->header_json());
  if (!session) return invalid_input(session.error().message, file.string());
  Check check(*std::move(session), options);
  while (const device::Recording* piece = (*reader)->next()) {
    if (work.cancelled()) return Work::interrupted();
    if (auto taken = check.take(*piece); !taken) return std::move(taken).error();
    work.report((*reader)->fraction(), "Checking");
  }
  // Nothing can be computed with such times.
  if ((*reader)->end() == device::RecordingEnd::wrong_times) return (*reader)->check_end().error();
  return check.finish(**reader);
}

}  // namespace palpable::session
