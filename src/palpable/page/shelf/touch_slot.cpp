// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/touch_slot.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace palpable::page::shelf {

std::shared_ptr<PageHost> TouchSlot::current() const {
  const std::lock_guard lock(mutex_);
  return touch_;
}

std::string TouchSlot::name() const {
  const std::lock_guard lock(mutex_);
  return name_;
}

Result<void> TouchSlot::replace(const TouchRequest& request) {
  const std::lock_guard one_at_a_time(replacing_);
  std::shared_ptr<PageHost> old;
  {
    const std::lock_guard lock(mutex_);
    old = std::exchange(touch_, nullptr);
    name_.clear();
  }
  // The server asks for the touch at least twenty times per second. A device can be open once only.
  while (old.use_count() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  old.reset();
  auto begun = begin_(request);
  if (!begun) return begun.error();
  const std::lock_guard lock(mutex_);
  touch_ = *std::move(begun);
  name_ = request.name;
  return {};
}

}  // namespace palpable::page::shelf
