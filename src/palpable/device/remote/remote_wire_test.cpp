// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/remote/remote_wire.hpp"

#include "palpable/device/drivers/open.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

std::optional<Message> read_back(std::span<const std::byte> bytes) {
  MessageReader reader;
  reader.take(bytes);
  return reader.next();
}

LocalSurface a_plane() {
  LocalSurface surface;
  surface.kind = LocalSurface::Kind::plane;
  surface.hand.v = {0.01, -0.02, 0.003};
  surface.place.v = {0.01, -0.02, 0.004};
  surface.normal.v = {0.0, 0.6, 0.8};
  surface.stiffness_N_per_m = 512.25;
  surface.damping_Ns_per_m = 1.5;
  surface.static_friction = 0.3;
  surface.dynamic_friction = 0.25;
  surface.stored_J = -1e-3;
  surface.force_N.v = {0.1, 0.2, -0.3};
  surface.read_at_s = 12.5;
  surface.pull_N.v = {0.2, 0.1, 0.0};
  surface.pull_reserve_J = 0.012;
  surface.transient = {4.0, 100.0, 80.0};
  return surface;
}

TEST(RemoteWire, ReturnsSurfacesAndReadingsToTheLastBit) {
  const auto message = read_back(surface_message(a_plane()));
  ASSERT_TRUE(message);
  EXPECT_EQ(parse_surface(*message), a_plane());
  RemoteReading reading{3.25, {{0.1, 0.2, 0.3}}, Status::ok, 5};
  const auto sent = read_back(reading_message(reading));
  ASSERT_TRUE(sent);
  const auto read = parse_reading(*sent);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->position, reading.position);
  EXPECT_EQ(read->read_at_s, reading.read_at_s);
  EXPECT_EQ(read->buttons, 5U);
  EXPECT_FALSE(parse_surface(*sent));
}

LocalTexture a_texture() {
  LocalTexture texture{3, 4, 0.002, 25e-6, 0.7, std::vector<float>(kMostTile)};
  for (std::size_t k = 0; k < texture.tile.size(); ++k)
    texture.tile[k] = 0.25F * static_cast<float>(k % 7) - 0.5F;
  return texture;
}

TEST(RemoteWire, ReturnsTexturesAndHowTheyLieToTheLastBit) {
  const auto message = read_back(texture_message(a_texture()));
  ASSERT_TRUE(message);
  EXPECT_EQ(parse_texture(*message), a_texture());
  EXPECT_FALSE(parse_surface(*message));
  LocalSurface surface = a_plane();
  surface.texture = {3, LaidTexture::Onto::solid, {0, -1, 0, 1, 0, 0, 0, 0, 1}, {0.01, 0.02, 0.03}, 1.5};
  const auto laid = read_back(surface_message(surface));
  ASSERT_TRUE(laid);
  EXPECT_EQ(parse_surface(*laid), surface);
}

TEST(RemoteWire, BelievesNoTextureThatIsOutOfRange) {
  LocalTexture texture = a_texture();
  texture.number = 0;
  EXPECT_FALSE(parse_texture(*read_back(texture_message(texture))));
  texture.number = kMostTextures + 1;
  EXPECT_FALSE(parse_texture(*read_back(texture_message(texture))));
  for (const double bad : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    LocalSurface surface = a_plane();
    surface.texture.number = 3;
    surface.texture.scale = bad;
    EXPECT_FALSE(parse_surface(*read_back(surface_message(surface)))) << bad;
  }
  LocalSurface surface = a_plane();
  surface.texture.number = 3;
  surface.texture.rotation[4] = 2.0;
  EXPECT_FALSE(parse_surface(*read_back(surface_message(surface))));
}

TEST(RemoteWire, PassesTraitsOn) {
  Traits traits;
  traits.name = "omega.3\n\x1b[2J";
  traits.max_force_N = 7.5;
  traits.mass_kg = 0.2;
  const auto message = read_back(welcome_message(std::string(kSecret_bytes, 'a'), traits));
  ASSERT_TRUE(message);
  const auto welcome = parse_welcome(*message);
  ASSERT_TRUE(welcome);
  EXPECT_EQ(welcome->secret, std::string(kSecret_bytes, 'a'));
  EXPECT_EQ(welcome->traits.max_force_N, 7.5);
  EXPECT_EQ(welcome->traits.mass_kg, 0.2);
  EXPECT_EQ(welcome->traits.name.find('\x1b'), std::string::npos);
  traits.max_force_N = 1000.0;
  EXPECT_FALSE(parse_welcome(*read_back(welcome_message(std::string(kSecret_bytes, 'a'), traits))));
}

