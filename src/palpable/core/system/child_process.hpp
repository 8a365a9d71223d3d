// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/types.h>

// Helper programs that run as separate processes.
namespace palpable {

/// Owns an open file descriptor and closes it on destruction; -1: none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  int number() const { return number_; }
  /// The descriptor, which the caller closes from now on.
  int release() { return std::exchange(number_, -1); }
  void close();

 private:
  int number_;
};

/// A duplicate of `descriptor`, close-on-exec, with a number that start_child() can pass on. None, with
/// errno, if `descriptor` is none or too many are open.
Descriptor passable(Descriptor descriptor);

/// A pipe, close-on-exec: the end to read and the end to write, which is passable. Errors: failed.
Result<std::pair<Descriptor, Descriptor>> make_pipe();

/// Finds the helper program `name`: at the path in the environment variable `variable`; else beside the
/// running program, as in a build tree and in a copied folder; else in `installed`. Errors: failed, without a
/// place; the message lists the paths that were tried, or names the one that may not be executed.
Result<std::filesystem::path> helper_program(std::string_view name, const char* variable,
                                             const std::filesystem::path& installed);

/// The same for a module that the program loads, which need not be executable.
Result<std::filesystem::path> helper_module(std::string_view name, const char* variable,
                                            const std::filesystem::path& installed);

/// Starts `program` with these arguments. `descriptors` (passable) become its descriptors 3, 4, ...; its
/// standard streams are /dev/null, and all other descriptors are closed. All signals have their default
/// actions and are unblocked. The process gets its own process group, so that Ctrl-C in a terminal does not
/// reach it. The address space is not copied, so any thread may call it, also while a servo runs. Errors:
/// failed, without a place, with the system's reason, which is in errno, too.
Result<pid_t> start_child(const std::filesystem::path& program, std::vector<std::string> arguments,
                          std::span<const int> descriptors);

}  // namespace palpable
