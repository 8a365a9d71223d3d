// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/npz.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/packing/zip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

std::vector<std::byte> npy_file(const std::string& dictionary, const std::string& values) {
  std::string file("\x93NUMPY\x01\x00", 8);
  file += static_cast<char>(dictionary.size());
  file += '\0';
  file += dictionary + values;
  const auto bytes = as_bytes(file);
  return {bytes.begin(), bytes.end()};
}

TEST(Npz, KeepsEveryArrayExactly) {
  Raster<float> heights(3, 2);
  heights(2, 1) = std::numeric_limits<float>::infinity();
  heights(1, 0) = -0.1F;
  Npz arrays;
  arrays["height_m"] = npy_array(heights);
  arrays["pixel_m"] = npy_array(0.00025);
  arrays["occupied"] = {NpyType::boolean, {2, 2, 1}, std::vector<std::byte>(4, std::byte{1})};
  const std::array<double, 6> table{1, 2, 3, 4, 5, 6};
  arrays["table"] = npy_array(table, 3);
  const auto path = std::filesystem::path(testing::TempDir()) / "palpable.npz";
  ASSERT_TRUE(write_npz(path, arrays));
  const auto back = read_npz(path);
  ASSERT_TRUE(back) << back.error().sentence();
  ASSERT_EQ(back->size(), 4U);
  for (const auto& [name, array] : arrays) {
    EXPECT_EQ(back->at(name).type, array.type) << name;
    EXPECT_EQ(back->at(name).shape, array.shape) << name;
    EXPECT_EQ(back->at(name).bytes, array.bytes) << name;
  }
  EXPECT_EQ(back->at("table").number(4), 5.0);
  EXPECT_EQ(*raster_of(back->at("height_m")), heights);
  EXPECT_FALSE(raster_of(back->at("pixel_m")));
}

TEST(Npz, GivesTheSameBytesForTheSameArrays) {
  const Npz arrays{{"a", npy_array(1.0)}, {"b", npy_array(2.0)}};
  EXPECT_EQ(*encode_npz(arrays), *encode_npz(arrays));
}

TEST(Npy, ReadsBigEndianAndColumnMajor) {
  const auto array = decode_npy(npy_file("{'descr': '>u2', 'fortran_order': True, 'shape': (2, 3), }\n",
                                         std::string("\0\1\0\4\0\2\0\5\0\3\0\6", 12)));
  ASSERT_TRUE(array) << array.error().message;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(array->number(i), static_cast<double>(i + 1));
}

TEST(Npy, RefusesOtherTypesAndDamage) {
  const std::string good = "{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }\n";
  EXPECT_TRUE(decode_npy(npy_file(good, "12345678")));
  EXPECT_FALSE(decode_npy(npy_file(good, "1234567")));
  EXPECT_FALSE(decode_npy(npy_file("{'descr': '|O', 'fortran_order': False, 'shape': (1,), }", "12345678")));
  EXPECT_FALSE(decode_npy(npy_file("{'descr': '<c8', 'fortran_order': False, 'shape': (1,), }", "12345678")));
  EXPECT_FALSE(decode_npy(npy_file("{'fortran_order': False, 'shape': (1,), }", "12345678")));
  EXPECT_FALSE(decode_npy(
      npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (4294967296, 4294967296, 8), }", "1")));
  EXPECT_FALSE(decode_npy(npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (2", "12345678")));
  const auto file = encode_npy(npy_array(1.0));
  for (std::size_t length = 0; length < file.size(); ++length)
    EXPECT_FALSE(decode_npy(std::span(file).first(length))) << length;
}

TEST(Zip, RefusesTruncatedOrDamagedArchives) {
  const auto file = *zip({{"a.txt", Bytes(1000, std::byte{7})}, {"b.png", Bytes(20, std::byte{9})}});
  for (std::size_t length = 0; length < file.size(); ++length)
    EXPECT_FALSE(unzip(std::span(file).first(length))) << length;
  for (std::size_t i = 0; i < file.size(); ++i) {
    auto changed = file;
    changed[i] ^= std::byte{0xFF};
    const auto members = unzip(changed);
    // Dates and flags may change, content may not.
    if (members && members->contains("a.txt")) {
      EXPECT_EQ(members->at("a.txt"), Bytes(1000, std::byte{7})) << i;
    }
  }
}

TEST(Zip, RefusesAnImpossibleSizeBeforeUnpacking) {
  auto file = *zip({{"a.txt", Bytes(1000, std::byte{7})}});
  const std::string_view text = as_text(file);
  const std::size_t central = text.find("PK\x01\x02");
  ASSERT_NE(central, std::string_view::npos);
  // Both stated sizes (local header, central directory): 1 GiB from a few bytes.
  for (const std::size_t place : {std::size_t{22}, central + 24}) file[place + 3] = std::byte{0x40};
  const auto members = unzip(file);
  ASSERT_FALSE(members);
  EXPECT_NE(members.error().message.find("unpacks to more"), std::string::npos) << members.error().message;
}

TEST(Zip, RefusesMembersThatAreTogetherAboveTheLimit) {
  const auto file = *zip({{"a.txt", Bytes(600, std::byte{7})}, {"b.txt", Bytes(500, std::byte{7})}});
  EXPECT_TRUE(unzip(file, 1100));
  EXPECT_FALSE(unzip(file, 1099));
  EXPECT_TRUE(decode_npz(file, 1100)) << "neither is an array";
  EXPECT_FALSE(decode_npz(file, 1099));
}

TEST(Zip, RefusesAMemberThatIsCompressedAgainToMuchLess) {
  auto file = *zip({{"a.txt", Bytes(1'000'000, std::byte{7})}});
  ASSERT_TRUE(unzip(file));
  // Both names (local header, central directory): what is compressed by zstd hardly gets smaller.
  const std::string_view text = as_text(file);
  for (const std::size_t place : {text.find("a.txt"), text.rfind("a.txt")})
    std::copy_n(as_bytes(std::string_view("a.zst")).begin(), 5,
                file.begin() + static_cast<std::ptrdiff_t>(place));
  const auto members = unzip(file);
  ASSERT_FALSE(members);
  EXPECT_NE(members.error().message.find("unpacks to more"), std::string::npos) << members.error().message;
}

TEST(Zip, RefusesBytesBetweenTheDirectoryAndItsRecord) {
  auto file = *zip({{"a.txt", Bytes(1000, std::byte{7})}});
  const std::size_t record = as_text(file).find("PK\x05\x06");
  ASSERT_NE(record, std::string_view::npos);
  file.insert(file.begin() + static_cast<std::ptrdiff_t>(record), 30, std::byte{0});
  EXPECT_FALSE(unzip(file));
}

TEST(Npz, ReadsAFileOfNumPyItself) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  const auto path = std::filesystem::path(data) / "stereo/mid14_Motorcycle/motorcycle_disp.npz";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto arrays = read_npz(path);
  ASSERT_TRUE(arrays) << arrays.error().sentence();
  const auto disparity = raster_of(arrays->at("arr_0"));
  ASSERT_TRUE(disparity);
  EXPECT_EQ(disparity->width(), 741);
  EXPECT_EQ(disparity->height(), 500);
}

}  // namespace
}  // namespace palpable::formats
