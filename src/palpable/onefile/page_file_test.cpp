// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/page_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/text/base64.hpp"
#include "palpable/onefile/gzip.hpp"
#include "palpable/onefile/page_template.hpp"
#include "palpable/onefile/scene_bytes.hpp"
#include "palpable/onefile/test_scenes.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

namespace palpable::onefile {
namespace {

TEST(Gzip, IsUnpackedByOthersAndHasNoTime) {
  const std::string text(5000, 'x');
  const auto packed = gzip(as_bytes(text));
  EXPECT_LT(packed.size(), 100U);
  EXPECT_EQ(packed, gzip(as_bytes(text)));
  std::vector<char> out(text.size() + 1);
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  auto copy = packed;
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(std::string(out.data(), stream.total_out), text);
  inflateEnd(&stream);
}

TEST(PageFile, SaysWhatIsMissingWithoutEmscripten) {
  if (!page_template().empty()) GTEST_SKIP() << "this program was built with emscripten";
  const auto page = encode_page(hills_scene());
  ASSERT_FALSE(page);
  EXPECT_NE(page.error().sentence().find("apt install emscripten"), std::string::npos);
}

TEST(PageFile, HoldsTheSceneAndRefersToNothingOutside) {
  if (page_template().empty()) GTEST_SKIP() << "this program was built without emscripten";
  const models::Scene scene = hills_scene();
  const auto page = encode_page(scene);
  ASSERT_TRUE(page);
  // The title is text, never markup.
  EXPECT_NE(page->find("<title>Hills &amp; &lt;dales&gt;</title>"), std::string::npos);
  EXPECT_NE(page->find(base64(gzip(encode_scene_bytes(scene)))), std::string::npos);
  EXPECT_EQ(page->find("%PALPABLE_"), std::string::npos);
  EXPECT_NE(page->find("default-src 'none'"), std::string::npos);
  for (const char* outside : {"src=\"http", "src=\"/", "href=\"http", "href=\"/", "url(http"})
    EXPECT_EQ(page->find(outside), std::string::npos) << outside;
  EXPECT_EQ(*encode_page(scene), *page);
}

}  // namespace
}  // namespace palpable::onefile
