// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace palpable::cli {

/// Opens the page's address in the user's browser if there is a display. The address contains the page's
/// token, and other users can read command lines. So the browser is given a file that only this user can read
/// and that redirects to the address; the destructor removes it. If nothing can be opened, the user takes the
/// address from the console.
class OpenedBrowser {
 public:
  explicit OpenedBrowser(const std::string& address);
  ~OpenedBrowser();
  OpenedBrowser(const OpenedBrowser&) = delete;
  OpenedBrowser& operator=(const OpenedBrowser&) = delete;

 private:
  std::filesystem::path redirect_;
};

/// Writes a new file, readable by this user alone, whose page redirects to `address`; returns an empty path
/// if it cannot be written. It is in the user's runtime folder, else in the folder for temporary files.
std::filesystem::path write_redirect(const std::string& address);

}  // namespace palpable::cli
