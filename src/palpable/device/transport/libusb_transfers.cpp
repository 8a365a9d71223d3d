// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/transport/libusb_transfers.hpp"

#include "palpable/core/system/child_process.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <libusb-1.0/libusb.h>
#include <unistd.h>

namespace palpable::device {
namespace {

constexpr unsigned char kIn = 0x81;
constexpr int kInterface = 0;
constexpr std::uint8_t kVendorRequest = 0x40;
constexpr unsigned kControl_ms = 1000;

/// The files of the devices with these numbers.
std::vector<std::string> files_of(UsbIds ids) {
  std::vector<std::string> files;
  libusb_context* context = nullptr;
  if (libusb_init(&context) != 0) return files;
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context, &list);
  for (ssize_t k = 0; k < count; ++k) {
    libusb_device_descriptor about{};
    if (libusb_get_device_descriptor(list[k], &about) != 0) continue;
    if (about.idVendor != ids.vendor || about.idProduct != ids.product) continue;
    std::array<char, 40> name{};
    std::snprintf(name.data(), name.size(), "/dev/bus/usb/%03d/%03d", libusb_get_bus_number(list[k]),
                  libusb_get_device_address(list[k]));
    files.emplace_back(name.data());
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  libusb_exit(context);
  std::ranges::sort(files);
  return files;
}

Error usb_error(int why, const std::string& file) {
  if (why == EACCES || why == EPERM)
    return {ErrorCode::device,
            "this user may not use the USB device; install the rule in docs/devices.md and plug it in again",
            file};
  if (why == EBUSY) return {ErrorCode::device, "the USB device is used by another program", file};
  return {ErrorCode::device, std::string("the USB device cannot be opened (") + std::strerror(why) + ")",
          file};
}

int system_error(int libusb) {
  if (libusb == LIBUSB_ERROR_ACCESS) return EACCES;
  return libusb == LIBUSB_ERROR_BUSY ? EBUSY : EIO;
}

}  // namespace

/// What libusb's callbacks reach. All but `lost` is used by one thread at a time.
struct LibusbTransfers::Usb {
  struct Arrival {
    libusb_transfer* transfer = nullptr;
    Packet bytes{};
    bool pending = false;
    /// Of a packet that has arrived and was not taken; 0: none.
    std::size_t count = 0;
  };

  Descriptor file;
  libusb_context* context = nullptr;
  libusb_device_handle* handle = nullptr;
  std::array<Arrival, 2> arrivals;
  /// The transfer whose packet comes next.
  std::size_t next = 0;
  libusb_transfer* outgoing = nullptr;
  Packet sent{};
  bool sending = false;
  std::atomic<bool> lost{false};

