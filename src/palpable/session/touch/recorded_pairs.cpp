// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_pairs.hpp"

#include "palpable/core/files/atomic_files.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/session/touch/frame_recorder.hpp"

#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;

Result<void> write_pair(const fs::path& folder, const LivePair& pair) {
  AtomicFiles files;
  for (const auto& [picture, side] : {std::pair(&pair.left, "left"), {&pair.right, "right"}}) {
    const auto file = formats::encode_png(*picture);
    if (!file) return file.error();
    if (auto added = files.add(folder / fmt::format("{:06}.{}.png", pair.number, side), *file); !added)
      return added;
  }
  return files.commit();
}

class RecordedPairs final : public PairSource {
 public:
  RecordedPairs(std::unique_ptr<PairSource> pairs, fs::path folder, std::unique_ptr<FrameRecorder> recorder)
      : pairs_(std::move(pairs)), folder_(std::move(folder)), recorder_(std::move(recorder)) {}

  Result<std::optional<LivePair>> take(std::chrono::steady_clock::time_point deadline) override {
    auto pair = pairs_->take(deadline);
    if (pair && *pair)
      recorder_->keep([folder = folder_, kept = **pair] { return write_pair(folder, kept); });
    return pair;
  }
  bool has_ended() const override { return pairs_->has_ended(); }
  std::optional<std::string> loss() override { return pairs_->loss(); }
  std::optional<std::string> notice() override { return recorder_->notice(); }

 private:
  std::unique_ptr<PairSource> pairs_;
  fs::path folder_;
  std::unique_ptr<FrameRecorder> recorder_;
};

}  // namespace

Result<std::unique_ptr<PairSource>> recorded_pairs(std::unique_ptr<PairSource> pairs,
                                                   const fs::path& folder) {
  auto recorder = FrameRecorder::open(folder);
  if (!recorder) return std::move(recorder).error();
  return std::unique_ptr<PairSource>(
      std::make_unique<RecordedPairs>(std::move(pairs), folder, *std::move(recorder)));
}

}  // namespace palpable::session
