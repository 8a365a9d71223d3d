// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/gzip.hpp"

#include "palpable/core/check.hpp"

#include <zlib.h>

namespace palpable::onefile {

std::vector<std::byte> gzip(std::span<const std::byte> bytes) {
  constexpr int kWindowBits = 15, kGzipWrapper = 16, kMemory = 9;
  z_stream stream{};
  PALPABLE_CHECK(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowBits + kGzipWrapper, kMemory,
                              Z_DEFAULT_STRATEGY) == Z_OK);
  std::vector<std::byte> out(deflateBound(&stream, bytes.size()));
  // zlib does not change the input, though its interface does not say so.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  PALPABLE_CHECK(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace palpable::onefile
