// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/guided.hpp"

#include "palpable/haptics/law/law_making.hpp"

namespace palpable::haptics {

void GuidedTouchable::touch_pages() const noexcept {
  law_->touch_pages();
  read_pages(pull_.data(), pull_.memory_bytes());
}

}  // namespace palpable::haptics
