// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/depth_camera_source.hpp"

#include "palpable/sources/live/camera_stream.hpp"

#include <utility>

namespace palpable::session {
namespace {

class DepthCameraSource final : public LiveSource {
 public:
  explicit DepthCameraSource(std::unique_ptr<sources::DepthCameraStream> stream)
      : stream_(std::move(stream)) {}

  Result<std::optional<LiveFrame>> take(std::chrono::steady_clock::time_point deadline) override {
    auto newest = stream_->take(deadline);
    if (!newest) return std::move(newest).error();
    if (!*newest) return std::optional<LiveFrame>();
    if ((*newest)->colour) colour_ = std::move((*newest)->colour);
    return std::optional(LiveFrame{(*newest)->number, (*newest)->arrival, std::move((*newest)->depth)});
  }
  bool has_ended() const override { return false; }
  std::optional<Image> colour() override { return std::exchange(colour_, std::nullopt); }
  std::optional<std::string> loss() override { return stream_->loss(); }

 private:
  std::unique_ptr<sources::DepthCameraStream> stream_;
  /// The newest that came with a frame or before it.
  std::optional<Image> colour_;
};

}  // namespace

Result<std::unique_ptr<LiveSource>> open_depth_camera_source(const sources::DepthCamera& camera,
                                                             std::string address) {
  auto stream = sources::DepthCameraStream::open([camera] { return sources::open_depth_camera(camera); },
                                                 std::move(address));
  if (!stream) return std::move(stream).error();
  return std::unique_ptr<LiveSource>(std::make_unique<DepthCameraSource>(*std::move(stream)));
}

}  // namespace palpable::session
