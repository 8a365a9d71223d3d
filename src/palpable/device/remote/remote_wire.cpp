// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/remote_wire.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/byte_writer.hpp"
#include "palpable/core/files/crc32.hpp"
#include "palpable/core/text/plain_text.hpp"
#include "palpable/device/recording/traits_json.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace palpable::device {
namespace {

constexpr std::uint8_t kFirstLetter = 'P', kSecondLetter = 'R', kRemoteVersion = 3;
/// What a reader keeps at most: a whole message, and what came with it.
constexpr std::size_t kMostKept_bytes = std::size_t{64} << 10U;

std::vector<std::byte> remote_message(MessageKind kind, std::span<const std::byte> body) {
  PALPABLE_CHECK(body.size() <= kMostBody_bytes);
  ByteWriter out;
  out.u8(kFirstLetter);
  out.u8(kSecondLetter);
  out.u8(kRemoteVersion);
  out.u8(static_cast<std::uint8_t>(kind));
  out.u16(static_cast<std::uint16_t>(body.size()));
  out.u32(crc32(body));
  std::vector<std::byte> bytes(out.bytes().begin(), out.bytes().end());
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

std::vector<std::byte> remote_message(MessageKind kind, std::string_view body) {
  return remote_message(kind, as_bytes(body));
}

void put_vec3(ByteWriter& out, Vec3 v) {
  out.f64(v.x);
  out.f64(v.y);
  out.f64(v.z);
}

Vec3 vec3_from(ByteReader& in) {
  const double x = in.f64();
  const double y = in.f64();
  const double z = in.f64();
  return {x, y, z};
}

}  // namespace

std::string_view sentence_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::wrong_token:
      return "the token of the address is wrong or was used already; take the address that palpable share "
             "prints now: it prints a new one a minute after a program was lost without taking leave";
    case Refusal::in_use:
      return "another program touches with this device already";
    case Refusal::wrong_version:
      return "it is shared by another version of Palpable, which does not understand this one";
    case Refusal::not_understood:
      break;
  }
  return "it did not understand what this program sent";
}

std::vector<std::byte> hello_message(std::string_view secret) {
  return remote_message(MessageKind::hello, secret);
}

std::vector<std::byte> welcome_message(std::string_view secret, const Traits& traits) {
  PALPABLE_CHECK(secret.size() == kSecret_bytes);
  Traits shown = traits;
  constexpr std::size_t kLongestName = 200;
  if (shown.name.size() > kLongestName) shown.name.resize(kLongestName);
  // Torques are not passed on.
  shown.has_torque = false;
  return remote_message(MessageKind::welcome,
                        std::string(secret) + "{\"traits\":" + traits_json(shown) + "}");
}

std::vector<std::byte> refused_message(Refusal refusal) {
  ByteWriter out;
  out.u8(static_cast<std::uint8_t>(refusal));
  return remote_message(MessageKind::refused, out.bytes());
}

std::vector<std::byte> reading_message(const RemoteReading& reading) {
  ByteWriter out;
  out.f64(reading.read_at_s);
  put_vec3(out, reading.position.v);
  out.u8(static_cast<std::uint8_t>(reading.status));
  out.u32(reading.buttons);
  return remote_message(MessageKind::reading, out.bytes());
}

std::vector<std::byte> surface_message(const LocalSurface& surface) {
  ByteWriter out;
  out.u8(static_cast<std::uint8_t>(surface.kind));
  for (const Vec3 v :
       {surface.hand.v, surface.place.v, surface.normal.v, surface.force_N.v, surface.pull_N.v})
    put_vec3(out, v);
  for (const double number :
       {surface.radius_m, surface.stiffness_N_per_m, surface.damping_Ns_per_m, surface.static_friction,
        surface.dynamic_friction, surface.stored_J, surface.read_at_s, surface.pull_reserve_J,
        surface.transient.force_per_speed_Ns_per_m, surface.transient.frequency_hz,
        surface.transient.decay_per_s})
    out.f64(number);
  const LaidTexture& laid = surface.texture;
  out.u16(laid.number);
  if (laid.number > 0) {
    out.u8(static_cast<std::uint8_t>(laid.onto));
    for (const double number : laid.rotation) out.f64(number);
    put_vec3(out, laid.translation_m);
    out.f64(laid.scale);
  }
  return remote_message(MessageKind::surface, out.bytes());
}

std::vector<std::byte> texture_message(const LocalTexture& texture) {
  PALPABLE_CHECK(texture.tile.size() <= kMostTile);
  ByteWriter out;
  out.u16(texture.number);
  out.u8(texture.kind);
  for (const double number : {texture.pitch_m, texture.height_m, texture.angle_rad}) out.f64(number);
  for (const float value : texture.tile) out.u32(std::bit_cast<std::uint32_t>(value));
  return remote_message(MessageKind::texture, out.bytes());
}

std::vector<std::byte> bye_message() { return remote_message(MessageKind::bye, std::string_view{}); }

