// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/zstd_frame.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>

#include <zstd.h>

namespace palpable::formats {

bool may_unpack(std::size_t packed_bytes, std::uint64_t stated_bytes) {
  constexpr std::uint64_t kAlways = std::uint64_t{128} << 20U, kMostRatio = 4000;
  return stated_bytes <= kAlways || stated_bytes / kMostRatio <= packed_bytes;
}

Result<std::vector<std::byte>> zstd_frame(std::span<const std::byte> bytes, int level) {
  std::size_t done = 0;
  return zstd_frame(
      bytes.size(),
      [&](std::span<std::byte> piece) {
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(done), piece.size(), piece.begin());
        done += piece.size();
      },
      level);
}

Result<std::vector<std::byte>> zstd_frame(std::size_t bytes,
                                          const std::function<void(std::span<std::byte>)>& next, int level) {
  constexpr std::size_t kPiece = std::size_t{1} << 18U;
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  ZSTD_CCtx_setPledgedSrcSize(context.get(), bytes);
  std::vector<std::byte> piece(std::min(bytes, kPiece));
  // In pieces too: a buffer that grows would need up to three times its size.
  std::deque<std::vector<std::byte>> packed;
  std::size_t size = 0;
  std::size_t left = bytes;
  do {
    const std::size_t now = std::min(left, piece.size());
    next(std::span(piece).first(now));
    left -= now;
    ZSTD_inBuffer in{piece.data(), now, 0};
    const ZSTD_EndDirective directive = left == 0 ? ZSTD_e_end : ZSTD_e_continue;
    for (bool is_taken = false; !is_taken;) {
      std::vector<std::byte> room(kPiece);
      ZSTD_outBuffer out{room.data(), room.size(), 0};
      const std::size_t rest = ZSTD_compressStream2(context.get(), &out, &in, directive);
      if (ZSTD_isError(rest) != 0U)
        return Error{ErrorCode::failed, std::string("cannot be packed: ") + ZSTD_getErrorName(rest), {}};
      if (out.pos > 0) packed.emplace_back(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(out.pos));
      size += out.pos;
      is_taken = left == 0 ? rest == 0 : in.pos == in.size;
    }
  } while (left > 0);
  std::vector<std::byte> frame;
  frame.reserve(size);
  for (; !packed.empty(); packed.pop_front())
    frame.insert(frame.end(), packed.front().begin(), packed.front().end());
  return frame;
}

}  // namespace palpable::formats
