// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/decoder/replies.hpp"
#include "palpable/sources/picture/decoders.hpp"
#include "palpable/sources/picture/exr.hpp"

namespace palpable::sources::decoder {
namespace {

/// A picture's samples as a reply, as they come.
class SampleReply final : public SampleSink {
 public:
  explicit SampleReply(ReplySink& reply) : reply_(reply) {}
  bool begin(const StoredImage& head) override { return reply_.put(isolated::reply_head(head)); }
  bool put(std::span<const std::byte> samples) override { return reply_.put(samples); }

 private:
  ReplySink& reply_;
};

bool put_tiff(ReplySink& reply, std::span<const std::byte> file) {
  SampleReply samples(reply);
  const auto decoded = decode_tiff(file, samples);
  return decoded || put_error(reply, decoded.error());
}

template <class T>
bool put_floats(ReplySink& reply, const Result<T>& decoded) {
  return decoded ? reply.put(isolated::reply_of(*decoded)) : put_error(reply, decoded.error());
}

}  // namespace

bool run_picture_job(isolated::Job job, std::span<const std::byte> file, ReplySink& reply) {
  switch (job) {
    case isolated::Job::tiff:
      return put_tiff(reply, file);
    case isolated::Job::webp:
      return put_picture(reply, decode_webp(file));
    case isolated::Job::exr:
      return put_floats(reply, decode_exr(file));
    case isolated::Job::exr_depth:
      return put_floats(reply, decode_exr_depth(file));
    default:
      return false;
  }
}

}  // namespace palpable::sources::decoder
