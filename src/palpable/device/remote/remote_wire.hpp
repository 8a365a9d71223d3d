// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/local_surface.hpp"
#include "palpable/device/local_textures.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The messages between two Palpables, one with a device (the host) and one with a scene (the client). Each is
// a head of 10 bytes (two letters, the version, the kind, the length and CRC-32 of what follows) and at most
// kMostBody_bytes, little-endian.
namespace palpable::device {

inline constexpr std::size_t kMessageHead_bytes = 10;
inline constexpr std::size_t kMostBody_bytes = 17U << 10U;
/// Control values of a texture's tile.
inline constexpr std::size_t kMostTile = std::size_t{64} * 64;
/// Characters of a token and of a session's secret.
inline constexpr std::size_t kSecret_bytes = 32;

enum class MessageKind : std::uint8_t {
  /// The client's first: a token, or the secret of the session that it had.
  hello = 1,
  /// The host's answer: the session's secret, and the device's traits (traits_json()).
  welcome = 2,
  /// The host's answer instead; it then closes the connection.
  refused = 3,
  reading = 4,
  surface = 5,
  /// Either side ends the session.
  bye = 6,
  /// The client's: a texture that surfaces name.
  texture = 7
};

enum class Refusal : std::uint8_t { wrong_token = 1, in_use = 2, wrong_version = 3, not_understood = 4 };
/// "the token of the address is wrong or was used already; ...".
std::string_view sentence_of(Refusal refusal);

/// What the host's servo read.
struct RemoteReading {
  /// By the host's clock, seconds, >= 0.
  double read_at_s = 0.0;
  Point<DeviceFrame> position;
  Status status = Status::not_ready;
  std::uint32_t buttons = 0;
};

struct Message {
  MessageKind kind = MessageKind::bye;
  std::vector<std::byte> body;
};

/// Whole messages.
std::vector<std::byte> hello_message(std::string_view secret);
std::vector<std::byte> welcome_message(std::string_view secret, const Traits& traits);
std::vector<std::byte> refused_message(Refusal refusal);
std::vector<std::byte> reading_message(const RemoteReading& reading);
std::vector<std::byte> surface_message(const LocalSurface& surface);
/// The tile must have at most kMostTile values.
std::vector<std::byte> texture_message(const LocalTexture& texture);
std::vector<std::byte> bye_message();

/// A body; nullopt if it is none of that kind, or has values that are out of range or not finite.
std::optional<std::string> parse_hello(const Message& message);
struct Welcome {
  std::string secret;
  Traits traits;
};
std::optional<Welcome> parse_welcome(const Message& message);
std::optional<Refusal> parse_refused(const Message& message);
std::optional<RemoteReading> parse_reading(const Message& message);
std::optional<LocalSurface> parse_surface(const Message& message);
/// Whether a texture of this kind has these values is not checked.
std::optional<LocalTexture> parse_texture(const Message& message);

/// Finds the messages in a stream of bytes from an untrusted peer, in bounded memory.
class MessageReader {
 public:
  /// Appends bytes. False, and from then on always, if they can belong to no message of this version.
  bool take(std::span<const std::byte> bytes);
  /// The next whole message. nullopt: none yet, or is_broken().
  std::optional<Message> next();
  bool is_broken() const { return broken_; }
  /// The stream began as messages do, but of another version.
  bool is_other_version() const { return other_version_; }

 private:
  std::vector<std::byte> bytes_;
  bool broken_ = false;
  bool other_version_ = false;
};

}  // namespace palpable::device
