// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/recording/recording.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/recording/traits_json.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace palpable::device {
namespace {

TouchSample tick_number(std::uint64_t n) {
  const auto x = 1e-4 * static_cast<double>(n);
  TouchSample tick;
  tick.tick = n;
  tick.t_s = 1e-3 * static_cast<double>(n);
  tick.dt_s = 0.001;
  tick.device_position.v = {x, 2.0 * x, 3.0 * x};
  tick.position.v = {4.0 * x, 5.0 * x, 6.0 * x};
  tick.velocity_m_per_s.v = {-x, 0.5, 1.0 / 3.0};
  tick.proxy.v = {7.0 * x, 8.0, 9.0};
  tick.raw_force_N.v = {0.1, x, 2.0};
  tick.written_force_N.v = {0.05, x, 1.0};
  tick.energy_J = -1e-6 * x;
  tick.flags = 5;
  tick.buttons = 2;
  tick.scene_id = 1;
  tick.label = 3;
  tick.status = Status::stale;
  return tick;
}

std::filesystem::path written(std::uint64_t ticks, std::string_view name) {
  const auto file = std::filesystem::path(testing::TempDir()) / name;
  auto writer = RecordingWriter::create(file, R"({"format":1,"seed":7})");
  EXPECT_TRUE(writer);
  EXPECT_TRUE((*writer)->write(RecordedScene{1, R"({"law":"proxy"})"}));
  std::vector<TouchSample> all;
  for (std::uint64_t n = 0; n < ticks; ++n) all.push_back(tick_number(n));
  const auto half = static_cast<std::ptrdiff_t>(ticks / 2);
  EXPECT_TRUE((*writer)->write(std::span(all.begin(), all.begin() + half)));
  EXPECT_TRUE((*writer)->write(std::span(all.begin() + half, all.end())));
  EXPECT_TRUE((*writer)->finish(4));
  return file;
}

TEST(Recording, ComesBackToTheLastBit) {
  const auto recording = read_recording(written(1001, "whole.rec"));
  ASSERT_TRUE(recording) << recording.error().sentence();
  EXPECT_TRUE(recording->complete);
  EXPECT_EQ(recording->lost, 4U);
  EXPECT_EQ(recording->header_json, R"({"format":1,"seed":7})");
  ASSERT_EQ(recording->scenes.size(), 1U);
  EXPECT_EQ(recording->scenes[0].json, R"({"law":"proxy"})");
  ASSERT_EQ(recording->ticks.size(), 1001U);
  for (std::uint64_t n = 0; n < 1001; ++n) ASSERT_EQ(recording->ticks[n], tick_number(n));
}

TEST(Recording, TruncatedAnywhereGivesTheTicksBefore) {
  const auto bytes = *read_file(written(100, "cut.rec"));
  const auto whole = *parse_recording(bytes, "cut.rec");
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const auto cut = parse_recording(std::span(bytes).first(size), "cut.rec");
    if (!cut) {
      EXPECT_EQ(cut.error().code, ErrorCode::invalid_input);
      EXPECT_LT(size, 64U);
      continue;
    }
    EXPECT_FALSE(cut->complete);
    ASSERT_LE(cut->ticks.size(), whole.ticks.size());
    for (std::size_t n = 0; n < cut->ticks.size(); ++n) ASSERT_EQ(cut->ticks[n], whole.ticks[n]);
  }
}

TEST(Recording, DamagedAnywhereNeverGivesWrongTicks) {
  const auto bytes = *read_file(written(100, "damaged.rec"));
  const auto whole = *parse_recording(bytes, "damaged.rec");
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    auto damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<std::byte>(1U << (random() % 8));
    const auto read = parse_recording(damaged, "damaged.rec");
    if (!read) continue;
    ASSERT_LE(read->ticks.size(), whole.ticks.size());
    for (std::size_t n = 0; n < read->ticks.size(); ++n) ASSERT_EQ(read->ticks[n], whole.ticks[n]);
  }
}

