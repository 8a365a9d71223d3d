// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Devices and pipes that never end, given as any file: refused, with little memory.
#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "program.hpp"
#include "test_pictures.hpp"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;

class EndlessFiles : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_pair(folder_.string(), textured_pair());
    ASSERT_EQ(palpable({"make", path("left.png"), "-o", path("lines.palp")}).exit_code, 0);
    write_text(path("path.csv"), "t_s,x_m,y_m,z_m\n0,0,0,0.01\n1,0.01,0,0.01\n");
  }
  /// Every option of a command that names a file to read, with `file`.
  std::vector<std::pair<std::string, std::vector<std::string>>> uses_of(const std::string& file) const {
    const std::string out = path("out.palp"), csv = path("out.csv"), scene = path("lines.palp");
    return {
        {"the input", {"make", file, "-o", out}},
        {"shapes", {"make", file, "--kind", "shapes", "-o", out}},
        {"--describe", {"make", path("left.png"), "-o", out, "--describe", "@" + file}},
        {"--labels", {"make", path("left.png"), "-o", out, "--labels", file}},
        {"--poses",
         {"make", path("left.png"), path("right.png"), path("left.png"), "--kind", "depth", "-o", out,
          "--poses", file}},
        {"--calibration", {"make", path("left.png"), path("right.png"), "-o", out, "--calibration", file}},
        {"--material", {"make", path("left.png"), "-o", out, "--material", "0:texture=" + file + ",size=20"}},
        {"--path", {"probe", scene, "--path", file, "-o", csv}},
        {"--tool", {"probe", scene, "--path", path("path.csv"), "--tool", file, "-o", csv}},
        {"--walk",
         {"probe", scene, "--path", path("path.csv"), "--view", "egocentric", "--walk", file, "-o", csv}},
        {"--points", {"sample", scene, "--points", file, "-o", csv}},
        {"the scene", {"info", file}},
    };
  }
  void expect_refused(const std::string& what, const Outcome& outcome) const {
    EXPECT_EQ(outcome.exit_code, 3) << what << ": " << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err)) << what;
    EXPECT_FALSE(std::filesystem::exists(path("out.palp"))) << what;
    rusage use{};
    getrusage(RUSAGE_CHILDREN, &use);
    constexpr long kMost_KiB = 1200L * 1024L;
    EXPECT_LT(use.ru_maxrss, kMost_KiB) << what;
  }
};

TEST_F(EndlessFiles, ThatAreDevicesAreRefusedAtOnce) {
  for (const char* device : {"zero", "urandom"}) {
    // A texture is a picture's name.
    const std::string file = path(std::string(device) + ".png");
    std::filesystem::create_symlink(std::string("/dev/") + device, file);
    for (const auto& [what, arguments] : uses_of(file)) {
      const Outcome outcome = palpable(arguments);
      expect_refused(what, outcome);
      EXPECT_THAT(outcome.err, HasSubstr(file)) << what;
    }
  }
}

TEST_F(EndlessFiles, ThatArePipesAreReadUpToALimit) {
  const std::string pipe = path("pipe.png");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string lines;
  for (int k = 0; k < 4096; ++k) lines += "1,2,3,4,5,6,7\n";
  for (const auto& [what, arguments] : uses_of(pipe)) {
    Running running(arguments);
    // Opened for both directions, it waits for no reader.
    const int writer = open(pipe.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    ASSERT_GE(writer, 0);
    Outcome outcome;
    std::atomic<bool> ended{false};
    std::thread program([&] {
      outcome = running.wait();
      ended = true;
    });
    while (!ended) {
      pollfd room{writer, POLLOUT, 0};
      constexpr int kLook_ms = 100;
      if (poll(&room, 1, kLook_ms) > 0) static_cast<void>(!write(writer, lines.data(), lines.size()));
    }
    program.join();
    close(writer);
    expect_refused(what, outcome);
  }
}

}  // namespace
}  // namespace palpable::test
