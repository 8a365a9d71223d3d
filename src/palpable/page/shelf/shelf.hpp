// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/page/shelf/job.hpp"
#include "palpable/page/shelf/make_words.hpp"
#include "palpable/page/shelf/making.hpp"
#include "palpable/page/shelf/recent_scenes.hpp"
#include "palpable/page/shelf/touch_slot.hpp"
#include "palpable/page/shelf/uploads.hpp"
#include "palpable/page/shelf_host.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::page::shelf {

/// A sample on the shelf.
struct Sample {
  /// Letters, digits and hyphens.
  std::string name;
  SceneCard card;
  /// The address of its picture among the page's files.
  std::string picture;
  MakeWords make;
};

struct ShelfOptions {
  /// Makes the scenes: this program.
  std::filesystem::path program = "/proc/self/exe";
  std::vector<Sample> samples;
  /// Where the scenes opened lately are kept (user_state_folder()).
  std::filesystem::path state_folder;
  BeginTouch begin_touch;
  MakingLimits making;
  UploadLimits uploads;
  RecentLimits recent;
  /// Scenes that are made at the same time.
  std::size_t most_jobs = 2;
  /// A scene that no page waits for any longer is given up after this time.
  std::chrono::milliseconds patience{10'000};
};

/// The home page's side of the server.
class Shelf final : public ShelfHost {
 public:
  /// Errors: failed, if there is no place for temporary files.
  static Result<std::unique_ptr<Shelf>> open(ShelfOptions options);
  ~Shelf() override;

  /// Whether scenes opened now are on the next shelf, too: false if ShelfOptions::state_folder cannot be
  /// used.
  bool keeps_scenes() const { return recent_.are_lasting(); }

  void update() override;
  std::shared_ptr<PageHost> touch() override { return touch_.current(); }
  Result<std::string> answer(const protocol::FromShelf& message) override;
  Result<std::unique_ptr<Upload>> begin_upload(std::string_view name, std::uint64_t bytes) override;
  std::optional<std::string> picture(std::string_view name) override;
  std::optional<std::filesystem::path> saved_file(std::string_view name) override;

 private:
  Shelf(ShelfOptions options, std::filesystem::path folder, Descriptor owner);

  Result<std::string> handle(const protocol::Look& look);
  Result<std::string> handle(const protocol::Make& wanted);
  Result<std::string> handle(const protocol::Open& wanted);
  Result<std::string> handle(const protocol::SaveAs& wanted);
  Result<std::string> handle(const protocol::Follow& wanted);
  Result<std::string> handle(const protocol::Cancel& wanted);
  Result<std::string> handle(const protocol::Discard& wanted);
  Result<std::string> handle(const protocol::Forget& wanted);
  struct OnShelf {
    JobPlan plan;
    SceneCard card;
  };
  /// A scene of the shelf, as a plan to touch it. `scene` is untrusted.
  std::optional<OnShelf> on_shelf(const std::string& scene);
  Result<std::string> start(JobPlan plan);
  void forget_old_jobs();
  Job* find(std::int64_t number);
  void cancel_refinements(const Job& newest);

  ShelfOptions options_;
  /// For this user alone; removed at the end, or by the next shelf if this process is killed: it is known by
  /// the lock of a file in it.
  std::filesystem::path folder_;
  Descriptor owner_;
  Uploads uploads_;
  RecentScenes recent_;
  TouchSlot touch_;
  JobTools tools_;
  std::int64_t next_job_ = 1;
  /// The oldest first.
  std::list<std::unique_ptr<Job>> jobs_;
};

}  // namespace palpable::page::shelf