TEST(RemoteWire, BelievesNoValueThatIsNoneOrOutOfRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInfinite, -kInfinite, 1e300}) {
    for (double LocalSurface::*member :
         {&LocalSurface::stiffness_N_per_m, &LocalSurface::damping_Ns_per_m, &LocalSurface::static_friction,
          &LocalSurface::dynamic_friction, &LocalSurface::radius_m, &LocalSurface::stored_J,
          &LocalSurface::read_at_s, &LocalSurface::pull_reserve_J}) {
      LocalSurface surface = a_plane();
      surface.*member = bad;
      EXPECT_FALSE(parse_surface(*read_back(surface_message(surface)))) << bad;
    }
    for (double ContactTransient::*member :
         {&ContactTransient::force_per_speed_Ns_per_m, &ContactTransient::frequency_hz,
          &ContactTransient::decay_per_s}) {
      LocalSurface surface = a_plane();
      surface.transient.*member = bad;
      EXPECT_FALSE(parse_surface(*read_back(surface_message(surface)))) << bad;
    }
    for (int k = 0; k < 5; ++k) {
      LocalSurface surface = a_plane();
      (k == 0   ? surface.hand.v
       : k == 1 ? surface.place.v
       : k == 2 ? surface.normal.v
       : k == 3 ? surface.pull_N.v
                : surface.force_N.v)
          .y = bad;
      EXPECT_FALSE(parse_surface(*read_back(surface_message(surface)))) << bad << " " << k;
    }
    EXPECT_FALSE(parse_reading(*read_back(reading_message({bad, {}, Status::ok, 0}))));
    EXPECT_FALSE(parse_reading(*read_back(reading_message({1.0, {{0.0, bad, 0.0}}, Status::ok, 0}))));
  }
  LocalSurface surface = a_plane();
  surface.kind = static_cast<LocalSurface::Kind>(9);
  EXPECT_FALSE(parse_surface(*read_back(surface_message(surface))));
  // A vibration that never ends.
  surface = a_plane();
  surface.transient.decay_per_s = 0.0;
  EXPECT_FALSE(parse_surface(*read_back(surface_message(surface))));
}

TEST(RemoteWire, FindsMessagesInPieces) {
  const auto bytes = surface_message(a_plane());
  MessageReader reader;
  for (std::size_t k = 0; k + 1 < bytes.size(); ++k) {
    reader.take(std::span(bytes).subspan(k, 1));
    EXPECT_FALSE(reader.next());
  }
  reader.take(std::span(bytes).last(1));
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.is_broken());
}

TEST(RemoteWire, EndsAtBytesThatAreNoMessage) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    auto bytes = surface_message(a_plane());
    bytes[random() % bytes.size()] ^= static_cast<std::byte>(1U << (random() % 8U));
    MessageReader reader;
    reader.take(bytes);
    const auto message = reader.next();
    // A changed kind is no surface; a changed length waits for more, or is too long.
    EXPECT_FALSE(message && parse_surface(*message));
  }
  MessageReader reader;
  for (int k = 0; k < 100; ++k) reader.take(std::vector<std::byte>(4096, std::byte{'P'}));
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.is_broken());
  MessageReader other;
  auto next_version = hello_message(std::string(kSecret_bytes, 'x'));
  next_version[2] = std::byte{4};
  other.take(next_version);
  EXPECT_FALSE(other.next());
  EXPECT_TRUE(other.is_other_version());
}

TEST(RemoteUrl, IsRefusedIfItIsIncomplete) {
  const std::string token = "?token=" + std::string(kSecret_bytes, 'a');
  for (const std::string& url :
       {std::string("remote:"), "remote:host" + token, "remote:host:" + token, "remote::7" + token,
        "remote:host:99999" + token, "remote:host:x" + token, std::string("remote:host:7"),
        std::string("remote:host:7?token=short"), "remote:host:7" + token + "&other=1"})
    EXPECT_EQ(open_device(url, {}).error().code, ErrorCode::usage) << url;
  const auto nobody = open_device("remote:127.0.0.1:1" + token, {});
  EXPECT_EQ(nobody.error().code, ErrorCode::device);
  EXPECT_NE(nobody.error().message.find("nobody shares a device there"), std::string::npos)
      << nobody.error().message;
  const auto unknown = open_device("remote:nohost.invalid:7" + token, {});
  EXPECT_EQ(unknown.error().code, ErrorCode::device);
  EXPECT_EQ(unknown.error().message.find("the name of the computer is no address"), 0U)
      << unknown.error().message;
}

}  // namespace
}  // namespace palpable::device
