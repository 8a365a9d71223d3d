// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/shared_library.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <system_error>

#include <dlfcn.h>
#include <elf.h>

namespace palpable {
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

/// The processor that this program was compiled for, as libraries state it.
constexpr Elf64_Half own_machine() {
#if defined(__aarch64__)
  return EM_AARCH64;
#else
  return EM_X86_64;
#endif
}

/// Why a file cannot be a library; empty if it may be one. The system's loader maps what the headers state
/// and is killed by a file that ends before.
std::string fault_of(const std::string& path) {
  std::error_code none;
  if (!fs::exists(path, none)) return "is not there";
  if (!fs::is_regular_file(path, none)) return "is no regular file";
  std::ifstream file(path, std::ios::binary);
  if (!file) return "may not be read";
  Elf64_Ehdr head{};
  file.read(reinterpret_cast<char*>(&head), sizeof head);
  if (!file || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64)
    return "is no library of this machine";
  if (head.e_machine != own_machine()) return "is for another kind of processor";
  const auto size = fs::file_size(path, none);
  file.seekg(static_cast<std::streamoff>(head.e_phoff));
  for (int k = 0; k < head.e_phnum; ++k) {
    Elf64_Phdr part{};
    file.read(reinterpret_cast<char*>(&part), sizeof part);
    if (!file || part.p_offset > size || part.p_filesz > size - part.p_offset)
      return "is cut off: it ends before the parts that it states";
  }
  return {};
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
    const bool is_file = !file.empty() || name.find('/') != std::string::npos;
    if (const std::string fault = is_file ? fault_of(name) : ""; !fault.empty()) {
      reason = name + " " + fault;
      continue;
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe): dlerror() is kept for each thread
    if (void* handle = ::dlopen(is_file ? fs::absolute(name).c_str() : name.c_str(),
                                RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
        handle != nullptr)
      return SharedLibrary(handle, name);
    const std::string why = one_line(::dlerror());  // NOLINT(concurrency-mt-unsafe)
    // A name that the system does not find is no reason, a file that it cannot load is.
    if (is_file) reason = why;
  }
  if (!reason.empty()) return Error{ErrorCode::device, "the library cannot be loaded: " + reason, {}};
  return Error{ErrorCode::device, "the vendor's library " + names.front() + " is not installed", {}};
}

Result<void*> SharedLibrary::address_of(const char* name) const {
  if (void* address = ::dlsym(handle_, name); address != nullptr) return address;
  return Error{ErrorCode::device,
               std::string("the library has no function ") + name + ": another version of it is needed",
               name_};
}

}  // namespace palpable
