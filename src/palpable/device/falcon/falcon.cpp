// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon.hpp"

#include "palpable/core/system/thread_priority.hpp"
#include "palpable/device/falcon/falcon_firmware.hpp"
#include "palpable/device/open_options.hpp"
#include "palpable/device/transport/libusb_transfers.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace palpable::device {
namespace {

constexpr UsbIds kFalconIds{0x0403, 0xCB48};
constexpr auto kLeavingFalcon = std::chrono::milliseconds(20);
constexpr int kMostFalcons = 15;

/// The force that the motors can hold in every direction everywhere in the workspace, N.
double greatest_falcon_force_N() {
  constexpr int kGrid = 8;
  constexpr double kMostTorque_Nm = FalconCommand::kMostMotor / -FalconCommand::kPerTorque_1_per_Nm;
  const auto offset = [](int k) { return static_cast<double>(k) / kGrid - 0.5; };
  double force_N = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j)
      for (int k = 0; k <= kGrid; ++k) {
        const Vec3 size = falcon::kWorkspace_m;
        const Vec3 place =
            falcon::kCentre_m + Vec3{size.x * offset(i), size.y * offset(j), size.z * offset(k)};
        const auto angles = falcon::angles_at(place);
        const auto moved = angles ? falcon::jacobian(*angles, place) : std::nullopt;
        if (!moved) continue;
        for (const Vec3& lever : *moved) force_N = std::min(force_N, kMostTorque_Nm / norm(lever));
      }
  return force_N;
}

Traits falcon_traits(const FalconOptions& options) {
  Traits traits;
  traits.name = "Novint Falcon";
  traits.workspace_m = falcon::kWorkspace_m;
  traits.max_force_N = std::min(options.max_force_N, greatest_falcon_force_N());
  traits.continuous_force_N = continuous_force(options.continuous_force_N, traits.max_force_N);
  // One count of one arm at the middle, where a radian moves the grip by about 100 mm.
  constexpr double kLever_m = 0.1;
  traits.position_resolution_m = kFalconCount_rad * kLever_m;
  traits.delay_samples = 2;
  traits.rate_hz = options.rate_hz;
  return traits;
}

}  // namespace

Falcon::Falcon(std::unique_ptr<UsbTransfers> usb, const FalconOptions& options, int descriptor)
    : usb_(std::move(usb)),
      link_(*usb_),
      descriptor_(descriptor),
      traits_(falcon_traits(options)),
      fresh_(1.0 / options.rate_hz),
      until_s_(usb_->now_s()) {
  if (!options.own_thread) return;
  thread_ = std::thread([this] {
    static_cast<void>(request_priority(kForcePriority));
    while (!ending_.load(std::memory_order_relaxed)) link_.exchange();
  });
}

Result<std::unique_ptr<Falcon>> Falcon::open(std::unique_ptr<UsbTransfers> usb, const FalconOptions& options,
                                             int descriptor) {
  if (!begin_falcon_packets(*usb)) {
    if (usb->lost()) return Error{ErrorCode::device, "the Falcon was unplugged", "falcon"};
    if (options.firmware.empty())
      return Error{
          ErrorCode::device,
          "the Falcon needs its maker's firmware each time that it was plugged in; name the file in the "
          "address: falcon:?firmware=FILE",
          "falcon"};
    const auto image = read_falcon_firmware(options.firmware);
    if (!image) return image.error();
    if (auto loaded = load_falcon_firmware(*usb, *image); !loaded) return std::move(loaded).error();
  }
  return std::unique_ptr<Falcon>(new Falcon(std::move(usb), options, descriptor));
}

Falcon::~Falcon() {
  link_.forces.cut();
  if (thread_.joinable()) {
    link_.forces.wait_for_zero(kLeavingFalcon);
    ending_ = true;
    thread_.join();
  } else {
    const double until_s = usb_->now_s() + std::chrono::duration<double>(kLeavingFalcon).count();
    while (usb_->now_s() < until_s && !usb_->lost()) link_.exchange();
  }
}

void Falcon::exchange_a_period() noexcept {
  until_s_ += 1.0 / traits_.rate_hz;
  while (usb_->now_s() < until_s_) link_.exchange();
}

Reading Falcon::read() noexcept {
  if (!thread_.joinable()) exchange_a_period();
  fresh_.pass();
  if (link_.forces.notice_taken_back()) fresh_.rest();
  if (FalconLink::State state; link_.states.take(state))
    fresh_.renew(state.place_m - falcon::kCentre_m, state.buttons,
                 state.homed ? Status::ok : Status::not_ready);
  return fresh_.now(link_.lost() || link_.is_stuck());
}

void Falcon::write(Vector<DeviceFrame> force_N) noexcept { link_.forces.put(fresh_.allowed(force_N.v)); }

void Falcon::stop() noexcept { link_.forces.cut(); }

std::string Falcon::fault() const {
  if (link_.lost()) return "the Falcon was unplugged";
  if (link_.is_stuck())
    return "an arm of the Falcon stands still while the others move: its encoder is stuck, so its force is "
           "off";
  return FreshReading::silence_of("Falcon");
}

std::string Falcon::guidance() const {
  if (link_.is_homed()) return {};
  return "Pull the grip of the Falcon out as far as it goes, then push it in as far as it goes; the red "
         "light turns green when it knows its place";
}

std::optional<ZeroWrite> Falcon::zero_write() const {
  if (descriptor_ < 0) return {};
  const auto zero = falcon_packet({});
  return ZeroWrite{descriptor_, {zero.begin(), zero.end()}, LibusbTransfers::kOut};
}

Result<std::vector<std::string>> falcon_ports() {
  const auto count = count_usb_devices(kFalconIds);
  if (!count) return count.error();
  std::vector<std::string> ports;
  for (int k = 0; k < *count; ++k) ports.push_back(std::to_string(k));
  return ports;
}

Result<std::unique_ptr<Device>> open_falcon(DeviceUrl& url, const OpenOptions& options) {
  FalconOptions wanted;
  wanted.firmware = url.take_text("firmware");
  wanted.max_force_N = url.take_number("max-force", wanted.max_force_N, 0.1, 40.0);
  wanted.continuous_force_N = take_continuous_force(url);
  wanted.rate_hz = options.rate_hz;
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  const auto index = url.path_number(kMostFalcons);
  if (!index) return index.error();
  const auto count = count_usb_devices(kFalconIds);
  if (!count) return count.error();
  if (*count == 0) return Error{ErrorCode::device, "no Falcon is plugged in", "falcon"};
  if (*index < 0 && *count > 1)
    return Error{ErrorCode::device,
                 "there are " + std::to_string(*count) + " Falcons: name one, such as falcon:0", "falcon"};
  auto usb = LibusbTransfers::open(kFalconIds, std::max(0, *index));
  if (!usb) return std::move(usb).error();
  const int descriptor = (*usb)->descriptor();
  auto device = Falcon::open(*std::move(usb), wanted, descriptor);
  if (!device) return std::move(device).error();
  return std::unique_ptr<Device>(*std::move(device));
}

}  // namespace palpable::device
