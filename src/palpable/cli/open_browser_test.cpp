// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/open_browser.hpp"

#include "palpable/core/byte_reader.hpp"
#include "palpable/core/read_file.hpp"

#include <filesystem>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

TEST(OpenBrowser, WritesARedirectThatOnlyThisUserReads) {
  const fs::path file = write_redirect("http://127.0.0.1:4711/#token");
  ASSERT_FALSE(file.empty());
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  const auto text = read_file(file);
  ASSERT_TRUE(text);
  EXPECT_NE(as_text(*text).find("url=http://127.0.0.1:4711/#token"), std::string_view::npos);
  fs::remove(file);
}

}  // namespace
}  // namespace palpable::cli
