// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/headless.hpp"

#include "palpable/device/url.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/session/touch/outage.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace palpable::session {
namespace {

constexpr auto kLook = std::chrono::milliseconds(20);

/// Moves the explorer to the last step that is due, if there is one.
Result<void> walk_on(TouchSession& session, const HeadlessOptions& options, double t_s, std::size_t& next) {
  const std::size_t due = steps_by(options.walk, t_s);
  if (due == next) return {};
  next = due;
  const ExplorerPose& pose = options.walk[due - 1].pose;
  if (auto moved = session.move_explorer(pose); !moved) return moved;
  if (options.on_pose) options.on_pose(pose);
  return {};
}

/// Tells which hands' devices do not answer, and when they answer again.
class DeviceNews {
 public:
  explicit DeviceNews(const TouchSession& session) : session_(session), outages_(session.hands()) {}

  /// What is said of an event; empty for most.
  std::string of(const haptics::TouchEvent& event, double now_s) {
    using Kind = haptics::TouchEvent::Kind;
    const std::size_t hand = event.probe;
    if (hand >= outages_.size()) return {};
    if (event.kind == Kind::recovered) outages_[hand].note_works(now_s);
    // A device that is not ready says itself what the person does next.
    const bool is_lost =
        event.kind == Kind::fault && event.value != static_cast<std::uint32_t>(device::Status::not_ready);
    if (!is_lost || !outages_[hand].begin()) return session_.event_words(event);
    const std::string fault = session_.device_fault(hand);
    return session_.said_of(
        hand, "The device does not answer: its force is off" + (fault.empty() ? "." : " (" + fault + ")."));
  }
  /// The sentences about devices that answer again.
  std::vector<std::string> take_ends(double now_s) {
    std::vector<std::string> ends;
    for (std::size_t hand = 0; hand < outages_.size(); ++hand)
      if (outages_[hand].take_end(now_s)) ends.push_back(session_.said_of(hand, "The device answers again."));
    return ends;
  }

 private:
  const TouchSession& session_;
  std::vector<Outage> outages_;
};

void make_repeatable(haptics::ServoOptions& servo, double seconds) {
  servo.time_by_ticks = true;
  servo.most_ticks =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(seconds * servo.rate_hz)));
}

/// Whether every hand has made all of its ticks.
bool is_complete(const TouchSession& session, std::uint64_t most_ticks) {
  const TouchStatistics so_far = session.statistics();
  return so_far.servo.touch.ticks >= most_ticks &&
         std::all_of(so_far.further_hands.begin(), so_far.further_hands.end(),
                     [&](const auto& hand) { return hand.servo.touch.ticks >= most_ticks; });
}

std::optional<std::size_t> failed_hand(const TouchSession& session) {
  for (std::size_t hand = 0; hand < session.hands(); ++hand)
    if (session.latest(hand).status == device::Status::fault) return hand;
  return std::nullopt;
}

}  // namespace

Result<TouchStatistics> touch_headless(const SceneMaker& make, const HeadlessOptions& options,
                                       const Work& work) {
  const std::int64_t begin_ns = options.begin_ns != 0 ? options.begin_ns : haptics::monotonic_ns();
  MakerThread maker(make, work);
  auto scene = options.repeatable ? maker.last_scene(work) : maker.first_scene(work);
  if (!scene) return std::move(scene).error();
  SessionOptions session_options = options.session;
  if (options.repeatable) make_repeatable(session_options.servo, options.seconds);
  session_options.recording = options.recording;
  auto opened =
      TouchSession::open(std::move(*scene), options.settings, options.device_url, session_options, begin_ns);
  if (!opened) return std::move(opened).error();
  TouchSession& session = **opened;

  const auto report_notices = [&] {
    if (!options.on_notice) return;
    for (const std::string& sentence : session.notices()) options.on_notice(sentence);
  };
  report_notices();
  auto feeding =
      std::make_unique<Feeding>(options.live, session, [&options](const std::string& sentence, LiveSubject) {
        if (options.on_notice) options.on_notice(sentence);
      });
  const auto guide = [&] {
    if (const std::string step = session.take_guidance(); !step.empty() && options.on_device)
      options.on_device(step + ".", false);
  };

  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto end = start + std::chrono::duration<double>(options.seconds);
  std::size_t next_step = 0;
  std::optional<std::size_t> failed;
  DeviceNews news(session);
  const auto is_over = [&] {
    return options.repeatable ? is_complete(session, session_options.servo.most_ticks) : Clock::now() >= end;
  };
  while (!is_over() && !work.cancelled()) {
    const auto before = Clock::now();
    const double t_s = std::chrono::duration<double>(before - start).count();
    if (auto walked = walk_on(session, options, t_s, next_step); !walked) return std::move(walked).error();
    if (auto better = maker.take(kLook)) {
      if (auto changed = session.change_scene(std::move(better)); !changed) return std::move(changed).error();
      report_notices();
    }
    if (const auto fault = session.take_recording_fault(); fault && options.on_notice)
      options.on_notice("The recording has ended: " + fault->sentence());
    guide();
    failed = failed_hand(session);
    if (failed) break;
    for (const auto& missed : session.take_missed())
      if (options.on_missed) options.on_missed(missed);
    for (const auto& event : session.take_events()) {
      if (const std::string words = news.of(event, t_s); !words.empty() && options.on_device)
        options.on_device(words, event.kind == haptics::TouchEvent::Kind::fault);
      if (options.on_event) options.on_event(event, *session.scene());
    }
    for (const std::string& words : news.take_ends(t_s))
      if (options.on_device) options.on_device(words, true);
    std::this_thread::sleep_until(before + kLook);
  }
  maker.cancel();
  feeding.reset();
  const std::string fault = failed ? session.device_fault(*failed) : std::string();
  auto recorded = session.stop();
  if (!recorded) return std::move(recorded).error();
  if (failed)
    return Error{ErrorCode::device, fault.empty() ? "the device has failed" : fault,
                 device::url_as_place(session.device_url(*failed))};
  auto statistics = session.statistics();
  if (options.live != nullptr) statistics.live = options.live->statistics();
  return statistics;
}

}  // namespace palpable::session
