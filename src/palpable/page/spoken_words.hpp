// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/commentary.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/page_names.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <array>
#include <string>
#include <vector>

namespace palpable::page {

/// The page's speech during a touch (describe/): answers to questions, and remarks on what sweeping probes
/// meet. One thread.
class SpokenWords {
 public:
  /// The answer to a question about the scene as it is touched; empty for an unknown question. `force_N`: the
  /// force on the probe of the question.
  protocol::Words answer(const protocol::Ask& ask, const models::Scene& scene, double height_factor,
                         double force_N);
  /// What probes have just met, as notices of level motion; usually nothing. Call it with every state.
  std::vector<protocol::Notice> remarks(const protocol::State& state, const models::Scene& scene,
                                        double height_factor);
  /// What the pages list, edit and find.
  PageNames& names() { return names_; }

 private:
  std::string text_of(const protocol::Ask& ask, const models::Scene& scene, double height_factor,
                      double force_N);

  PageNames names_;
  /// The model that the commentaries are about.
  models::Model model_;
  std::array<describe::Commentary, protocol::kMostProbes> commentaries_;
};

}  // namespace palpable::page
