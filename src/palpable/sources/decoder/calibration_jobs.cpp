// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/calibration/calibration_formats.hpp"
#include "palpable/sources/calibration/calibration_reply.hpp"
#include "palpable/sources/decoder/replies.hpp"

namespace palpable::sources::decoder {

bool run_calibration_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  if (job != isolated::Job::opencv_calibration) return false;
  const auto calibration = calibration_from_opencv(as_text(file));
  return calibration ? reply.put(isolated::reply_of(*calibration)) : put_error(reply, calibration.error());
}

}  // namespace palpable::sources::decoder
