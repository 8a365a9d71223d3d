// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// TouchHost: what the page says.
#include "palpable/describe/language.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/page/touch_host.hpp"

#include <utility>

namespace palpable::page {

std::optional<protocol::Notice> TouchHost::next_notice() {
  language_ = describe::current_language();
  take_notices();
  const std::lock_guard lock(mutex_);
  if (notices_.empty()) return {};
  auto notice = std::move(notices_.front());
  notices_.pop_front();
  return notice;
}

void TouchHost::take_notices() {
  using Kind = haptics::TouchEvent::Kind;
  for (const std::string& note : std::exchange(options_.notes, {})) say("info", describe::known(note));
  if (const auto fault = session_.take_recording_fault())
    say("warning", describe::phrase("The recording has ended: {}", fault->sentence()));
  if (const std::string step = session_.take_guidance(); !step.empty()) say("info", step);
  const double now_s = 1e-9 * static_cast<double>(haptics::monotonic_ns());
  for (const auto& event : session_.take_events()) {
    // No fault: a pointer is lost whenever no page is open, an additional probe whenever it is lifted.
    const bool device = event.probe < session_.hands() && !pointer_moves();
    if (event.kind == Kind::fault && device) {
      if (!outages_[event.probe].begin()) continue;
      const auto fault = session_.device_fault(event.probe);
      say("fault", session_.said_of(
                       event.probe,
                       fault.empty() ? describe::tr("The device does not answer: its force is off") : fault));
    } else if (event.kind == Kind::recovered && device) {
      outages_[event.probe].note_works(now_s);
    } else if (const auto words = session_.event_words(event); !words.empty()) {
      say("info", words);
    } else if (event.kind == Kind::not_finite) {
      say("fault", describe::tr("The law gave a force that is not a number: the force is off"));
    }
  }
  for (std::size_t hand = 0; hand < outages_.size(); ++hand)
    if (outages_[hand].take_end(now_s))
      say("recovered", session_.said_of(hand, describe::tr("The device answers again")));
}

void TouchHost::say(std::string level, std::string text, std::optional<std::int64_t> probe) {
  const std::lock_guard lock(mutex_);
  notices_.push_back({std::move(level), std::move(text), probe});
}

}  // namespace palpable::page
