// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/transport/shared_library.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <system_error>

#include <dlfcn.h>

namespace palpable::device {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> library_folders() {
  std::vector<fs::path> folders{"/usr/local/lib", "/usr/lib", "/usr/lib/x86_64-linux-gnu",
                                "/usr/lib/aarch64-linux-gnu"};
  std::error_code none;
  for (const auto& entry : fs::directory_iterator("/opt", none)) folders.push_back(entry.path() / "lib");
  return folders;
}

/// Files in the usual folders whose names begin with one of these, the highest version first.
std::vector<std::string> files_named(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& folder : library_folders())
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const std::string file = entry.path().filename().string();
      if (std::ranges::any_of(names, [&](const auto& name) { return file.starts_with(name); }))
        files.push_back(entry.path().string());
    }
  std::ranges::sort(files, std::ranges::greater());
  return files;
}

std::string one_line(const char* reason) {
  std::string text = reason == nullptr ? "it cannot be loaded" : reason;
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

Result<SharedLibrary> SharedLibrary::open(const std::string& file, const std::vector<std::string>& names) {
  std::vector<std::string> found = file.empty() ? names : std::vector{file};
  if (file.empty()) std::ranges::copy(files_named(names), std::back_inserter(found));
  std::string reason;
  for (const std::string& name : found) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): dlerror() is kept for each thread
    if (void* handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE); handle != nullptr)
      return SharedLibrary(handle, name);
    const std::string why = one_line(::dlerror());  // NOLINT(concurrency-mt-unsafe)
    // A name that the system does not find is no reason, a file that it cannot load is.
    if (name.find('/') != std::string::npos) reason = why;
  }
  if (!reason.empty()) return Error{ErrorCode::device, "the library cannot be loaded: " + reason, file};
  return Error{ErrorCode::device, "the vendor's library " + names.front() + " is not installed", {}};
}

Result<void*> SharedLibrary::address_of(const char* name) const {
  if (void* address = ::dlsym(handle_, name); address != nullptr) return address;
  return Error{ErrorCode::device,
               std::string("the library has no function ") + name + ": another version of it is needed",
               name_};
}

}  // namespace palpable::device
