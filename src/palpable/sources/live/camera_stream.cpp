// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/camera_stream.hpp"

#include "palpable/sources/live/frame_folder.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

/// BT.601, 16 ... 235 and 16 ... 240.
Image from_yuyv(const CameraFrame& frame) {
  Image picture{frame.width, frame.height, 3, 8, {}};
  const auto pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  picture.samples.resize(3 * pixels);
  const auto at = [&](std::size_t k) { return static_cast<float>(std::to_integer<int>(frame.bytes[k])); };
  const auto sample = [](float value) { return std::clamp(value / 255.0F, 0.0F, 1.0F); };
  for (std::size_t k = 0; k < pixels; ++k) {
    const std::size_t pair = 4 * (k / 2);
    const float y = 1.164F * (at(2 * k) - 16.0F), u = at(pair + 1) - 128.0F, v = at(pair + 3) - 128.0F;
    float* rgb = picture.samples.data() + 3 * k;
    rgb[0] = sample(y + 1.596F * v);
    rgb[1] = sample(y - 0.392F * u - 0.813F * v);
    rgb[2] = sample(y + 2.017F * u);
  }
  return picture;
}

Image from_rgb(const CameraFrame& frame) {
  Image picture{frame.width, frame.height, 3, 8, {}};
  picture.samples.resize(3 * static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  std::transform(frame.bytes.begin(),
                 frame.bytes.begin() + static_cast<std::ptrdiff_t>(picture.samples.size()),
                 picture.samples.begin(),
                 [](std::byte sample) { return static_cast<float>(std::to_integer<int>(sample)) / 255.0F; });
  return picture;
}

}  // namespace

Result<Image> picture_of(const CameraFrame& frame) {
  if (frame.coding == CameraCoding::jpeg) {
    if (picture_format_of(frame.bytes) != PictureFormat::jpeg)
      return invalid_input("sends pictures that are not JPEG");
    return decode_frame_picture(frame.bytes);
  }
  if (auto size = check_frame_size(frame.width, frame.height); !size) return std::move(size).error();
  const bool is_rgb = frame.coding == CameraCoding::rgb;
  const auto needed = static_cast<std::size_t>(is_rgb ? 3 : 2) * static_cast<std::size_t>(frame.width) *
                      static_cast<std::size_t>(frame.height);
  if ((!is_rgb && frame.width % 2 != 0) || frame.bytes.size() < needed)
    return invalid_input(fmt::format("sends {} bytes of a picture of {} pixels", frame.bytes.size(),
                                     size_text(frame.width, frame.height)));
  return is_rgb ? from_rgb(frame) : from_yuyv(frame);
}

template <class Frame>
Result<std::unique_ptr<CameraStreamOf<Frame>>> CameraStreamOf<Frame>::open(OpenLinkOf<Frame> open,
                                                                           std::string name,
                                                                           std::chrono::milliseconds retry) {
  auto link = open();
  if (!link) {
    link.error().place = name;
    return std::move(link).error();
  }
  std::unique_ptr<CameraStreamOf> stream(new CameraStreamOf(std::move(open), std::move(name), retry));
  stream->thread_ =
      std::thread([raw = stream.get(), first = *std::move(link)]() mutable { raw->run(std::move(first)); });
  return stream;
}

template <class Frame>
CameraStreamOf<Frame>::~CameraStreamOf() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

template <class Frame>
Result<std::optional<Frame>> CameraStreamOf<Frame>::take(std::chrono::steady_clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return newest_ || (lost_ && !came_); });
  if (newest_) return std::exchange(newest_, std::nullopt);
  if (lost_ && !came_) return *lost_;
  return std::optional<Frame>();
}

template <class Frame>
std::optional<std::string> CameraStreamOf<Frame>::loss() {
  const std::lock_guard lock(mutex_);
  return std::exchange(unsaid_, std::nullopt);
}

template <class Frame>
void CameraStreamOf<Frame>::run(std::unique_ptr<CameraLinkOf<Frame>> link) {
  while (!ending_) {
    if (link) lose(follow(*link));
    link.reset();
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, retry_, [&] { return ending_.load(); })) return;
    lock.unlock();
    if (auto again = open_()) link = *std::move(again);
  }
}

/// Why the link was lost.
template <class Frame>
Error CameraStreamOf<Frame>::follow(CameraLinkOf<Frame>& link) {
  constexpr std::chrono::milliseconds kPatience{100};
  const std::uint64_t base = base_;
  while (!ending_) {
    auto frame = link.next(kPatience);
    if (!frame) return std::move(frame).error();
    if (!*frame) continue;
    (*frame)->number += base;
    base_ = (*frame)->number + 1;
    {
      const std::lock_guard lock(mutex_);
      newest_ = *std::move(frame);
      is_here_ = came_ = true;
    }
    changed_.notify_all();
  }
  return {};
}

template <class Frame>
void CameraStreamOf<Frame>::lose(Error error) {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_here_, false))
      unsaid_ =
          fmt::format("The camera {} was lost: it {}. It is tried again every second.", name_, error.message);
    error.place = name_;
    lost_ = std::move(error);
  }
  changed_.notify_all();
}

template class CameraStreamOf<CameraFrame>;
template class CameraStreamOf<DepthFrame>;

}  // namespace palpable::sources
