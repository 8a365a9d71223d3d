// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/touch_slot.hpp"

#include <utility>

namespace palpable::page::shelf {
namespace {

/// The same host; `ended` gets its value once the last user has released it and it is destroyed.
std::shared_ptr<PageHost> told_at_its_end(std::shared_ptr<PageHost> host, std::promise<void> ended) {
  PageHost* const same = host.get();
  const auto promise = std::make_shared<std::promise<void>>(std::move(ended));
  return {same, [owner = std::move(host), promise](PageHost*) mutable {
            owner.reset();
            promise->set_value();
          }};
}

}  // namespace

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
  // Destroyed here, or by the server, which asks for the touch at least twenty times per second. A device can
  // be open once only.
  old.reset();
  if (ended_.valid()) ended_.get();
  auto begun = begin_(request);
  if (!begun) return begun.error();
  std::promise<void> ended;
  ended_ = ended.get_future();
  auto touch = told_at_its_end(*std::move(begun), std::move(ended));
  const std::lock_guard lock(mutex_);
  touch_ = std::move(touch);
  name_ = request.name;
  return {};
}

}  // namespace palpable::page::shelf
