// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/export_recording.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/formats/packing/npz.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::session {
namespace {

device::Recording two_ticks() {
  device::Recording recording;
  recording.ticks.resize(2);
  recording.ticks[1].tick = 1;
  recording.ticks[1].t_s = 0.001;
  recording.ticks[1].position.v = {0.01, -0.02, 0.03};
  recording.ticks[1].raw_force_N.v = {0.0, 0.0, 1.5};
  recording.ticks[1].device_position.v.x = std::numeric_limits<double>::quiet_NaN();
  recording.ticks[1].label = 7;
  return recording;
}

namespace fs = std::filesystem;

/// Written in pieces, as a recorder does.
fs::path recorded(const device::Recording& recording) {
  const fs::path file = fs::path(testing::TempDir()) / (std::to_string(getpid()) + "-export.rec");
  auto writer = device::RecordingWriter::create(file, "{}");
  EXPECT_TRUE(writer);
  for (std::size_t i = 0; i < recording.ticks.size(); ++i) {
    std::vector<device::TouchSample> together{recording.ticks[i]};
    if (i < recording.further.size()) together.push_back(recording.further[i]);
    EXPECT_TRUE((*writer)->write(together));
  }
  EXPECT_TRUE((*writer)->finish(0));
  return file;
}

std::string recording_csv(const device::Recording& recording) {
  const fs::path output = fs::path(testing::TempDir()) / "export.csv";
  const auto exported = export_recording(recorded(recording), output, {});
  EXPECT_TRUE(exported && exported->complete && exported->ticks == recording.ticks.size());
  const auto text = read_file(output);
  return text ? std::string(as_text(*text)) : std::string();
}

TEST(ExportRecording, WritesALineATickWithNamedColumns) {
  const std::string text = recording_csv(two_ticks());
  EXPECT_TRUE(
      text.starts_with("tick,t_s,dt_s,energy_J,flags,buttons,program,label,status,probe,device_x_m,"));
  EXPECT_NE(text.find("\n1,0.001,0,0,0,0,0,7,0,0,,0,0,0.01,-0.02,0.03,"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(ExportRecording, PutsFurtherProbesBetweenTheHandsTicksByTime) {
  auto recording = two_ticks();
  recording.further = {recording.ticks[0], recording.ticks[1]};
  for (auto& tick : recording.further) tick.probe = 3;
  const std::string text = recording_csv(recording);
  const std::vector<std::string> begins{"\n0,0,0,0,0,0,0,0,0,0,", "\n0,0,0,0,0,0,0,0,0,3,",
                                        "\n1,0.001,0,0,0,0,0,7,0,0,", "\n1,0.001,0,0,0,0,0,7,0,3,"};
  std::size_t at = 0;
  for (const auto& begin : begins) {
    const auto next = text.find(begin, at);
    ASSERT_NE(next, std::string::npos) << begin << " in\n" << text;
    at = next;
  }
}

TEST(ExportRecording, WritesArraysThatNumPyReads) {
  const auto file = fs::path(testing::TempDir()) / "touch.npz";
  ASSERT_TRUE(export_recording(recorded(two_ticks()), file, {}));
  const auto arrays = formats::read_npz(file);
  ASSERT_TRUE(arrays) << arrays.error().sentence();
  const auto& position = arrays->at("position_m");
  EXPECT_EQ(position.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(position.number(4), -0.02);
  EXPECT_EQ(arrays->at("label").number(1), 7.0);
}

TEST(ExportRecording, WritesATruncatedRecordingUpToThereAndNothingOfADamagedOne) {
  const auto file = recorded(two_ticks());
  const auto bytes = *read_file(file);
  const auto exported = [&](std::span<const std::byte> content, const char* name) {
    EXPECT_TRUE(write_file_atomically(file, content));
    return export_recording(file, fs::path(testing::TempDir()) / name, {});
  };
  auto damaged = bytes;
  damaged[damaged.size() - 100] ^= std::byte{1};
  for (const char* name : {"part.csv", "part.npz"}) {
    const fs::path output = fs::path(testing::TempDir()) / name;
    fs::remove(output);
    const auto refused = exported(damaged, name);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
    EXPECT_NE(refused.error().message.find("damaged after 1 tick"), std::string::npos)
        << refused.error().message;
    EXPECT_FALSE(fs::exists(output));
    const auto cut = exported(std::span(bytes).first(bytes.size() - 30), name);
    ASSERT_TRUE(cut) << cut.error().sentence();
    EXPECT_FALSE(cut->complete);
    EXPECT_EQ(cut->ticks, 1U);
  }
}

TEST(ExportRecording, RefusesAnotherEnding) {
  const auto written = export_recording(recorded(two_ticks()), "touch.txt", {});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::usage);
}

TEST(ExportRecording, IntoAFileThatIsBeingRecordedIsRefused) {
  const fs::path file = fs::path(testing::TempDir()) / "busy.rec";
  const auto first = device::RecordingWriter::create(file, "{\"first\":1}");
  ASSERT_TRUE(first);
  EXPECT_FALSE(device::RecordingWriter::create(file, "{}"));
  ASSERT_TRUE((*first)->finish(0));
  const auto kept = device::read_recording(file);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->header_json, "{\"first\":1}");
}

}  // namespace
}  // namespace palpable::session
