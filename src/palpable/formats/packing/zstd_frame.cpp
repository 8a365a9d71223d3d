// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/zstd_frame.hpp"

#include <cstddef>
#include <memory>
#include <string>

#include <zstd.h>

namespace palpable::formats {

bool may_unpack(std::size_t packed_bytes, std::uint64_t stated_bytes) {
  constexpr std::uint64_t kAlways = std::uint64_t{128} << 20U, kMostRatio = 4000;
  return stated_bytes <= kAlways || stated_bytes / kMostRatio <= packed_bytes;
}

Result<std::vector<std::byte>> zstd_frame(std::span<const std::byte> bytes, int level) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  std::vector<std::byte> out(ZSTD_compressBound(bytes.size()));
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  const std::size_t size = ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0U)
    return Error{ErrorCode::failed, std::string("cannot be packed: ") + ZSTD_getErrorName(size), {}};
  // Not the room for bytes that do not shrink: a dense field's members wait together until they are written.
  return std::vector<std::byte>(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace palpable::formats
