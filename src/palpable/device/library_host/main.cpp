// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Loads a vendor's library in a process of its own (docs/adr/0012), with the descriptors of
// device/hosted/exchange.hpp:
//   serve URL RATE   opens the device, writes its traits in a line, and serves it until the pipe of the
//   program
//                    that started it is closed; then it frees the motors and closes the device
//   free URL         opens the device and closes it again, which frees its motors
//   ports SCHEME     writes where devices may be plugged in, each with a space before it; then "+"
// An error is written as "-CODE", place and message, each in a line.
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/hosted/exchange.hpp"
#include "palpable/device/library_host/serve.hpp"
#include "palpable/device/recording/traits_json.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

namespace {

using palpable::Error;

/// False: nobody reads it.
bool answer(const std::string& text) {
  return ::write(palpable::device::kHostAnswer, text.data(), text.size()) ==
         static_cast<ssize_t>(text.size());
}

int answer_error(const Error& error) {
  const auto line = [](std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text + "\n";
  };
  answer("-" + std::to_string(static_cast<int>(error.code)) + "\n" + line(error.place) + line(error.message));
  return static_cast<int>(error.code);
}

int serve(const std::string& url, double rate_hz) {
  using namespace palpable::device;
  void* mapped = ::mmap(nullptr, sizeof(HostExchange), PROT_READ | PROT_WRITE, MAP_SHARED, kHostMemory, 0);
  if (mapped == MAP_FAILED) return EXIT_FAILURE;
  OpenOptions options;
  options.rate_hz = rate_hz;
  options.vendor_library = VendorLibrary::here;
  auto device = open_device(url, options);
  if (!device) return answer_error(device.error());
  auto& shared = *static_cast<HostExchange*>(mapped);
  LibraryHost host(**device, shared);
  if (!answer("{\"traits\":" + traits_json((*device)->traits()) + "}\n")) return EXIT_FAILURE;
  host.serve();
  device->reset();
  host.note_closed();
  return EXIT_SUCCESS;
}

int free_motors(const std::string& url) {
  palpable::device::OpenOptions options;
  options.vendor_library = palpable::device::VendorLibrary::here_to_free_motors;
  return palpable::device::open_device(url, options) ? EXIT_SUCCESS : EXIT_FAILURE;
}

int list_ports(const std::string& scheme) {
  const auto ports = palpable::device::vendor_ports(scheme);
  if (!ports) return answer_error(ports.error());
  std::string lines;
  for (const std::string& port : *ports) lines += " " + port + "\n";
  return answer(lines + "+\n") ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kWrongUsage = 2;
  if (argc < 3) return kWrongUsage;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGPIPE}) std::signal(number, SIG_IGN);
  if (!answer(std::string(palpable::device::kHostGreeting) + "\n")) return kWrongUsage;
  const std::string_view work = argv[1];
  int code = kWrongUsage;
  if (work == "serve" && argc == 4) code = serve(argv[2], std::atof(argv[3]));
  if (work == "free") code = free_motors(argv[2]);
  if (work == "ports") code = list_ports(argv[2]);
  // What the library does at the end of a process must not change the answer.
  ::_exit(code);
}