TEST(Recording, ASecondHeaderOrAChunkThatIsTooLargeIsDamage) {
  const auto bytes = *read_file(written(100, "blocks.rec"));
  // After the magic: a head of 12 bytes, whose second number is the size of the payload.
  const std::size_t header = 12 + std::to_integer<std::size_t>(bytes[12]);
  const auto read = [&](std::size_t at, std::span<const std::byte> added) {
    auto changed = bytes;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(at), added.begin(), added.end());
    const auto file = std::filesystem::path(testing::TempDir()) / "changed_blocks.rec";
    EXPECT_TRUE(write_file_atomically(file, changed));
    const auto recording = read_recording(file);
    return recording ? std::string() : recording.error().message;
  };
  const std::size_t first = 8 + header;
  EXPECT_EQ(read(first, std::span(bytes).subspan(8, header)),
            "is a recording that is damaged after 0 ticks; its first " + std::to_string(first) +
                " bytes are readable alone");
  const std::array<std::byte, 12> huge{std::byte{'T'}, std::byte{'I'}, std::byte{'C'}, std::byte{'K'},
                                       std::byte{0},   std::byte{0},   std::byte{0},   std::byte{0x7F}};
  EXPECT_EQ(read(bytes.size() - 20, huge), "is a recording that is damaged after 100 ticks; its first " +
                                               std::to_string(bytes.size() - 20) +
                                               " bytes are readable alone");
  EXPECT_EQ(read(bytes.size(), huge), "is a recording with data after its end mark; its first " +
                                          std::to_string(bytes.size()) + " bytes are readable alone");
}

TEST(Recording, SaysWhatItCannotRead) {
  const auto message = [](std::string_view content) {
    const auto read = parse_recording(std::as_bytes(std::span(content.data(), content.size())), "x.rec");
    return read ? std::string() : read.error().sentence();
  };
  EXPECT_EQ(message("hello"), "x.rec: is not a recording");
  EXPECT_EQ(message("PALPREC2........"), "x.rec: is a recording of a newer version than this program reads");
  EXPECT_EQ(message("PALPREC1"), "x.rec: is a recording with a damaged header");
}

// Opening it would wait for a writer.
TEST(Recording, IsNotReadFromAPipe) {
  const auto pipe = std::filesystem::path(testing::TempDir()) / "pipe.rec";
  std::filesystem::remove(pipe);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto read = read_recording(pipe);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("is not a regular file"), std::string::npos) << read.error().message;
}

TEST(Recording, IsNotWrittenIntoAMissingFolder) {
  const auto writer = RecordingWriter::create("/nowhere/at/all.rec", "{}");
  ASSERT_FALSE(writer);
  EXPECT_NE(writer.error().sentence().find("No such file or directory"), std::string::npos);
}

TEST(Recording, KeepsFurtherProbesApartFromTheHand) {
  const auto file = std::filesystem::path(testing::TempDir()) / "probes.rec";
  auto writer = RecordingWriter::create(file, "{}");
  ASSERT_TRUE(writer);
  std::vector<TouchSample> ticks;
  for (std::uint64_t n = 0; n < 10; ++n)
    for (const std::uint8_t probe : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{9}}) {
      ticks.push_back(tick_number(n));
      ticks.back().probe = probe;
    }
  ASSERT_TRUE((*writer)->write(ticks));
  ASSERT_TRUE((*writer)->finish(0));
  const auto read = read_recording(file);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->ticks.size(), 10U);
  ASSERT_EQ(read->further.size(), 20U);
  for (std::size_t n = 0; n < 10; ++n) {
    EXPECT_EQ(read->ticks[n], ticks[3 * n]);
    EXPECT_EQ(read->further[2 * n], ticks[3 * n + 1]);
    EXPECT_EQ(read->further[2 * n + 1], ticks[3 * n + 2]);
  }
}

TEST(Recording, KeepsTurnsTorquesAndComingScenes) {
  const auto file = std::filesystem::path(testing::TempDir()) / "turns.rec";
  auto writer = RecordingWriter::create(file, "{}");
  ASSERT_TRUE(writer);
  std::vector<TouchSample> ticks;
  for (std::uint64_t n = 0; n < 10; ++n) {
    ticks.push_back(tick_number(n));
    ticks.back().device_rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    ticks.back().angular_velocity_rad_per_s.v = {0.1, 0.2, 1.0 / 3.0};
    ticks.back().raw_torque_Nm.v = {1e-3, 2e-3, static_cast<double>(n)};
    ticks.back().written_torque_Nm.v = {0.0, 1e-4, 0.0};
    ticks.back().coming_scene_id = n > 2 && n < 7 ? 5 : 0;
  }
  ASSERT_TRUE((*writer)->write(std::span(ticks).first(4)));
  ASSERT_TRUE((*writer)->write(std::span(ticks).subspan(4)));
  ASSERT_TRUE((*writer)->finish(0));
  const auto read = read_recording(file);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->ticks, ticks);
  auto reader = RecordingReader::open(file);
  ASSERT_TRUE(reader) << reader.error().sentence();
  std::vector<TouchSample> streamed;
  while (const Recording* piece = (*reader)->next())
    streamed.insert(streamed.end(), piece->ticks.begin(), piece->ticks.end());
  EXPECT_EQ((*reader)->end(), RecordingEnd::complete);
  EXPECT_EQ(streamed, ticks);
}

