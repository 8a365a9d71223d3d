// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration_reply.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/isolated/isolated.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace palpable::sources::isolated {
namespace {

// Greater than in any valid calibration.
constexpr std::uint64_t kMostNumbers = 64, kMostNotes = 8;
constexpr std::size_t kLongestNote = 400;

void put_camera(FlatWriter& reply, const CameraModel& camera) {
  reply.put(camera.matrix);
  reply.put(static_cast<std::uint64_t>(camera.distortion.size()));
  reply.put_array(std::span<const double>(camera.distortion));
  reply.put(static_cast<std::int32_t>(camera.width));
  reply.put(static_cast<std::int32_t>(camera.height));
}

CameraModel get_camera(FlatReader& reply) {
  CameraModel camera;
  camera.matrix = reply.get<std::array<double, 9>>();
  const auto numbers = reply.get<std::uint64_t>();
  // An invalid count is rejected when the values are checked.
  camera.distortion = reply.get_array<double>(std::min(numbers, kMostNumbers));
  camera.width = reply.get<std::int32_t>();
  camera.height = reply.get<std::int32_t>();
  return camera;
}

template <class T>
void put_optional(FlatWriter& reply, const std::optional<T>& value) {
  reply.put(static_cast<std::uint8_t>(value.has_value()));
  reply.put(value.value_or(T{}));
}

template <class T>
std::optional<T> get_optional(FlatReader& reply) {
  const bool known = reply.get<std::uint8_t>() == 1;
  const T value = reply.get<T>();
  return known ? std::optional(value) : std::nullopt;
}

}  // namespace

std::vector<std::byte> reply_of(const Calibration& calibration) {
  FlatWriter reply;
  begin_value(reply);
  put_camera(reply, calibration.left);
  reply.put(static_cast<std::uint8_t>(calibration.right.has_value()));
  if (calibration.right) put_camera(reply, *calibration.right);
  put_optional(reply, calibration.rotation);
  put_optional(reply, calibration.translation_m);
  reply.put(static_cast<std::uint64_t>(calibration.notes.size()));
  for (const std::string& note : calibration.notes) reply.put_text(note);
  return reply.take();
}

Result<Calibration> calibration_in(std::span<const std::byte> bytes) {
  FlatReader reply(bytes);
  if (auto opened = open_reply(reply); !opened) return std::move(opened).error();
  Calibration calibration;
  calibration.left = get_camera(reply);
  if (reply.get<std::uint8_t>() == 1) calibration.right = get_camera(reply);
  calibration.rotation = get_optional<std::array<double, 9>>(reply);
  calibration.translation_m = get_optional<Vec3>(reply);
  const auto notes = reply.get<std::uint64_t>();
  for (std::uint64_t k = 0; k < std::min(notes, kMostNotes); ++k)
    calibration.notes.push_back(reply.get_text(kLongestNote));
  if (!reply.done()) return invalid_reply();
  return calibration;
}

Result<Calibration> calibration_from_opencv(std::string_view text) {
  const auto reply = decode(Job::opencv_calibration, as_bytes(text));
  if (!reply) return reply.error();
  return calibration_in(reply->bytes());
}

}  // namespace palpable::sources::isolated
