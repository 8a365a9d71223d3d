// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/library_host/serve.hpp"

#include "palpable/core/system/thread_priority.hpp"

#include <cerrno>
#include <chrono>

#include <poll.h>
#include <unistd.h>

namespace palpable::device {
namespace {

using std::chrono::nanoseconds;

constexpr unsigned kClosing_s = 2;

}  // namespace

LibraryHost::LibraryHost(Device& device, HostExchange& shared)
    : device_(device),
      calls_by_thread_(dynamic_cast<const CallsByThread*>(&device)),
      shared_(shared),
      watch_([this] { watch(); }) {
  tell_texts();
  shared_.stage.store(HostStage::serves, std::memory_order_release);
}

LibraryHost::~LibraryHost() { end_watch(); }

void LibraryHost::end_watch() {
  served_.store(true, std::memory_order_release);
  if (watch_.joinable()) watch_.join();
}

void LibraryHost::serve() {
  static_cast<void>(request_priority(kForcePriority));
  std::uint32_t seen = shared_.calls.load(std::memory_order_acquire);
  std::int64_t before_ns = steady_ns();
  while (!ending_.load(std::memory_order_acquire)) {
    wait_while(shared_.calls, seen, nanoseconds(kLibraryLook).count());
    seen = shared_.calls.load(std::memory_order_acquire);
    if (shared_.answered.load(std::memory_order_relaxed) != shared_.asked.load(std::memory_order_acquire))
      answer();
    const std::int64_t now_ns = steady_ns();
    write_newest(1e-9 * static_cast<double>(now_ns - before_ns));
    before_ns = now_ns;
  }
  {
    const LibraryCall call(shared_.in_call_since_ns);
    device_.write({});
    device_.stop();
  }
  shared_.stage.store(HostStage::closes, std::memory_order_release);
  end_watch();
  // Closing the device may hang, where nobody waits for it any more.
  ::alarm(kClosing_s);
}

void LibraryHost::answer() {
  HostExchange::State state;
  {
    const LibraryCall call(shared_.in_call_since_ns);
    const Reading reading = device_.read();
    state = {reading.position.v, static_cast<std::uint32_t>(reading.status), reading.buttons,
             reading.is_repeated};
  }
  constexpr unsigned kPause = 100;
  const auto status = static_cast<Status>(state.status);
  if (status != told_ || ++since_told_ > kPause) tell_texts();
  told_ = status;
  shared_.states.put(state);
  advance(shared_.answered);
}

void LibraryHost::write_newest(double elapsed_s) {
  const std::uint32_t puts = shared_.puts.load(std::memory_order_acquire);
  const auto taken = shared_.forces.take(elapsed_s);
  if (puts != puts_ || (pushes_ && !taken.valid)) {
    const LibraryCall call(shared_.in_call_since_ns);
    device_.write({taken.command});
    if (!taken.valid) device_.stop();
    pushes_ = taken.command != Vec3{};
  }
  puts_ = puts;
  shared_.forces.sent(taken);
}

void LibraryHost::tell_texts() {
  const LibraryCall call(shared_.in_call_since_ns);
  HostExchange::Texts texts;
  store_text(texts.fault, device_.fault());
  store_text(texts.guidance, device_.guidance());
  shared_.texts.put(texts);
  since_told_ = 0;
}

/// Since when the library has been in a call; 0: it is in none.
std::int64_t LibraryHost::note_calls() noexcept {
  const std::int64_t by_thread_ns = calls_by_thread_ != nullptr ? calls_by_thread_->in_call_since_ns() : 0;
  shared_.thread_in_call_since_ns.store(by_thread_ns, std::memory_order_release);
  const std::int64_t own_ns = shared_.in_call_since_ns.load(std::memory_order_acquire);
  return own_ns != 0 ? own_ns : by_thread_ns;
}

void LibraryHost::watch() noexcept {
  constexpr std::chrono::seconds kEnding{1};
  static_cast<void>(request_priority(kForcePriority));
  std::int64_t cut_in_ns = 0;
  std::int64_t asked_to_end_ns = 0;
  while (!served_.load(std::memory_order_acquire)) {
    pollfd program{asked_to_end_ns == 0 ? kHostAlive : -1, POLLIN, 0};
    if (::poll(&program, 1, static_cast<int>(kLibraryLook.count())) > 0) {
      asked_to_end_ns = steady_ns();
      ending_.store(true, std::memory_order_release);
      advance(shared_.calls);
    }
    const std::int64_t since_ns = note_calls();
    const std::int64_t now_ns = steady_ns();
    // The process ends with whatever the library still holds.
    if (asked_to_end_ns != 0 && now_ns - asked_to_end_ns > nanoseconds(kEnding).count()) ::_exit(1);
    if (since_ns == 0 || since_ns == cut_in_ns || now_ns - since_ns < nanoseconds(kLateCall).count())
      continue;
    cut_in_ns = since_ns;
    device_.cut_force();
  }
}

}  // namespace palpable::device
