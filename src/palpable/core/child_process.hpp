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

// Helper programs of ours that run as processes of their own.
namespace palpable {

/// An open file descriptor, closed by its owner's end; -1: none.
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
  void close();

 private:
  int number_;
};

/// A copy of `descriptor`, close-on-exec, with a number that start_child() can pass on. None if there is
/// none.
Descriptor passable(Descriptor descriptor);

/// A pipe, close-on-exec: the end to read and the end to write, which is passable. Errors: failed.
Result<std::pair<Descriptor, Descriptor>> make_pipe();

/// Where the helper program `name` is: at the value of the environment variable `variable`; else beside the
/// program that runs, as a build and a copied folder have it; else in `installed`. Errors: failed, without a
/// place, with the places that were tried.
Result<std::filesystem::path> helper_program(std::string_view name, const char* variable,
                                             const std::filesystem::path& installed);

/// Starts `program` with these arguments. `descriptors` (passable) are its descriptors 3, 4 ...; its standard
/// streams are /dev/null and all others are closed. Every signal has its default action and is let through,
/// and the process has a group of its own, so that a terminal's Ctrl-C does not reach it. The address space
/// is not copied, so any thread may call it, also while a servo runs. Errors: failed, without a place, with
/// the system's reason.
Result<pid_t> start_child(const std::filesystem::path& program, std::vector<std::string> arguments,
                          std::span<const int> descriptors);

}  // namespace palpable
