// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/uploads.hpp"

#include "palpable/core/text/plain_text.hpp"
#include "palpable/page/shelf/test_programs.hpp"

#include <fstream>
#include <iterator>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t entries_of(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Sends a whole file and returns its id.
std::string sent(Uploads& uploads, const std::string& name, const std::string& bytes) {
  auto upload = uploads.begin(name, bytes.size());
  if (!upload) return {};
  EXPECT_TRUE((*upload)->write(bytes));
  const auto done = (*upload)->finish();
  return done ? done->file : std::string();
}

TEST(SafeFileName, HasNoFolderAndNoControlCharacterAndIsNotHidden) {
  EXPECT_EQ(safe_file_name("photo%20one.png"), "photo one.png");
  EXPECT_EQ(safe_file_name("../../etc/passwd"), "passwd");
  EXPECT_EQ(safe_file_name("..%2f..%2Fetc%5Cpasswd"), "passwd");
  EXPECT_EQ(safe_file_name(".."), "_.");
  EXPECT_EQ(safe_file_name("."), "_");
  EXPECT_EQ(safe_file_name(".bashrc"), "_bashrc");
  EXPECT_EQ(safe_file_name(""), "file");
  EXPECT_EQ(safe_file_name("a%00b.png"), "ab.png");
  EXPECT_EQ(safe_file_name("%ff%fe"), "file");
  EXPECT_EQ(safe_file_name("100%"), "100%");
  EXPECT_EQ(safe_file_name("Stra%C3%9Fe.png"), "Straße.png");
  EXPECT_FALSE(has_control_characters(safe_file_name("a%1b[31m%e2%80%ae.png")));
}

TEST(SafeFileName, IsShortAndKeepsItsEnding) {
  const std::string name = safe_file_name(std::string(10000, 'a') + ".jpeg");
  EXPECT_EQ(name.size(), 120U);
  EXPECT_TRUE(name.ends_with("a.jpeg"));
  std::string sharp;
  for (int k = 0; k < 200; ++k) sharp += "%C3%9F";
  EXPECT_TRUE(is_utf8(safe_file_name(sharp)));
}

TEST(Uploads, KeepAFileForItsOwnerAloneUntilItIsDiscarded) {
  const auto folder = new_folder("uploads");
  Uploads uploads(folder, {});
  const std::string id = sent(uploads, "a.png", "bytes");
  const auto file = uploads.find(id);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->filename(), "a.png");
  EXPECT_EQ(content_of(*file), "bytes");
  const auto others = fs::perms::group_all | fs::perms::others_all;
  EXPECT_EQ(fs::status(*file).permissions() & others, fs::perms::none);
  EXPECT_EQ(fs::status(file->parent_path()).permissions() & others, fs::perms::none);
  EXPECT_FALSE(uploads.find("../" + id));
  uploads.hold({id});
  uploads.discard(id);
  EXPECT_TRUE(uploads.find(id)) << "a scene is being made of it";
  uploads.release({id}, false);
  EXPECT_TRUE(uploads.find(id)) << "it can be tried as something else";
  uploads.release({id}, true);
  EXPECT_FALSE(uploads.find(id));
  EXPECT_EQ(entries_of(folder), 0U);
}

TEST(Uploads, RemoveWhatWasNotReceivedCompletely) {
  const auto folder = new_folder("uploads");
  Uploads uploads(folder, {});
  {
    auto upload = uploads.begin("a.png", 100);
    ASSERT_TRUE(upload);
    EXPECT_TRUE((*upload)->write("half"));
    EXPECT_EQ(entries_of(folder), 1U);
  }
  EXPECT_EQ(entries_of(folder), 0U);
}

TEST(Uploads, RefuseWhatIsTooLargeOrLongerThanAnnounced) {
  Uploads uploads(new_folder("uploads"),
                  {.most_files = 2, .most_file_bytes = 1'000'000, .most_bytes = 1'500'000});
  const auto large = uploads.begin("a.png", 500'000'000);
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().sentence(),
            "a.png: has 500 MB, and a page may open at most 1 MB: palpable make reads larger files");
  EXPECT_EQ(uploads.begin("a.png", 0).error().sentence(), "a.png: is empty");
  auto longer = uploads.begin("a.png", 3);
  ASSERT_TRUE(longer);
  EXPECT_FALSE((*longer)->write("four"));
}

TEST(Uploads, ReplaceTheOldestFileBeyondTheLimitsButNoneThatIsInUse) {
  Uploads uploads(new_folder("uploads"), {.most_files = 2, .most_file_bytes = 100, .most_bytes = 150});
  const std::string first = sent(uploads, "1", std::string(60, 'a'));
  const std::string second = sent(uploads, "2", std::string(60, 'a'));
  uploads.hold({first});
  const std::string third = sent(uploads, "3", "a");
  EXPECT_TRUE(uploads.find(first));
  EXPECT_FALSE(uploads.find(second));
  uploads.hold({third});
  EXPECT_EQ(uploads.begin("4", 1).error().sentence(),
            "4: too many files are being opened: wait until one is done");
}

}  // namespace
}  // namespace palpable::page::shelf
