// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/live/camera_link.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace palpable::sources {

/// A camera that sends video by RTSP, or MJPEG by HTTPS.
struct StreamAddress {
  /// rtsp://, rtsps:// or https://, with a name and a password if the camera asks for them.
  std::string url;
  /// Of rtsps:// and https://: take any certificate, so that anybody between here and the camera can read and
  /// change what it sends.
  bool takes_any_certificate = false;
  /// The address without name and password, for sentences.
  std::string shown;
};

/// Starts the process that connects to this camera and decodes what it sends (palpable-stream-decoder), and
/// does not wait for it. The link gives RGB pictures. It is lost when the camera cannot be reached, asks for
/// a password, has a certificate that is not trusted, has no such stream or no video that can be read, ends
/// the connection, sends nothing for 5 s (10 s at the beginning), when its pictures are larger than
/// kMostFramePixels, and when the process crashes. The look-up of a name is limited to the 10 s, too. Errors
/// (failed, without a place): the program is missing or cannot be started.
Result<std::unique_ptr<CameraLink>> connect_stream_camera(const StreamAddress& address);

}  // namespace palpable::sources