  ~Usb();
  void submit(Arrival& arrival) {
    arrival.count = 0;
    arrival.pending = libusb_submit_transfer(arrival.transfer) == 0;
    if (!arrival.pending) lost = true;
  }
  bool is_busy() const { return sending || arrivals[0].pending || arrivals[1].pending; }
  void turn(double longest_s) {
    timeval time{0, static_cast<suseconds_t>(1e6 * longest_s)};
    libusb_handle_events_timeout_completed(context, &time, nullptr);
  }
  static void on_arrival(libusb_transfer* transfer);
  static void on_sent(libusb_transfer* transfer);
};

LibusbTransfers::Usb::~Usb() {
  for (auto& arrival : arrivals)
    if (arrival.pending) libusb_cancel_transfer(arrival.transfer);
  constexpr int kMostTurns = 100;
  for (int k = 0; k < kMostTurns && is_busy(); ++k) turn(0.01);
  // What is still on its way may not be freed.
  if (!is_busy()) {
    for (auto& arrival : arrivals) libusb_free_transfer(arrival.transfer);
    libusb_free_transfer(outgoing);
  }
  if (handle != nullptr) {
    libusb_release_interface(handle, kInterface);
    libusb_close(handle);
  }
  if (context != nullptr) libusb_exit(context);
}

void LibusbTransfers::Usb::on_arrival(libusb_transfer* transfer) {
  auto& usb = *static_cast<Usb*>(transfer->user_data);
  auto& arrival = transfer == usb.arrivals[0].transfer ? usb.arrivals[0] : usb.arrivals[1];
  arrival.pending = false;
  if (transfer->status == LIBUSB_TRANSFER_COMPLETED)
    arrival.count = static_cast<std::size_t>(transfer->actual_length);
  else if (transfer->status != LIBUSB_TRANSFER_CANCELLED)
    usb.lost = true;
}

void LibusbTransfers::Usb::on_sent(libusb_transfer* transfer) {
  auto& usb = *static_cast<Usb*>(transfer->user_data);
  usb.sending = false;
  if (transfer->status != LIBUSB_TRANSFER_COMPLETED) usb.lost = true;
}

LibusbTransfers::LibusbTransfers(std::unique_ptr<Usb> usb) : usb_(std::move(usb)) {}
LibusbTransfers::~LibusbTransfers() = default;

Result<std::unique_ptr<LibusbTransfers>> LibusbTransfers::open(UsbIds ids, int index) {
  const auto files = files_of(ids);
  if (index < 0 || static_cast<std::size_t>(index) >= files.size())
    return Error{
        ErrorCode::device,
        "there is no such USB device: " + std::to_string(files.size()) + " plugged in, counted from 0",
        std::to_string(index)};
  const std::string& file = files[static_cast<std::size_t>(index)];
  auto usb = std::make_unique<Usb>();
  // Opened here and not by libusb, so that the guardian can have the descriptor too.
  usb->file = Descriptor(::open(file.c_str(), O_RDWR | O_CLOEXEC));
  if (usb->file.number() < 0) return usb_error(errno, file);
  if (libusb_init(&usb->context) != 0) return usb_error(EIO, file);
  if (const int failed = libusb_wrap_sys_device(usb->context, usb->file.number(), &usb->handle); failed != 0)
    return usb_error(system_error(failed), file);
  libusb_set_auto_detach_kernel_driver(usb->handle, 1);
  if (const int failed = libusb_claim_interface(usb->handle, kInterface); failed != 0)
    return usb_error(system_error(failed), file);
  usb->outgoing = libusb_alloc_transfer(0);
  for (auto& arrival : usb->arrivals) {
    arrival.transfer = libusb_alloc_transfer(0);
    if (arrival.transfer == nullptr || usb->outgoing == nullptr) return usb_error(ENOMEM, file);
    libusb_fill_bulk_transfer(arrival.transfer, usb->handle, kIn,
                              reinterpret_cast<unsigned char*>(arrival.bytes.data()),
                              static_cast<int>(arrival.bytes.size()), &Usb::on_arrival, usb.get(), 0);
  }
  for (auto& arrival : usb->arrivals) usb->submit(arrival);
  return std::unique_ptr<LibusbTransfers>(new LibusbTransfers(std::move(usb)));
}

bool LibusbTransfers::control(std::uint8_t request, std::uint16_t value) noexcept {
  return libusb_control_transfer(usb_->handle, kVendorRequest, request, value, 0, nullptr, 0, kControl_ms) >=
         0;
}

bool LibusbTransfers::send(std::span<const std::byte> bytes) noexcept {
  Usb& usb = *usb_;
  if (usb.sending || usb.lost || bytes.size() > usb.sent.size()) return false;
  std::ranges::copy(bytes, usb.sent.begin());
  libusb_fill_bulk_transfer(usb.outgoing, usb.handle, kOut, reinterpret_cast<unsigned char*>(usb.sent.data()),
                            static_cast<int>(bytes.size()), &Usb::on_sent, &usb, 0);
  usb.sending = libusb_submit_transfer(usb.outgoing) == 0;
  if (!usb.sending) usb.lost = true;
  return usb.sending;
}

std::size_t LibusbTransfers::receive(Packet& packet, double longest_s) noexcept {
  Usb& usb = *usb_;
  auto& arrival = usb.arrivals[usb.next];
  if (arrival.count == 0) usb.turn(longest_s);
  if (arrival.count == 0) return 0;
  const std::size_t count = arrival.count;
  packet = arrival.bytes;
  usb.submit(arrival);
  usb.next = 1 - usb.next;
  return count;
}

double LibusbTransfers::now_s() const noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool LibusbTransfers::lost() const noexcept { return usb_->lost.load(std::memory_order_relaxed); }
int LibusbTransfers::descriptor() const noexcept { return usb_->file.number(); }

Result<int> count_usb_devices(UsbIds ids) {
  const auto files = files_of(ids);
  for (const std::string& file : files)
    if (::access(file.c_str(), R_OK | W_OK) != 0) return usb_error(errno, file);
  return static_cast<int>(files.size());
}

}  // namespace palpable::device