std::optional<std::string> parse_hello(const Message& message) {
  if (message.kind != MessageKind::hello || message.body.size() != kSecret_bytes) return {};
  return std::string(as_text(message.body));
}

std::optional<Welcome> parse_welcome(const Message& message) {
  if (message.kind != MessageKind::welcome || message.body.size() <= kSecret_bytes) return {};
  const std::string_view text = as_text(message.body);
  auto traits = recorded_traits(std::string(text.substr(kSecret_bytes)));
  if (!traits || !check(*traits)) return {};
  traits->name = plain_name(traits->name);
  return Welcome{std::string(text.substr(0, kSecret_bytes)), *std::move(traits)};
}

std::optional<Refusal> parse_refused(const Message& message) {
  if (message.kind != MessageKind::refused || message.body.size() != 1) return {};
  const auto number = std::to_integer<std::uint8_t>(message.body.front());
  const bool known = number >= 1 && number <= static_cast<std::uint8_t>(Refusal::not_understood);
  return known ? static_cast<Refusal>(number) : Refusal::not_understood;
}

std::optional<RemoteReading> parse_reading(const Message& message) {
  ByteReader in(message.body);
  RemoteReading reading;
  reading.read_at_s = in.f64();
  reading.position.v = vec3_from(in);
  const std::uint8_t status = in.u8();
  reading.buttons = in.u32();
  constexpr double kFar_m = 100.0;
  const bool valid = message.kind == MessageKind::reading && in.ok() && in.left() == 0 &&
                     reading.read_at_s >= 0.0 && reading.read_at_s < 1e12 &&
                     norm(reading.position.v) < kFar_m && status <= static_cast<std::uint8_t>(Status::fault);
  if (!valid) return {};
  reading.status = static_cast<Status>(status);
  return reading;
}

std::optional<LocalSurface> parse_surface(const Message& message) {
  ByteReader in(message.body);
  LocalSurface surface;
  surface.kind = static_cast<LocalSurface::Kind>(in.u8());
  for (Vec3* v :
       {&surface.hand.v, &surface.place.v, &surface.normal.v, &surface.force_N.v, &surface.pull_N.v})
    *v = vec3_from(in);
  for (double* number :
       {&surface.radius_m, &surface.stiffness_N_per_m, &surface.damping_Ns_per_m, &surface.static_friction,
        &surface.dynamic_friction, &surface.stored_J, &surface.read_at_s, &surface.pull_reserve_J,
        &surface.transient.force_per_speed_Ns_per_m, &surface.transient.frequency_hz,
        &surface.transient.decay_per_s})
    *number = in.f64();
  LaidTexture& laid = surface.texture;
  laid.number = in.u16();
  if (laid.number > 0) {
    laid.onto = static_cast<LaidTexture::Onto>(in.u8());
    for (double& number : laid.rotation) number = in.f64();
    laid.translation_m = vec3_from(in);
    laid.scale = in.f64();
  }
  if (message.kind != MessageKind::surface || !in.ok() || in.left() != 0 || !is_valid(surface)) return {};
  return surface;
}

std::optional<LocalTexture> parse_texture(const Message& message) {
  ByteReader in(message.body);
  LocalTexture texture;
  texture.number = in.u16();
  texture.kind = in.u8();
  for (double* number : {&texture.pitch_m, &texture.height_m, &texture.angle_rad}) *number = in.f64();
  const std::size_t values = in.left() / sizeof(float);
  if (message.kind != MessageKind::texture || !in.ok() || values > kMostTile) return {};
  texture.tile.resize(values);
  for (float& value : texture.tile) value = in.f32();
  const bool is_numbered = texture.number > 0 && texture.number <= kMostTextures;
  return is_numbered && in.ok() && in.left() == 0 ? std::optional(std::move(texture)) : std::nullopt;
}

bool MessageReader::take(std::span<const std::byte> bytes) {
  broken_ = broken_ || bytes_.size() + bytes.size() > kMostKept_bytes;
  if (!broken_) bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return !broken_;
}

std::optional<Message> MessageReader::next() {
  if (broken_) return {};
  ByteReader in(bytes_);
  constexpr std::size_t kLetters = 3;
  if (bytes_.size() >= kLetters) {
    const bool ours = in.u8() == kFirstLetter && in.u8() == kSecondLetter;
    other_version_ = ours && in.u8() != kRemoteVersion;
    broken_ = !ours || other_version_;
  }
  if (broken_ || bytes_.size() < kMessageHead_bytes) return {};
  Message found;
  found.kind = static_cast<MessageKind>(in.u8());
  const std::size_t length = in.u16();
  const std::uint32_t sum = in.u32();
  if (length > kMostBody_bytes) return broken_ = true, std::nullopt;
  if (in.left() < length) return {};
  const auto body = in.bytes(length);
  if (crc32(body) != sum) return broken_ = true, std::nullopt;
  found.body.assign(body.begin(), body.end());
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(kMessageHead_bytes + length));
  return found;
}

}  // namespace palpable::device
