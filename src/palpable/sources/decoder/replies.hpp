// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/decoder/jobs.hpp"
#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/picture/picture_reply.hpp"

// How jobs put what they decoded.
namespace palpable::sources::decoder {

/// Puts an error in place of everything that was put before.
inline bool put_error(ReplySink& reply, const Error& error) {
  return reply.restart() && reply.put(isolated::error_reply(error));
}

/// Puts a picture, without a copy of its samples, or the error.
inline bool put_picture(ReplySink& reply, const Result<StoredImage>& decoded) {
  if (!decoded) return put_error(reply, decoded.error());
  return reply.put(isolated::reply_head(*decoded)) && reply.put(decoded->samples);
}

}  // namespace palpable::sources::decoder
