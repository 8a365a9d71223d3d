// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/zip.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>

#include <zip.h>

namespace palpable::formats {
namespace {

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;

struct CloseMember {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Member = std::unique_ptr<zip_file_t, CloseMember>;

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;

class ZipError {
 public:
  ZipError() { zip_error_init(&error_); }
  ZipError(const ZipError&) = delete;
  ZipError& operator=(const ZipError&) = delete;
  ~ZipError() { zip_error_fini(&error_); }
  zip_error_t* get() { return &error_; }
  std::string text() { return zip_error_strerror(&error_); }

 private:
  zip_error_t error_{};
};

bool is_compressed_already(std::string_view name) {
  return name.ends_with(".zst") || name.ends_with(".png") || name.ends_with(".jpg");
}

Error damaged(const std::string& reason) {
  return invalid_input("is damaged or not a zip archive (" + reason + ")");
}

/// Reads one member of the stated size; one extra byte is requested to detect a larger member.
Result<Bytes> unpack(zip_t* archive, zip_uint64_t index, const zip_stat_t& stated) {
  const Member member(zip_fopen_index(archive, index, 0));
  if (!member) return damaged(zip_strerror(archive));
  Bytes bytes(static_cast<std::size_t>(stated.size));
  const zip_int64_t got = zip_fread(member.get(), bytes.data(), bytes.size());
  std::byte beyond{};
  if (got < 0 || static_cast<zip_uint64_t>(got) != stated.size || zip_fread(member.get(), &beyond, 1) != 0)
    return damaged(std::string("member ") + stated.name + " does not unpack as it states");
  return bytes;
}

/// Whether the central directory ends where the record of its place and size begins (APPNOTE 4.3.16), which
/// libzip does not ask. Archives of the 64-bit form state it elsewhere and are left to libzip.
bool directory_is_in_place(std::span<const std::byte> file) {
  constexpr std::size_t kRecord = 22, kLongestComment = 65535, kSizeAt = 12;
  constexpr std::uint32_t kElsewhere = 0xFFFFFFFF;
  if (file.size() < kRecord) return true;
  const std::size_t last = file.size() - kRecord;
  for (std::size_t back = 0; back <= std::min(last, kLongestComment); ++back) {
    if (!has_magic(file, "PK\5\6", last - back)) continue;
    ByteReader record(file.subspan(last - back + kSizeAt));
    const std::uint32_t size = record.u32(), begin = record.u32();
    return size == kElsewhere || begin == kElsewhere || std::uint64_t{begin} + size == last - back;
  }
  return true;
}

Result<Archive> open(std::span<const std::byte> file) {
  if (file.empty()) return invalid_input("is empty");
  if (!directory_is_in_place(file)) return damaged("its directory is not where it states");
  ZipError error;
  Source source(zip_source_buffer_create(file.data(), file.size(), 0, error.get()));
  if (!source) return damaged(error.text());
  Archive archive(zip_open_from_source(source.get(), ZIP_RDONLY | ZIP_CHECKCONS, error.get()));
  if (!archive) return damaged(error.text());
  static_cast<void>(source.release());  // the archive owns it now
  if (zip_get_num_entries(archive.get(), 0) > kMaxMembers)
    return invalid_input("holds more members than any file of ours");
  return archive;
}

/// The stated size of every member, if together they are at most `most_bytes`.
Result<std::vector<zip_stat_t>> stated_sizes(zip_t* archive, std::uint64_t most_bytes) {
  std::vector<zip_stat_t> members(static_cast<std::size_t>(zip_get_num_entries(archive, 0)));
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    zip_stat_t& stated = members[i];
    constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
    if (zip_stat_index(archive, i, 0, &stated) != 0 || (stated.valid & kNeeded) != kNeeded)
      return damaged("a member without name or size");
    // Deflate compresses by at most 1032 : 1, so a larger stated size is false; and what is compressed
    // already, hardly at all.
    constexpr zip_uint64_t kMaxRatio = 1040, kMaxRatioAgain = 2, kSmall = 65536;
    const zip_uint64_t ratio = is_compressed_already(stated.name) ? kMaxRatioAgain : kMaxRatio;
    if (stated.size > most_bytes || total + stated.size > most_bytes ||
        (stated.size > kSmall && stated.size / ratio > stated.comp_size))
      return invalid_input("unpacks to more than a file of ours may");
    total += stated.size;
  }
  return members;
}

}  // namespace

Result<std::vector<std::string>> member_names(std::span<const std::byte> file) {
  const auto archive = open(file);
  if (!archive) return archive.error();
  std::vector<std::string> names;
  const zip_int64_t count = zip_get_num_entries(archive->get(), 0);
  for (zip_int64_t i = 0; i < count; ++i)
    if (const char* name = zip_get_name(archive->get(), static_cast<zip_uint64_t>(i), 0))
      names.emplace_back(name);
  return names;
}

Result<ZipMembers> unzip(std::span<const std::byte> file, std::uint64_t most_bytes) {
  const auto archive = open(file);
  if (!archive) return archive.error();
  const auto stated = stated_sizes(archive->get(), most_bytes);
  if (!stated) return stated.error();
  ZipMembers members;
  for (std::size_t i = 0; i < stated->size(); ++i) {
    auto bytes = unpack(archive->get(), i, (*stated)[i]);
    if (!bytes) return std::move(bytes).error();
    const char* name = (*stated)[i].name;
    if (!members.emplace(name, *std::move(bytes)).second)
      return damaged(std::string("member ") + name + " is there twice");
  }
  return members;
}

Result<Bytes> zip(const ZipMembers& members) {
  ZipError error;
  const auto failed = [&error](std::string reason) {
    return Error{ErrorCode::failed, "cannot be packed: " + (reason.empty() ? error.text() : reason), {}};
  };
  Source target(zip_source_buffer_create(nullptr, 0, 0, error.get()));
  if (!target) return failed({});
  zip_source_keep(target.get());
  Archive archive(zip_open_from_source(target.get(), ZIP_TRUNCATE, error.get()));
  if (!archive) {
    zip_source_free(target.get());
    return failed({});
  }
  for (const auto& [name, bytes] : members) {
    Source content(zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0));
    if (!content) return failed(zip_strerror(archive.get()));
    const zip_int64_t index = zip_file_add(archive.get(), name.c_str(), content.get(), ZIP_FL_ENC_UTF_8);
    if (index < 0) return failed(zip_strerror(archive.get()));
    static_cast<void>(content.release());  // the archive owns it now
    const auto place = static_cast<zip_uint64_t>(index);
    const int method = is_compressed_already(name) ? ZIP_CM_STORE : ZIP_CM_DEFLATE;
    zip_set_file_compression(archive.get(), place, method, 0);
    // A fixed date (1 January 1980, the earliest) so that the same members give the same bytes.
    zip_file_set_dostime(archive.get(), place, 0, 0x21, 0);
  }
  if (zip_close(archive.get()) != 0) return failed(zip_strerror(archive.get()));
  static_cast<void>(archive.release());

  zip_stat_t stat;
  if (zip_source_stat(target.get(), &stat) != 0 || zip_source_open(target.get()) != 0)
    return failed("no memory");
  Bytes file(static_cast<std::size_t>(stat.size));
  const zip_int64_t got = zip_source_read(target.get(), file.data(), file.size());
  zip_source_close(target.get());
  if (got < 0 || static_cast<std::size_t>(got) != file.size()) return failed("no memory");
  return file;
}

}  // namespace palpable::formats
