// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_page.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/onefile/page_file.hpp"

#include <fmt/format.h>

namespace palpable::cli {

Result<Answer> export_page(const models::Scene& scene, const std::filesystem::path& output) {
  const auto page = onefile::encode_page(scene);
  if (!page) return Error{page.error().code, page.error().message, output.string()};
  if (const auto written = write_file_atomically(output, as_bytes(*page)); !written) return written.error();
  Answer answer;
  answer.json = {{"output", output.string()}, {"bytes", page->size()}};
  answer.text = fmt::format("{}: one page of {:.1f} MB that opens in a browser without a network\n",
                            output.string(), 1e-6 * static_cast<double>(page->size()));
  return answer;
}

}  // namespace palpable::cli
