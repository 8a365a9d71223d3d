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

namespace palpable::sources::decoder {
namespace {

using isolated::Job;
using Bytes = std::span<const std::byte>;

/// Puts the decoded value or the error.
template <class T>
bool put(ReplySink& reply, const Result<T>& decoded) {
  return reply.put(decoded ? isolated::reply_of(*decoded) : isolated::error_reply(decoded.error()));
}

bool put_error(ReplySink& reply, const Error& error) {
  return reply.restart() && reply.put(isolated::error_reply(error));
}

/// A picture's samples as a reply, as they come.
class SampleReply final : public SampleSink {
 public:
  explicit SampleReply(ReplySink& reply) : reply_(reply) {}
  bool begin(const StoredImage& head) override { return reply_.put(isolated::reply_head(head)); }
  bool put(std::span<const std::byte> samples) override { return reply_.put(samples); }

 private:
  ReplySink& reply_;
};

bool put_tiff(ReplySink& reply, Bytes file) {
  SampleReply samples(reply);
  const auto decoded = decode_tiff(file, samples);
  return decoded || put_error(reply, decoded.error());
}

bool put(ReplySink& reply, const Result<StoredImage>& decoded) {
  if (!decoded) return put_error(reply, decoded.error());
  return reply.put(isolated::reply_head(*decoded)) && reply.put(decoded->samples);
}

bool put_announcement(ReplySink& reply, bool announces) {
  isolated::FlatWriter flat;
  isolated::begin_value(flat);
  flat.put(static_cast<std::uint8_t>(announces));
  return reply.put(flat.take());
}

bool put_decoded(Job job, Bytes file, ReplySink& reply) {
  switch (job) {
    case Job::obj:
    case Job::stl:
    case Job::glb:
      return put(reply, parse_mesh(file, std::string(isolated::name_of(job))));
    case Job::tiff:
      return put_tiff(reply, file);
    case Job::webp:
      return put(reply, decode_webp(file));
    case Job::exr:
      return put(reply, decode_exr(file));
    case Job::exr_depth:
      return put(reply, decode_exr_depth(file));
    case Job::heif:
      return put(reply, decode_heif(file));
    case Job::heif_depth:
      return put(reply, depth_in_heif(file));
    case Job::heif_announces_depth:
      return put_announcement(reply, heif_announces_depth(file));
    case Job::opencv_calibration:
      return put(reply, calibration_from_opencv(as_text(file)));
    case Job::map_extract:
      return put(reply, parse_map_extract(file));
    case Job::video:
      // Done by palpable-video-decoder.
      break;
  }
  return false;
}

}  // namespace

void prepare(Job job) {
  if (job == Job::heif || job == Job::heif_depth || job == Job::heif_announces_depth) load_heif_plugins();
}

bool run(Job job, Bytes file, ReplySink& reply) {
  try {
    return put_decoded(job, file, reply);
  } catch (const std::bad_alloc&) {
    return put_error(reply,
                     invalid_input("is damaged or too large: it needs more memory than its size explains"));
  } catch (const std::exception& e) {
    return put_error(reply, invalid_input(std::string("is damaged: ") + e.what()));
  }
}

}  // namespace palpable::sources::decoder
