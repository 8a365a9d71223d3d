// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/motor_file.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace palpable::device {
namespace {

TEST(MotorFileTest, ReplacesOnlyWhatASimulatedDeviceHasWritten) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("motors-" + std::to_string(getpid()));
  // A path of 40 bytes, as many as the motors' own file has.
  const std::string path = "t_s,x_m,y_m,z_m\n0,0,0,0.02\n1,0,0,0.0100\n";
  ASSERT_EQ(path.size(), 40U);
  std::ofstream(file) << path;
  const auto refused = MotorFile::create(file);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  std::string kept(path.size(), ' ');
  std::ifstream(file).read(kept.data(), static_cast<std::streamsize>(kept.size()));
  EXPECT_EQ(kept, path);
  std::filesystem::remove(file);
  for (int time = 0; time < 2; ++time) {
    const auto motors = MotorFile::create(file);
    ASSERT_TRUE(motors) << time;
    (*motors)->write({0.0, 0.0, 1.5});
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace palpable::device
