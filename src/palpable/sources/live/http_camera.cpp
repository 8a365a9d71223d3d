// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/http_camera.hpp"

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/sources/live/multipart_reader.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

class HttpCamera final : public CameraLink {
 public:
  HttpCamera(TcpStream stream, const HttpAddress& address, milliseconds silence)
      : stream_(std::move(stream)), silence_(silence) {
    const std::string request = fmt::format(
        "GET {} HTTP/1.1\r\nHost: {}\r\nUser-Agent: palpable\r\nAccept: */*\r\nConnection: close\r\n\r\n",
        address.target, address.authority);
    stream_.send(std::as_bytes(std::span(request)));
  }

  Result<std::optional<CameraFrame>> next(milliseconds longest) override {
    const auto deadline = Clock::now() + longest;
    do {
      const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
      wait_for_any(std::array{stream_.descriptor()}, std::max(left, milliseconds{0}));
      if (auto read = receive(); !read) return std::move(read).error();
      if (auto part = reader_.take())
        return std::optional(
            CameraFrame{reader_.parts() - 1, last_picture_, CameraCoding::jpeg, 0, 0, *std::move(part)});
    } while (Clock::now() < deadline);
    return std::optional<CameraFrame>();
  }

 private:
  Result<void> receive() {
    constexpr std::size_t kAtOnce = std::size_t{1} << 20U;
    stream_.flush();
    received_.clear();
    const bool is_open = stream_.receive(received_, kAtOnce);
    const auto now = Clock::now();
    const std::uint64_t before = reader_.parts();
    if (auto read = reader_.add({reinterpret_cast<const char*>(received_.data()), received_.size()}); !read)
      return read;
    if (!received_.empty()) last_byte_ = now;
    if (reader_.parts() > before) last_picture_ = now;
    if (!is_open && reader_.parts() == before) return invalid_input("has ended the connection");
    const auto seconds = [](milliseconds time) { return std::chrono::duration<double>(time).count(); };
    constexpr int kSlow = 6;
    if (now - last_byte_ > silence_)
      return invalid_input(fmt::format("has sent nothing for {:.1f} s", seconds(silence_)));
    if (now - last_picture_ > kSlow * silence_)
      return invalid_input(fmt::format("has sent no whole picture for {:.1f} s", seconds(kSlow * silence_)));
    return {};
  }

  TcpStream stream_;
  milliseconds silence_;
  MultipartReader reader_;
  std::vector<std::byte> received_;
  Clock::time_point last_byte_ = Clock::now();
  Clock::time_point last_picture_ = Clock::now();
};

}  // namespace

Result<std::unique_ptr<CameraLink>> connect_http_camera(const HttpAddress& address, milliseconds silence) {
  constexpr milliseconds kLongest{2000};
  auto stream = TcpStream::connect(address.host, address.port, kLongest);
  // Its message speaks of devices' addresses.
  if (!stream) return invalid_input("cannot be reached: " + stream.error().message);
  return std::unique_ptr<CameraLink>(std::make_unique<HttpCamera>(*std::move(stream), address, silence));
}

}  // namespace palpable::sources
