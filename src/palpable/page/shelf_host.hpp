// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace palpable::page {

/// A file that a home page sends. Without finish() the destructor removes what was received.
class Upload {
 public:
  Upload() = default;
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;
  virtual ~Upload() = default;

  /// The next bytes of the file. Errors: failed, if they cannot be stored.
  virtual Result<void> write(std::string_view bytes) = 0;
  /// To be called once, after the last byte.
  virtual Result<protocol::Uploaded> finish() = 0;
};

/// The interface between the page's server and a home page: the shelf of scenes, files that are opened, and
/// the touch that they lead to. All calls come from the thread that runs serve_shelf(); none may block for
/// longer than a frame (16 ms), except Upload::write(), which stores up to 64 KiB.
class ShelfHost {
 public:
  ShelfHost() = default;
  ShelfHost(const ShelfHost&) = delete;
  ShelfHost& operator=(const ShelfHost&) = delete;
  virtual ~ShelfHost() = default;

  /// Called first in each period, 20 to 60 times per second.
  virtual void update() = 0;
  /// The touch that pages show now; null: none. The server keeps it until it asks again.
  virtual std::shared_ptr<PageHost> touch() = 0;
  /// Carries out a message of the home page, and returns the text of the answer. Errors: a sentence for the
  /// person.
  virtual Result<std::string> answer(const protocol::FromShelf& message) = 0;
  /// `name`: as the browser gives it. `bytes`: how many will follow, at most. Errors: too many or too large
  /// files; they cannot be stored.
  virtual Result<std::unique_ptr<Upload>> begin_upload(std::string_view name, std::uint64_t bytes) = 0;
  /// The picture of a scene on the shelf as PNG; nullopt if there is none. `name` is untrusted.
  virtual std::optional<std::string> picture(std::string_view name) = 0;
  /// A file that a scene was saved as; nullopt if there is none. `name`: the end of its address, untrusted.
  virtual std::optional<std::filesystem::path> saved_file(std::string_view name) = 0;
};

}  // namespace palpable::page