TEST(Replay, GivesTheRecordedPositionsAgainAndIsStaleAfterThem) {
  auto device = open_device("replay:" + written(50, "replay.rec").string(), {});
  ASSERT_TRUE(device) << device.error().sentence();
  EXPECT_FALSE((*device)->traits().pushes_back);
  for (std::uint64_t n = 0; n < 50; ++n) {
    const auto reading = (*device)->read();
    EXPECT_EQ(reading.position, tick_number(n).device_position);
    EXPECT_EQ(reading.buttons, 2U);
  }
  EXPECT_EQ((*device)->fault(), "");
  EXPECT_EQ((*device)->read().status, Status::stale);
  EXPECT_EQ((*device)->fault(), "the recording has ended");
}

TEST(Replay, GivesEveryPositionOfARecordingThatIsLongerThanItReadsAhead) {
  constexpr std::uint64_t kTicks = 100'000;
  auto device = open_device("replay:" + written(kTicks, "long.rec").string(), {});
  ASSERT_TRUE(device) << device.error().sentence();
  for (std::uint64_t n = 0; n < kTicks;) {
    const auto reading = (*device)->read();
    // Readings are requested faster than by a servo: those not available yet arrive later, in order.
    if (!reading.recorded) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(reading.position, tick_number(n).device_position) << n;
    ++n;
  }
  const auto ended = (*device)->read();
  EXPECT_EQ(ended.status, Status::stale);
}

TEST(Replay, ContinuesTheRecordedTimeAfterItsEnd) {
  auto device = open_device("replay:" + written(50, "time.rec").string(), {});
  ASSERT_TRUE(device) << device.error().sentence();
  double before_s = -1.0;
  for (int n = 0; n < 60; ++n) {
    const auto reading = (*device)->read();
    ASSERT_TRUE(reading.recorded) << n;
    EXPECT_GT(reading.recorded->t_s, before_s) << n;
    before_s = reading.recorded->t_s;
  }
}

TEST(Replay, RefusesARecordingThatIsDamagedAndTakesOneThatWasInterrupted) {
  const auto file = written(100, "cut_or_damaged.rec");
  auto bytes = *read_file(file);
  bytes.resize(bytes.size() - 5);
  ASSERT_TRUE(write_file_atomically(file, bytes));
  const auto interrupted = open_device("replay:" + file.string(), {});
  ASSERT_TRUE(interrupted);
  EXPECT_NE((*interrupted)->traits().name.find("interrupted"), std::string::npos);
  bytes[bytes.size() / 2] ^= std::byte{1};
  ASSERT_TRUE(write_file_atomically(file, bytes));
  const auto damaged = open_device("replay:" + file.string(), {});
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().message.find("damaged"), std::string::npos);
}

TEST(Recording, IsNotReplacedWhileAnotherIsBeingWrittenIntoIt) {
  const auto file = std::filesystem::path(testing::TempDir()) / "busy.rec";
  auto first = RecordingWriter::create(file, "{}");
  ASSERT_TRUE(first) << first.error().sentence();
  const auto second = RecordingWriter::create(file, "{}");
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().message.find("another recording"), std::string::npos);
  ASSERT_TRUE((*first)->finish(0));
  EXPECT_TRUE(RecordingWriter::create(file, "{}"));
}

TEST(Recording, ReplacesTheOldOneOnlyWithAReadableFile) {
  const auto file = written(10, "old.rec");
  const auto old = *read_file(file);
  // A reader that has the old file open keeps it, because the file was replaced, not truncated.
  std::FILE* open = std::fopen(file.c_str(), "rb");
  ASSERT_NE(open, nullptr);
  auto writer = RecordingWriter::create(file, "{}");
  ASSERT_TRUE(writer);
  std::vector<std::byte> kept(old.size() + 1);
  EXPECT_EQ(std::fread(kept.data(), 1, kept.size(), open), old.size());
  std::fclose(open);
  EXPECT_TRUE(read_recording(file)) << "readable from its first moment on";
}

TEST(RecordedTraits, HaveThePeriodOfASensorUnlessTheyAreOlder) {
  Traits traits;
  traits.sensor_period_s = 0.004;
  const std::string text = traits_json(traits);
  const auto kept = recorded_traits(R"({"traits":)" + text + "}");
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->sensor_period_s, 0.004);
  constexpr std::string_view kMember = R"("sensor_period_s":0.004,)";
  std::string older = text;
  older.erase(older.find(kMember), kMember.size());
  const auto read = recorded_traits(R"({"traits":)" + older + "}");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sensor_period_s, 0.0);
}

TEST(Replay, RefusesARecordingWithoutATick) {
  const auto file = std::filesystem::path(testing::TempDir()) / "empty.rec";
  ASSERT_TRUE((*RecordingWriter::create(file, "{}"))->finish(0));
  const auto device = open_device("replay:" + file.string(), {});
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace palpable::device
