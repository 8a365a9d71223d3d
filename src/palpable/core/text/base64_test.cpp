// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/base64.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/text/html_escape.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

// RFC 4648, section 10.
TEST(Base64, PadsTheLastGroup) {
  EXPECT_EQ(base64(as_bytes("")), "");
  EXPECT_EQ(base64(as_bytes("f")), "Zg==");
  EXPECT_EQ(base64(as_bytes("fo")), "Zm8=");
  EXPECT_EQ(base64(as_bytes("foo")), "Zm9v");
  EXPECT_EQ(base64(as_bytes("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64(as_bytes("\xff\xfe")), "//4=");
}

TEST(Base64, GivesTheBytesBack) {
  for (const std::string_view text : {"", "f", "fo", "foo", "\xff\xfe", "foobar"}) {
    const auto bytes = from_base64(base64(as_bytes(text)));
    ASSERT_TRUE(bytes);
    EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()), text);
  }
  for (const auto* damaged : {"Zg=", "Zg", "Z===", "=Zg=", "Zm 8", "Zm\n8", "Zm8=Zm8="})
    EXPECT_FALSE(from_base64(damaged)) << damaged;
}

TEST(HtmlEscape, KeepsTextFromBeingMarkup) {
  EXPECT_EQ(html_escaped("<b title=\"x\">Q&A</b> ü"), "&lt;b title=&quot;x&quot;&gt;Q&amp;A&lt;/b&gt; ü");
}

}  // namespace
}  // namespace palpable
