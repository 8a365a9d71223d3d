// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/test_mjpeg_server.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "program.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

namespace palpable::test {
namespace {

using session::MjpegServer;
using session::moving_pairs;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::ptrdiff_t recorded_pairs(const std::filesystem::path& folder) {
  std::error_code none;
  const std::filesystem::directory_iterator files(folder, none);
  return std::distance(begin(files), std::filesystem::directory_iterator()) / 2;
}

/// Waits until a folder holds so many pairs.
bool has_recorded(const std::filesystem::path& folder, std::ptrdiff_t pairs) {
  for (const auto end = std::chrono::steady_clock::now() + seconds(60);
       std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(std::chrono::milliseconds(20)))
    if (recorded_pairs(folder) >= pairs) return true;
  return false;
}

using LiveCamera = InFolder;

TEST_F(LiveCamera, IsTouchedAndTriedAgainWhenItIsLost) {
  const auto pictures = moving_pairs(9);
  std::optional<MjpegServer> server(std::in_place, pictures);
  const auto port = server->port();
  Running touch(
      {"touch", server->url(), "--headless", "--seconds", "60", "--record-frames", path("seen"), "--json"});
  ASSERT_TRUE(touch.catches(SIGINT, seconds(60)));
  ASSERT_TRUE(has_recorded(path("seen"), 6));
  server.reset();
  EXPECT_TRUE(touch.says("was lost: it has ended the connection", seconds(30))) << touch.err();
  const std::ptrdiff_t before = recorded_pairs(path("seen"));
  server.emplace(pictures, port);
  const auto returned = std::chrono::steady_clock::now();
  EXPECT_TRUE(touch.says("The pictures come again", seconds(30))) << touch.err();
  // A busy machine may have said that before, after a pause of the first server's pictures.
  ASSERT_TRUE(has_recorded(path("seen"), before + 3));
  touch.send(SIGINT);
  const Outcome outcome = touch.wait();
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - returned;
  EXPECT_EQ(count_of(outcome.err, "was lost"), 1U) << outcome.err;
  const auto json = outcome.json();
  ASSERT_FALSE(json.is_discarded()) << outcome.err;
  EXPECT_GT(json["live"]["frames"], 5) << json["live"];
  EXPECT_GT(json["live"]["fps"], 0.0);
  EXPECT_LT(json["live"]["stale_s"], since.count()) << "no picture of the second server was felt";
  EXPECT_GT(json["contact_ticks"], 0);
  EXPECT_GT(json["force"]["max_N"], 0.0);
  EXPECT_EQ(json["allocations_in_ticks"], 0);
  const Outcome again =
      palpable({"touch", "frames:" + path("seen"), "--headless", "--seconds", "0.5", "--json"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_GT(again.json()["live"]["frames"], 0);
}

TEST_F(LiveCamera, ThatCannotBeReachedIsNamedInASentence) {
  std::string url;
  { url = MjpegServer(moving_pairs(1)).url(); }
  const Outcome nobody = palpable({"touch", url, "--headless", "--seconds", "1"});
  EXPECT_EQ(nobody.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(nobody.err)) << nobody.err;
  EXPECT_THAT(nobody.err, HasSubstr(url));
  const MjpegServer rubbish({"rubbish"});
  const Outcome none = palpable({"touch", rubbish.url(), "--headless", "--seconds", "1"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("not JPEG"));
  for (const char* wrong :
       {"http://me:secret@127.0.0.1/", "rtsps://me:secret@127.0.0.1/", "http://127.0.0.1:1/#x=1"}) {
    const Outcome refused = palpable({"touch", wrong, "--headless", "--seconds", "1"});
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_TRUE(is_one_sentence(refused.err)) << refused.err;
    EXPECT_THAT(refused.err, Not(HasSubstr("secret")));
  }
}

}  // namespace
}  // namespace palpable::test
