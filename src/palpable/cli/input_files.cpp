// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/input_files.hpp"

#include "palpable/cli/output_files.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/input/input.hpp"

#include <algorithm>
#include <climits>
#include <string_view>
#include <system_error>
#include <vector>

#include <sys/stat.h>

namespace palpable::cli {
namespace {

namespace fs = std::filesystem;

/// The parts of a word that may name a file: from its start, or from after @ : = (`@FILE`, `replay:FILE`,
/// `0:texture=FILE`), to its end, or to , ? & (`FILE,pitch=2`, `FILE?fps=30`).
std::vector<std::string> names_in(const std::string& word) {
  // A word of nothing but marks has as many parts as the square of its length, and longer ones name no file.
  constexpr int kMostBegins = 1000;
  constexpr std::size_t kMostNames = 1000;
  std::vector<std::string> names;
  std::size_t begin = 0;
  for (int n = 0; n < kMostBegins && begin != std::string::npos && names.size() < kMostNames; ++n) {
    const std::string_view rest = std::string_view(word).substr(begin, PATH_MAX + 1);
    for (std::size_t end = 0; end <= rest.size() && names.size() < kMostNames; ++end) {
      end = std::min(rest.find_first_of(",?&", end), rest.size());
      if (end > 0 && end <= PATH_MAX) names.emplace_back(rest.substr(0, end));
    }
    begin = word.find_first_of("@:=", begin);
    if (begin != std::string::npos) ++begin;
  }
  return names;
}

/// Points and meshes have no sidecar: a file beside them is what the command made of them.
bool is_surface(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return false;
  const auto kind = sources::kind_of_file(file);
  return kind && (*kind == sources::InputKind::mesh || *kind == sources::InputKind::points);
}

}  // namespace

std::vector<fs::path> sample_folders() {
  std::error_code ignored;
  // Beside the installed program, then where it was built.
  const auto beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "../share/palpable/samples";
  std::vector<fs::path> folders{beside, PALPABLE_SAMPLES};
  std::erase_if(folders, [&](const auto& folder) { return !fs::is_directory(folder, ignored); });
  return folders;
}

InputFiles::InputFiles(const InputWords& words) {
  for (const std::string& word : words.words) add_word(word);
  for (const std::string& argument : words.arguments) add_argument(argument);
}

std::optional<InputFiles::Identity> InputFiles::identity_of(const fs::path& file) {
  struct stat found {};
  // A command may read from and write to one terminal.
  if (::stat(file.c_str(), &found) != 0 || S_ISCHR(found.st_mode)) return std::nullopt;
  return Identity(found.st_dev, found.st_ino);
}

void InputFiles::add(const fs::path& file, const std::string& folder) {
  // The first entry of a file stays: named files come before those of folders.
  if (const auto identity = identity_of(file)) files_.emplace(*identity, Named{file, folder});
}

void InputFiles::add_word(const std::string& word) {
  for (const std::string& name : names_in(word)) add(name);
}

void InputFiles::add_argument(const std::string& argument) {
  add_word(argument);
  for (const std::string& name : names_in(argument)) {
    std::error_code failed;
    if (fs::is_directory(name, failed)) {
      for (auto it = fs::directory_iterator(name, failed); !failed && it != fs::directory_iterator();
           it.increment(failed))
        // Scenes are never read from a folder of pictures, so that one beside them can be made again.
        if (it->path().extension() != ".palp") add(it->path(), name);
    } else if (fs::exists(name, failed) && !is_surface(name)) {
      for (const fs::path& sidecar : sources::depth_sidecars_of(name)) add(sidecar);
    }
  }
}

std::optional<std::string> InputFiles::find(const fs::path& file) const {
  const auto identity = identity_of(file);
  const auto found = identity ? files_.find(*identity) : files_.end();
  return found == files_.end() ? std::nullopt : std::optional(found->second.folder);
}

std::vector<fs::path> InputFiles::regular_files(Folders folders) const {
  std::vector<fs::path> files;
  std::error_code failed;
  for (const auto& [identity, named] : files_)
    if ((folders == Folders::included || named.folder.empty()) && fs::is_regular_file(named.name, failed))
      files.push_back(named.name);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace palpable::cli
