// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/protocol.gen.hpp"
#include "palpable/page/share_host.hpp"

namespace palpable::page {

/// What the server does with a guest's message.
enum class Ruling {
  pass,
  /// It is a question, whose answer takes time: passed if it is not asked too often.
  question,
  /// Only pages of this machine may do that.
  refuse,
};

/// The one place that decides what a guest may do. Every kind of message has its own line here.
Ruling ruling(const Guest& guest, const protocol::FromPage& message);

/// The question as a guest may ask it. Answers are remembered for each probe, so that nothing is said twice:
/// a guest's questions count for its own probe, or for `lookers_probe` if it has none.
protocol::Ask asked_by(const Guest& guest, protocol::Ask question, std::int64_t lookers_probe);

/// Whether a guest receives a notice. Those that are left out may name files of this machine. Remarks on a
/// moving probe are for the guest whose probe it is; who looks receives those that the host receives.
bool concerns(const Guest& guest, const protocol::Notice& notice, bool is_of_another_guest);

}  // namespace palpable::page
