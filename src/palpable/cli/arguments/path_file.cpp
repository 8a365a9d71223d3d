// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/path_file.hpp"

#include "palpable/core/files/read_file.hpp"

#include <array>

namespace palpable::cli {

Result<NumberTable> read_number_table(const std::filesystem::path& file,
                                      std::span<const std::string_view> wanted) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  auto table = parse_number_table(*text, wanted);
  if (!table) return invalid_input(table.error().message, file.string());
  return table;
}

Result<std::vector<haptics::PathSample>> read_path(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 4> kColumns{"t_s", "x_m", "y_m", "z_m"};
  const auto table = read_number_table(file, kColumns);
  if (!table) return table.error();
  std::vector<haptics::PathSample> path;
  path.reserve(table->rows());
  for (std::size_t i = 0; i < table->rows(); ++i) {
    const auto row = table->row(i);
    path.push_back({row[0], Point<SceneFrame>{{row[1], row[2], row[3]}}});
  }
  if (const auto valid = haptics::check_path(path); !valid)
    return invalid_input(valid.error().message, file.string());
  return path;
}

}  // namespace palpable::cli
