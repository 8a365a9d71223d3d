// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/commentary.hpp"
#include "palpable/page/protocol.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace palpable::page {

/// The page's speech during a touch (describe/): answers to questions, and remarks on what sweeping probes
/// meet. One thread.
class SpokenWords {
 public:
  /// `session` must outlive it.
  explicit SpokenWords(const session::TouchSession& session) : session_(session) {}

  /// The answer to a question; empty for an unknown question.
  std::string answer(const protocol::Ask& ask);
  /// What a probe has just met; usually nothing. Call it with every state.
  std::optional<std::string> remark(const protocol::State& state);

 private:
  const session::TouchSession& session_;
  /// The model that the commentaries are about.
  models::Model model_;
  std::array<describe::Commentary, protocol::kMostProbes> commentaries_;
};

}  // namespace palpable::page
