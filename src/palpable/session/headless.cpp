// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/headless.hpp"

#include "palpable/haptics/pacing.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace palpable::session {
namespace {

constexpr auto kLook = std::chrono::milliseconds(20);

}  // namespace

Result<TouchStatistics> touch_headless(const SceneMaker& make, const HeadlessOptions& options,
                                       const Work& work) {
  const std::int64_t begin_ns = options.begin_ns != 0 ? options.begin_ns : haptics::monotonic_ns();
  MakerThread maker(make, work);
  auto scene = maker.first_scene(work);
  if (!scene) return std::move(scene).error();
  auto opened =
      TouchSession::open(std::move(*scene), options.settings, options.device_url, options.session, begin_ns);
  if (!opened) return std::move(opened).error();
  TouchSession& session = **opened;
  if (!options.recording.empty())
    if (auto started = session.start_recording(options.recording); !started)
      return std::move(started).error();

  const auto tell_notices = [&] {
    if (!options.on_notice) return;
    for (const std::string& sentence : session.notices()) options.on_notice(sentence);
  };
  tell_notices();

  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  while (Clock::now() < end && !work.cancelled()) {
    const auto before = Clock::now();
    if (auto better = maker.take(kLook)) {
      if (auto changed = session.change_scene(std::move(better)); !changed) return std::move(changed).error();
      tell_notices();
    }
    for (const auto& missed : session.take_missed())
      if (options.on_missed) options.on_missed(missed);
    for (const auto& event : session.take_events())
      if (options.on_event) options.on_event(event, *session.scene());
    std::this_thread::sleep_until(before + kLook);
  }
  maker.cancel();
  auto recorded = session.stop_recording();
  session.stop();
  if (!recorded) return std::move(recorded).error();
  return session.statistics();
}

}  // namespace palpable::session
