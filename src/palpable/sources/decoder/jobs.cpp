// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/jobs.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/calibration/calibration_formats.hpp"
#include "palpable/sources/calibration/calibration_reply.hpp"
#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/map/extract_parser.hpp"
#include "palpable/sources/map/extract_reply.hpp"
#include "palpable/sources/picture/decoders.hpp"
#include "palpable/sources/picture/exr.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/picture/picture_reply.hpp"
#include "palpable/sources/solid/mesh_parser.hpp"
#include "palpable/sources/solid/mesh_reply.hpp"

#include <exception>
#include <new>
#include <string>
#include <utility>

namespace palpable::sources::decoder {
namespace {

using isolated::Job;
using Bytes = std::span<const std::byte>;

/// The reply with the decoded value or the error.
template <class T>
ReplyBytes reply_to(const Result<T>& decoded) {
  return {decoded ? isolated::reply_of(*decoded) : isolated::error_reply(decoded.error()), {}};
}

ReplyBytes reply_to(Result<StoredImage>&& decoded) {
  if (!decoded) return {isolated::error_reply(decoded.error()), {}};
  return {isolated::reply_head(*decoded), std::move(decoded->samples)};
}

ReplyBytes announcement(bool announces) {
  isolated::FlatWriter reply;
  isolated::begin_value(reply);
  reply.put(static_cast<std::uint8_t>(announces));
  return {reply.take(), {}};
}

ReplyBytes decoded(Job job, Bytes file) {
  switch (job) {
    case Job::obj:
    case Job::stl:
    case Job::glb:
      return reply_to(parse_mesh(file, std::string(isolated::name_of(job))));
    case Job::tiff:
      return reply_to(decode_tiff(file));
    case Job::webp:
      return reply_to(decode_webp(file));
    case Job::exr:
      return reply_to(decode_exr(file));
    case Job::exr_depth:
      return reply_to(decode_exr_depth(file));
    case Job::heif:
      return reply_to(decode_heif(file));
    case Job::heif_depth:
      return reply_to(depth_in_heif(file));
    case Job::heif_announces_depth:
      return announcement(heif_announces_depth(file));
    case Job::opencv_calibration:
      return reply_to(calibration_from_opencv(as_text(file)));
    case Job::map_extract:
      return reply_to(parse_map_extract(file));
    case Job::video:
      // Done by palpable-video-decoder.
      break;
  }
  return {};
}

}  // namespace

void prepare(Job job) {
  if (job == Job::heif || job == Job::heif_depth || job == Job::heif_announces_depth) load_heif_plugins();
}

ReplyBytes run(Job job, Bytes file) {
  try {
    return decoded(job, file);
  } catch (const std::bad_alloc&) {
    return {isolated::error_reply(
                invalid_input("is damaged or too large: it needs more memory than its size explains")),
            {}};
  } catch (const std::exception& e) {
    return {isolated::error_reply(invalid_input(std::string("is damaged: ") + e.what())), {}};
  }
}

}  // namespace palpable::sources::decoder
