// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/remote_device.hpp"

#include "palpable/core/text/number_text.hpp"
#include "palpable/device/open_options.hpp"
#include "palpable/device/remote/remote_link.hpp"
#include "palpable/device/url.hpp"

#include <cmath>
#include <utility>

namespace palpable::device {

RemoteDevice::RemoteDevice(Traits traits, std::shared_ptr<RemoteExchange> exchange, double rate_hz,
                           std::shared_ptr<RemoteLink> link)
    : traits_(std::move(traits)),
      exchange_(std::move(exchange)),
      period_s_(1.0 / rate_hz),
      fresh_(period_s_, kStale_s, kSilent_s),
      link_(std::move(link)) {}

RemoteDevice::~RemoteDevice() { exchange_->surfaces.cut(); }

Reading RemoteDevice::read() noexcept {
  fresh_.pass();
  if (exchange_->readings.take(newest_)) fresh_.renew(newest_.position.v, newest_.buttons, newest_.status);
  Reading reading = fresh_.now(exchange_->failed.load(std::memory_order_relaxed));
  const Vec3 behind_m = reading.position.v - followed_m_;
  const double most_m = kCatchUp_m_per_s * period_s_;
  const double far_m = norm(behind_m);
  const bool is_followed = std::exchange(follows_, reading.status == Status::ok) && far_m > most_m;
  followed_m_ = is_followed ? followed_m_ + (most_m / far_m) * behind_m : reading.position.v;
  reading.position.v = followed_m_;
  return reading;
}

void RemoteDevice::write_surface(const LocalSurface& surface) noexcept {
  LocalSurface stamped = surface;
  stamped.read_at_s = newest_.read_at_s;
  // The other computer's own loop begins its force from zero; here nothing does.
  exchange_->surfaces.notice_taken_back();
  exchange_->surfaces.put(stamped);
}

std::string RemoteDevice::fault() const {
  const std::string trouble = link_ != nullptr ? link_->trouble() : std::string();
  return trouble.empty() ? FreshReading::silence_of(traits_.name) : trouble;
}

namespace {

Result<RemoteLink::Address> address_in(DeviceUrl& url) {
  RemoteLink::Address address;
  address.token = url.take_text("token");
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  const std::string& path = url.path();
  const auto colon = path.rfind(':');
  const auto wrong = [&](std::string message) {
    return Error{ErrorCode::usage, std::move(message), path.empty() ? "remote" : "remote:" + path};
  };
  if (colon == std::string::npos || colon == 0 || colon + 1 == path.size())
    return wrong(
        "a device at another computer is named as palpable share prints it: "
        "remote:HOST:PORT?token=…");
  address.host = path.substr(0, colon);
  address.port = path.substr(colon + 1);
  if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']')
    address.host = address.host.substr(1, address.host.size() - 2);
  constexpr double kMostPort = 65535.0;
  const auto port = finite_number(address.port);
  if (!port || *port < 1.0 || *port > kMostPort || *port != std::floor(*port))
    return wrong("a port is a number from 1 to 65535");
  if (address.token.size() != kSecret_bytes)
    return wrong("the token is missing or incomplete; take the whole address that palpable share prints");
  return address;
}

}  // namespace

Result<void> check_remote(DeviceUrl& url) {
  const auto address = address_in(url);
  return address ? Result<void>{} : Result<void>(address.error());
}

Result<std::unique_ptr<Device>> open_remote(DeviceUrl& url, const OpenOptions& options) {
  const auto address = address_in(url);
  if (!address) return address.error();
  auto exchange = std::make_shared<RemoteExchange>();
  auto link = RemoteLink::open(*address, exchange);
  if (!link) return std::move(link).error();
  Traits traits = (*link)->traits();
  return std::unique_ptr<Device>(
      std::make_unique<RemoteDevice>(std::move(traits), exchange, options.rate_hz, *std::move(link)));
}

}  // namespace palpable::device
