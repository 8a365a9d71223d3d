// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace palpable::cli {

/// The page's address, opened in the person's browser where there is a screen for it. The address holds the
/// page's token and other users can read command lines, so the browser is given a file that only this user
/// can read and that leads on to the address; it is removed with this. Where nothing can be opened the person
/// takes the address from the console.
class OpenedBrowser {
 public:
  explicit OpenedBrowser(const std::string& address);
  ~OpenedBrowser();
  OpenedBrowser(const OpenedBrowser&) = delete;
  OpenedBrowser& operator=(const OpenedBrowser&) = delete;

 private:
  std::filesystem::path redirect_;
};

/// A new file, readable by this user alone, whose page leads on to `address`; empty where it cannot be
/// written. In the user's runtime folder, else in the folder for temporary files.
std::filesystem::path write_redirect(const std::string& address);

}  // namespace palpable::cli
