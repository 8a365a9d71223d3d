// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/net/tcp_stream.hpp"
#include "palpable/formats/picture/jpeg_encoder.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// For tests only: a network camera that sends MJPEG.
namespace palpable::session {

/// JPEGs of a slope with a box that comes nearer from one to the next, both pictures of the pair side by
/// side.
inline std::vector<std::string> moving_pairs(int count) {
  std::vector<std::string> files;
  for (int k = 0; k < count; ++k) {
    auto scene = vision::slanted_scene();
    scene.box_px = 10.0 + 0.5 * k;
    const auto pair = vision::render(scene);
    Raster<Rgb8> both(2 * scene.width, scene.height);
    for (int y = 0; y < scene.height; ++y)
      for (int x = 0; x < 2 * scene.width; ++x) {
        const auto& half = x < scene.width ? pair.left : pair.right;
        const auto level = static_cast<std::uint8_t>(255.0F * *half.pixel(x % scene.width, y));
        both(x, y) = {level, level, level};
      }
    constexpr int kQuality = 92;
    const auto file = formats::encode_jpeg(both, kQuality);
    files.emplace_back(reinterpret_cast<const char*>(file->data()), file->size());
  }
  return files;
}

/// Serves one client after the other at 127.0.0.1, 25 pictures a second, to and fro, until it is destroyed.
class MjpegServer {
 public:
  explicit MjpegServer(std::vector<std::string> pictures, std::uint16_t port = 0)
      : pictures_(std::move(pictures)), listener_(*TcpListener::open("127.0.0.1", port)) {
    thread_ = std::thread([this] { run(); });
  }
  ~MjpegServer() {
    ending_ = true;
    thread_.join();
  }
  MjpegServer(const MjpegServer&) = delete;
  MjpegServer& operator=(const MjpegServer&) = delete;

  std::uint16_t port() const { return listener_.port(); }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port()) + "/video"; }
  /// Whether it sends nothing, though connected.
  std::atomic<bool> is_silent{false};

 private:
  void run() {
    while (!ending_) {
      wait_for_any(std::array{listener_.descriptor()}, std::chrono::milliseconds(5));
      if (auto client = listener_.accept()) serve(*client);
    }
  }
  void serve(TcpStream& client) {
    const auto send = [&](const std::string& text) { client.send(std::as_bytes(std::span(text))); };
    send("HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=--next\r\n\r\n");
    const std::size_t period = 2 * pictures_.size() - 1;
    for (std::size_t k = 0; !ending_ && !client.is_lost(); ++k) {
      const std::size_t at = k % period;
      const std::string& picture = pictures_[at < pictures_.size() ? at : period - at];
      if (!is_silent)
        send("--next\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture.size()) +
             "\r\n\r\n" + picture + "\r\n");
      std::this_thread::sleep_for(std::chrono::milliseconds(40));
    }
  }

  std::vector<std::string> pictures_;
  TcpListener listener_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpable::session
