// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"

#include <filesystem>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable {
namespace {

namespace fs = std::filesystem;

class AFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("palpable-file-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string text_of(const fs::path& path) {
    const auto bytes = read_file(path);
    return bytes ? std::string(as_text(*bytes)) : bytes.error().sentence();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  fs::path folder_;
};

TEST_F(AFile, ReplacesAnOldFileWholeAndLeavesNothingBeside) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(write_file_atomically(path, as_bytes("old")));
  ASSERT_TRUE(write_file_atomically(path, as_bytes("new and longer")));
  EXPECT_EQ(text_of(path), "new and longer");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AFile, LeavesTheOldFileWhenNotCommitted) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(write_file_atomically(path, as_bytes("old")));
  {
    auto file = AtomicFile::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write(as_bytes("half a fi")));
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AFile, IsNotReplacedByWorkThatWasInterrupted) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(write_file_atomically(path, as_bytes("old")));
  std::atomic<bool> cancelled = false;
  refuse_commits_after(&cancelled);
  EXPECT_TRUE(write_file_atomically(path, as_bytes("complete")));
  cancelled = true;
  const auto written = write_file_atomically(path, as_bytes("cut short"));
  refuse_commits_after(nullptr);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::interrupted);
  EXPECT_EQ(text_of(path), "complete");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AFile, RemovesWhatKilledProgramsLeftAndNothingElse) {
  const auto make = [this](const std::string& name) {
    const int descriptor = ::open((folder_ / name).c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    EXPECT_GE(descriptor, 0);
    return descriptor;
  };
  ::close(make(".a.txt.Ab3xYz"));
  ::close(make(".a.txt.kept-longer"));
  ::close(make(".b.txt.Ab3xYz"));
  const int written_now = make(".a.txt.Qq1234");
  ASSERT_EQ(::flock(written_now, LOCK_EX | LOCK_NB), 0);
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", as_bytes("new")));
  ::close(written_now);
  EXPECT_FALSE(fs::exists(folder_ / ".a.txt.Ab3xYz"));
  for (const char* name : {".a.txt.kept-longer", ".b.txt.Ab3xYz", ".a.txt.Qq1234", "a.txt"})
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
}

TEST_F(AFile, HasRoomWhereItsFolderTakesFiles) {
  EXPECT_TRUE(check_room(folder_ / "a.txt"));
  EXPECT_EQ(files(), 0U);
  EXPECT_FALSE(check_room(folder_ / "no" / "a.txt"));
}

TEST_F(AFile, KeepsThePermissionsOfTheFileItReplaces) {
  const fs::path path = folder_ / "a.txt";
  ASSERT_TRUE(write_file_atomically(path, as_bytes("old")));
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_write);
  ASSERT_TRUE(write_file_atomically(path, as_bytes("new")));
  EXPECT_EQ(fs::status(path).permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_write);
}

TEST_F(AFile, GivesANewFileThePermissionsOfTheUmask) {
  const mode_t before = ::umask(027);
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", as_bytes("x")));
  ::umask(before);
  EXPECT_EQ(fs::status(folder_ / "a.txt").permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST_F(AFile, WritesThroughASymbolicLink) {
  ASSERT_TRUE(write_file_atomically(folder_ / "real.txt", as_bytes("old")));
  fs::create_symlink("real.txt", folder_ / "link.txt");
  ASSERT_TRUE(write_file_atomically(folder_ / "link.txt", as_bytes("new")));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(text_of(folder_ / "real.txt"), "new");
}

TEST_F(AFile, ThatCannotBeWrittenIsOneSentenceWithItsPlace) {
  const auto done = write_file_atomically(folder_ / "no" / "such" / "a.txt", as_bytes("x"));
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::failed);
  EXPECT_NE(done.error().sentence().find("a.txt: cannot be written: No such file"), std::string::npos);
  EXPECT_FALSE(write_file_atomically(folder_, as_bytes("x")));
}

TEST_F(AFile, ThatCannotBeReadIsOneSentenceWithItsPlace) {
  const auto missing = read_file(folder_ / "none.png");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::invalid_input);
  EXPECT_NE(missing.error().sentence().find("none.png: cannot be read: No such file"), std::string::npos);
  EXPECT_NE(read_file(folder_).error().message.find("folder"), std::string::npos);
}

TEST_F(AFile, LargerThanAllowedIsRefused) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a", as_bytes("123456789")));
  EXPECT_FALSE(read_file(folder_ / "a", 8));
  EXPECT_EQ(read_file(folder_ / "a", 9)->size(), 9U);
  EXPECT_EQ(read_file_start(folder_ / "a", 4)->size(), 4U);
}

TEST_F(AFile, ThatIsAPipeIsReadOnceAndRefusedWithoutAWriter) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto unwritten = read_file(pipe);
  ASSERT_FALSE(unwritten);
  EXPECT_EQ(unwritten.error().message, "is a pipe that no program writes to");
  std::thread writer([&pipe] {
    const int descriptor = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
    EXPECT_EQ(::write(descriptor, "some text", 9), 9);
    ::close(descriptor);
  });
  EXPECT_EQ(text_of(pipe), "some text");
  writer.join();
}

TEST(ByteReader, ReadsBothByteOrders) {
  const std::string text("\x01\x02\x03\x04\x05\x06", 6);
  ByteReader reader(as_bytes(text));
  EXPECT_EQ(reader.u16(), 0x0201);
  EXPECT_TRUE(reader.ok());
  ByteReader other(as_bytes(text), std::endian::big);
  EXPECT_EQ(other.u32(), 0x01020304U);
  EXPECT_TRUE(other.ok());
}

TEST(ByteReader, GivesZerosAndSaysSoPastTheEnd) {
  const std::string text("\x01\x02\x03", 3);
  ByteReader reader(as_bytes(text));
  EXPECT_EQ(reader.u32(), 0U);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.u8(), 0U);
  EXPECT_EQ(reader.left(), 0U);
}

}  // namespace
}  // namespace palpable
