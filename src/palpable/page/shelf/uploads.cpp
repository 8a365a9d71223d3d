// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/uploads.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/core/system/secret.hpp"
#include "palpable/core/system/system_failure.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 120;
constexpr std::size_t kLongestEnding = 16;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const int high = text[k] == '%' && k + 2 < text.size() ? hex_digit(text[k + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[k + 2]) : -1;
    out.push_back(low >= 0 ? static_cast<char>(16 * high + low) : text[k]);
    if (low >= 0) k += 2;
  }
  return out;
}

/// At most `most` bytes, without splitting a character.
std::string beginning(const std::string& text, std::size_t most) {
  std::size_t end = std::min(text.size(), most);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

std::string megabytes(std::uint64_t bytes) { return fmt::format("{} MB", (bytes + 999'999) / 1'000'000); }

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace

std::string safe_file_name(std::string_view encoded) {
  std::string name = percent_decoded(encoded);
  if (!is_utf8(name)) return "file";
  std::erase(name, '\0');
  name = plain_name(name);
  name = name.substr(name.find_last_of("/\\") + 1);
  if (name.starts_with('.')) name.front() = '_';
  if (name.empty()) return "file";
  if (name.size() <= kLongestName) return name;
  const auto dot = name.rfind('.');
  const std::string ending =
      dot != std::string::npos && name.size() - dot <= kLongestEnding ? name.substr(dot) : std::string();
  return beginning(name, kLongestName - ending.size()) + ending;
}

struct Uploads::Kept {
  std::string id;
  fs::path file;
  std::uint64_t bytes = 0;
  bool complete = false;
  bool held = false;
};

class Uploads::Receiving final : public Upload {
 public:
  Receiving(std::shared_ptr<std::vector<Kept>> kept, Descriptor file, const Kept& own)
      : kept_(std::move(kept)), file_(std::move(file)), id_(own.id), path_(own.file), left_(own.bytes) {}
  ~Receiving() override {
    if (id_.empty()) return;
    remove_quietly(path_.parent_path());
    std::erase_if(*kept_, [this](const Kept& one) { return one.id == id_; });
  }

  Result<void> write(std::string_view bytes) override {
    if (bytes.size() > left_) return Error{ErrorCode::failed, "more arrived than was announced", place()};
    left_ -= bytes.size();
    received_ += bytes.size();
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_.number(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return Error{ErrorCode::failed, system_failure(errno).message, place()};
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
  }

  Result<protocol::Uploaded> finish() override {
    file_.close();
    const auto own =
        std::find_if(kept_->begin(), kept_->end(), [this](const Kept& one) { return one.id == id_; });
    if (own == kept_->end()) return Error{ErrorCode::failed, "was removed while it was received", place()};
    own->complete = true;
    own->bytes = received_;
    id_.clear();
    return protocol::Uploaded{own->id, place(), static_cast<std::int64_t>(received_)};
  }

 private:
  std::string place() const { return path_.filename().string(); }

  std::shared_ptr<std::vector<Kept>> kept_;
  Descriptor file_;
  /// Empty once the file is complete.
  std::string id_;
  fs::path path_;
  std::uint64_t left_ = 0;
  std::uint64_t received_ = 0;
};

Uploads::Uploads(fs::path folder, UploadLimits limits)
    : folder_(std::move(folder)), limits_(limits), kept_(std::make_shared<std::vector<Kept>>()) {}

Uploads::~Uploads() {
  for (const Kept& one : *kept_) remove_quietly(one.file.parent_path());
}

bool Uploads::make_room(std::uint64_t bytes) {
  const auto total = [this] {
    std::uint64_t sum = 0;
    for (const Kept& one : *kept_) sum += one.bytes;
    return sum;
  };
  while (kept_->size() >= limits_.most_files || total() + bytes > limits_.most_bytes) {
    const auto oldest =
        std::find_if(kept_->begin(), kept_->end(), [](const Kept& one) { return one.complete && !one.held; });
    if (oldest == kept_->end()) return false;
    remove_quietly(oldest->file.parent_path());
    kept_->erase(oldest);
  }
  return true;
}

Result<std::unique_ptr<Upload>> Uploads::begin(std::string_view encoded_name, std::uint64_t bytes) {
  const std::string name = safe_file_name(encoded_name);
  if (bytes > limits_.most_file_bytes)
    return Error{ErrorCode::failed,
                 fmt::format("has {}, and a page may open at most {}: palpable make reads larger files",
                             megabytes(bytes), megabytes(limits_.most_file_bytes)),
                 name};
  if (bytes == 0) return Error{ErrorCode::failed, "is empty", name};
  if (!make_room(bytes))
    return Error{ErrorCode::failed, "too many files are being opened: wait until one is done", name};
  auto id = random_secret();
  if (!id) return id.error();
  Kept own{*id, folder_ / *id / name, bytes, false, false};
  if (::mkdir(own.file.parent_path().c_str(), S_IRWXU) != 0)
    return Error{ErrorCode::failed, system_failure(errno).message, name};
  Descriptor file(
      ::open(own.file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR));
  if (file.number() < 0) {
    const auto failure = system_failure(errno);
    remove_quietly(own.file.parent_path());
    return Error{ErrorCode::failed, failure.message, name};
  }
  kept_->push_back(own);
  return std::unique_ptr<Upload>(std::make_unique<Receiving>(kept_, std::move(file), own));
}

std::optional<fs::path> Uploads::find(std::string_view id) const {
  for (const Kept& one : *kept_)
    if (one.id == id && one.complete) return one.file;
  return std::nullopt;
}

void Uploads::discard(std::string_view id) {
  std::erase_if(*kept_, [id](const Kept& one) {
    if (one.id != id || !one.complete || one.held) return false;
    remove_quietly(one.file.parent_path());
    return true;
  });
}

void Uploads::hold(const std::vector<std::string>& ids) {
  for (Kept& one : *kept_)
    if (std::find(ids.begin(), ids.end(), one.id) != ids.end()) one.held = true;
}

void Uploads::release(const std::vector<std::string>& ids, bool done) {
  for (const std::string& id : ids) {
    for (Kept& one : *kept_)
      if (one.id == id) one.held = false;
    if (done) discard(id);
  }
}

}  // namespace palpable::page::shelf
