// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_grid.hpp"

#include "palpable/formats/packing/npz.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <fmt/format.h>

namespace palpable::cli {

/// occupied[i, j, k] (0 or 1) is at origin_m + spacing_m (i, j, k), x right, y up, z towards the user.
Result<Answer> export_grid(const models::Grid& grid, const std::string& output) {
  const models::OccupancyGrid& o = grid.occupancy;
  formats::NpyArray occupied;
  occupied.type = formats::NpyType::u1;
  for (const int count : o.counts()) occupied.shape.push_back(static_cast<std::size_t>(count));
  for (int i = 0; i < o.counts()[0]; ++i)
    for (int j = 0; j < o.counts()[1]; ++j)
      for (int k = 0; k < o.counts()[2]; ++k)
        occupied.bytes.push_back(std::byte{o.occupied(i, j, k) ? std::uint8_t{1} : std::uint8_t{0}});
  const std::array<double, 3> origin_m{o.origin_m().x, o.origin_m().y, o.origin_m().z};
  const formats::Npz arrays{{"occupied", std::move(occupied)},
                            {"origin_m", formats::npy_array(std::span<const double>(origin_m))},
                            {"spacing_m", formats::npy_array(o.spacing_m())}};
  if (const auto written = formats::write_npz(output, arrays); !written) return written.error();
  Answer answer;
  answer.json = {{"output", output}, {"spacing_m", o.spacing_m()}, {"grid", o.counts()}};
  answer.text = fmt::format("{}\n", output);
  return answer;
}

}  // namespace palpable::cli
