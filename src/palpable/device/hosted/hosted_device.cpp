// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/hosted/hosted_device.hpp"

#include "palpable/core/system/thread_priority.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/device/recording/traits_json.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace palpable::device {
namespace {

constexpr std::chrono::milliseconds kFreeing{2000};
constexpr std::chrono::milliseconds kClosing{1000};
/// A process that ended its answer is about to end.
constexpr std::chrono::milliseconds kAboutToEnd{500};

/// A clause about how the host ended, which writes no more: by itself, or else by force.
std::string end_of(HostProcess& host) {
  host.has_ended(kAboutToEnd);
  return host.end();
}

/// The error that a host answers: "-CODE", the place and the message, each in a line.
Error answered_error(HostProcess& host, const std::string& first) {
  const auto line = [&] {
    auto next = host.next_line(kAboutToEnd);
    return next ? std::move(*next).value_or("") : std::string();
  };
  const auto code = finite_number(std::string_view(first).substr(1));
  Error error{code == 2.0 ? ErrorCode::usage : ErrorCode::device, {}, line()};
  error.message = line();
  return error;
}

bool is_hung(const std::atomic<std::int64_t>& in_call_since_ns) noexcept {
  const std::int64_t since_ns = in_call_since_ns.load(std::memory_order_acquire);
  return since_ns != 0 && steady_ns() - since_ns > std::chrono::nanoseconds(kHungCall).count();
}

/// A new start of the library opens the device and closes it again. False: that failed.
bool free_motors(const std::string& url) {
  auto host = HostProcess::start({"free", url});
  if (!host) return false;
  host->has_ended(kFreeing);
  host->end();
  return host->has_succeeded();
}

}  // namespace

Result<std::unique_ptr<HostedDevice>> HostedDevice::open(const std::string& url, double rate_hz,
                                                         std::chrono::milliseconds longest) {
  auto host = HostProcess::start({"serve", url, std::to_string(rate_hz)});
  if (!host) return std::move(host).error();
  auto answer = host->next_line(longest);
  if (!answer) return Error{answer.error().code, answer.error().message, url};
  const std::string line = std::move(*answer).value_or("");
  if (line.starts_with('-')) return answered_error(*host, line);
  const auto traits = line.empty() ? std::nullopt : recorded_traits(line);
  if (line.empty())
    return Error{ErrorCode::device, "the vendor's library " + end_of(*host) + " while the device was opened",
                 url};
  if (!traits || !check(*traits))
    return Error{ErrorCode::device, "the vendor's library states what no device has", url};
  return std::unique_ptr<HostedDevice>(new HostedDevice(url, *traits, *std::move(host), rate_hz));
}

HostedDevice::HostedDevice(std::string url, Traits traits, HostProcess host, double rate_hz)
    : url_(std::move(url)),
      traits_(std::move(traits)),
      host_(std::move(host)),
      patience_ns_(
          std::min(std::chrono::nanoseconds(kPatience).count(), static_cast<std::int64_t>(2e9 / rate_hz))),
      fresh_(1.0 / rate_hz),
      watch_([this] { watch(); }) {}

HostedDevice::~HostedDevice() {
  ending_.store(true, std::memory_order_release);
  watch_.join();
  if (failed_.load(std::memory_order_acquire)) return;
  stop();
  host_.ask_to_end();
  host_.has_ended(kClosing);
  host_.end();
  const HostStage stage = host_.exchange().stage.load(std::memory_order_acquire);
  if (stage != HostStage::closes && stage != HostStage::closed) free_motors(url_);
}

Reading HostedDevice::read() noexcept {
  HostExchange& shared = host_.exchange();
  fresh_.pass();
  if (shared.forces.notice_taken_back()) fresh_.rest();
  const std::uint32_t asked = shared.asked.load(std::memory_order_relaxed);
  std::uint32_t answered = shared.answered.load(std::memory_order_acquire);
  // An answer that is late is not waited for again.
  if (answered == asked && !failed_.load(std::memory_order_relaxed)) {
    shared.asked.store(asked + 1, std::memory_order_release);
    advance(shared.calls);
    const std::int64_t until_ns = steady_ns() + patience_ns_;
    for (std::int64_t left_ns = patience_ns_; answered == asked && left_ns > 0;
         left_ns = until_ns - steady_ns()) {
      wait_while(shared.answered, answered, left_ns);
      answered = shared.answered.load(std::memory_order_acquire);
    }
  }
  if (shared.states.take(state_) && is_finite(state_.position_m))
    fresh_.renew(state_.position_m, state_.buttons,
                 static_cast<Status>(
                     std::min<std::uint32_t>(state_.status, static_cast<std::uint32_t>(Status::fault))));
  Reading reading = fresh_.now(failed_.load(std::memory_order_relaxed));
  reading.is_repeated = reading.is_repeated || state_.is_repeated;
  return reading;
}

void HostedDevice::write(Vector<DeviceFrame> force_N) noexcept {
  HostExchange& shared = host_.exchange();
  shared.forces.put(fresh_.allowed(force_N.v));
  shared.puts.fetch_add(1, std::memory_order_release);
  advance(shared.calls);
}

void HostedDevice::stop() noexcept {
  host_.exchange().forces.cut();
  advance(host_.exchange().calls);
}

void HostedDevice::watch() noexcept {
  static_cast<void>(request_priority(kForcePriority));
  while (!ending_.load(std::memory_order_acquire)) {
    if (host_.has_ended(kLibraryLook)) return give_up(host_.end());
    const HostExchange& shared = host_.exchange();
    if (!is_hung(shared.in_call_since_ns) && !is_hung(shared.thread_in_call_since_ns)) continue;
    host_.end();
    return give_up("did not return from a call for " + std::to_string(kHungCall.count()) +
                   " ms, and was ended");
  }
}

void HostedDevice::give_up(const std::string& what) {
  const bool freed = free_motors(url_);
  {
    const std::lock_guard lock(mutex_);
    failure_ = "the library of the " + traits_.name + " " + what + "; " +
               (freed ? "started again, it has freed the motors"
                      : "the motors may hold their last force: switch the device off");
  }
  failed_.store(true, std::memory_order_release);
}

std::string HostedDevice::fault() const {
  const std::lock_guard lock(mutex_);
  if (!failure_.empty()) return failure_;
  take_texts();
  return texts_.fault[0] == 0 ? FreshReading::silence_of(traits_.name) : std::string(texts_.fault.data());
}

std::string HostedDevice::guidance() const {
  const std::lock_guard lock(mutex_);
  take_texts();
  return texts_.guidance.data();
}

void HostedDevice::take_texts() const {
  if (!host_.exchange().texts.take(texts_)) return;
  texts_.fault.back() = texts_.guidance.back() = 0;
}

Result<std::vector<std::string>> hosted_ports(const std::string& scheme) {
  constexpr std::chrono::milliseconds kListing{5000};
  auto host = HostProcess::start({"ports", scheme});
  if (!host) return std::move(host).error();
  std::vector<std::string> ports;
  while (true) {
    auto line = host->next_line(kListing);
    if (!line) return std::move(line).error();
    if (!line->has_value()) break;
    if ((*line)->starts_with('-')) return answered_error(*host, **line);
    // The last line ends the list.
    if (**line == "+") return ports;
    ports.push_back(std::move(**line).substr(1));
  }
  return Error{
      ErrorCode::device, "the vendor's library " + end_of(*host) + " while it looked for devices", {}};
}

}  // namespace palpable::device
