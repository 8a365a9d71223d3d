// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/jobs.hpp"

#include <cstdint>
#include <span>

// Runs the third-party libraries as the decoder programs call them. A fault in such a library ends only that
// process; this target looks for faults in our code around them. The first byte selects the job.
namespace {

/// Takes every reply and keeps none.
class Nowhere : public palpable::sources::decoder::ReplySink {
 public:
  bool put(std::span<const std::byte>) override { return true; }
  bool restart() override { return true; }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace decoder = palpable::sources::decoder;
  using palpable::sources::isolated::Job;
  if (size < 2) return 0;
  constexpr int kJobs = static_cast<int>(Job::map_extract) + 1;
  const auto job = static_cast<Job>(data[0] % kJobs);
  Nowhere reply;
  const auto file = std::as_bytes(std::span(data + 1, size - 1));
  for (const decoder::RunJob run : {decoder::run_calibration_job, decoder::run_heif_job, decoder::run_map_job,
                                    decoder::run_mesh_job, decoder::run_picture_job})
    static_cast<void>(decoder::run_guarded(run, job, file, reply));
  return 0;
}
