// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/live/camera_link.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace palpable::sources {

/// A camera that sends MJPEG by HTTP.
struct HttpAddress {
  std::string host;
  std::string port = "80";
  /// The path with its query, as the server is asked for it.
  std::string target = "/";
  /// Host and port as the address has them.
  std::string authority;
  /// The address, for sentences.
  std::string shown;
};

/// Connects to a camera that sends MJPEG by HTTP, and asks for its stream. Its link is lost when the
/// connection ends, when what comes is no such stream (MultipartReader), when nothing comes for
/// `silence`, and when no whole picture comes for six times that. The look-up of a name is not limited in
/// time. Errors (invalid_input, without a place): nobody listens there, no answer in time.
Result<std::unique_ptr<CameraLink>> connect_http_camera(
    const HttpAddress& address, std::chrono::milliseconds silence = std::chrono::seconds(5));

}  // namespace palpable::sources
