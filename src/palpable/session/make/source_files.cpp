// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/source_files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
struct DigestCloser {
  void operator()(EVP_MD_CTX* digest) const { EVP_MD_CTX_free(digest); }
};

Error unreadable(const fs::path& file) {
  return invalid_input("cannot be read: " + std::generic_category().message(errno), file.string());
}

/// Where a source file of the scene is now.
Result<fs::path> place_of(const models::SourceFile& source, const fs::path& scene, const Work& work) {
  const fs::path named = source.name, beside = scene.parent_path() / named.filename();
  bool exists = false;
  for (const fs::path& place : {named, beside}) {
    std::error_code failed;
    if (!fs::is_regular_file(place, failed)) continue;
    exists = true;
    if (fs::file_size(place, failed) != source.bytes || failed) continue;
    const auto hash = sha256_of(place, work);
    if (!hash) return hash.error();
    if (*hash == source.sha256) return place;
  }
  return invalid_input(
      fmt::format(
          fmt::runtime(exists ? "has another content than the file that {} was made from"
                              : "is missing: {} was made from it, and it is not beside the scene either"),
          scene.string()),
      source.name);
}

}  // namespace

Result<std::string> sha256_of(const fs::path& file, const Work& work) {
  // A pipe would wait, and is empty when it is read again.
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return invalid_input("is not a file", file.string());
  const std::unique_ptr<std::FILE, FileCloser> in(std::fopen(file.c_str(), "rbe"));
  if (!in) return unreadable(file);
  const std::unique_ptr<EVP_MD_CTX, DigestCloser> digest(EVP_MD_CTX_new());
  bool is_good = digest && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) == 1;
  constexpr std::size_t kBlock = std::size_t{1} << 16U;
  std::array<unsigned char, kBlock> block{};
  for (std::size_t count = kBlock; is_good && count == kBlock;) {
    if (work.cancelled()) return Work::interrupted();
    count = std::fread(block.data(), 1, kBlock, in.get());
    is_good = EVP_DigestUpdate(digest.get(), block.data(), count) == 1;
  }
  if (std::ferror(in.get()) != 0) return unreadable(file);
  std::array<unsigned char, EVP_MAX_MD_SIZE> value{};
  unsigned size = 0;
  if (!is_good || EVP_DigestFinal_ex(digest.get(), value.data(), &size) != 1)
    return Error{ErrorCode::failed, "its SHA-256 cannot be computed", file.string()};
  std::string digits;
  for (unsigned i = 0; i < size; ++i) digits += fmt::format("{:02x}", value[i]);
  return digits;
}

Result<std::vector<models::SourceFile>> source_files(const std::vector<fs::path>& files, const Work& work) {
  std::vector<models::SourceFile> sources;
  for (const fs::path& file : files) {
    auto hash = sha256_of(file, work);
    if (!hash) return std::move(hash).error();
    std::error_code failed;
    const auto bytes = fs::file_size(file, failed);
    if (failed) return invalid_input("cannot be read: " + failed.message(), file.string());
    sources.push_back({file.string(), bytes, *std::move(hash)});
  }
  return sources;
}

Result<std::vector<fs::path>> find_source_files(const std::vector<models::SourceFile>& files,
                                                const fs::path& scene, const Work& work) {
  std::vector<fs::path> found;
  for (const models::SourceFile& source : files) {
    auto place = place_of(source, scene, work);
    if (!place) return std::move(place).error();
    found.push_back(*std::move(place));
  }
  return found;
}

}  // namespace palpable::session
