// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/page/protocol.gen.hpp"
#include "palpable/page/shelf/kept_scene.hpp"
#include "palpable/page/shelf/make_words.hpp"
#include "palpable/page/shelf/making.hpp"
#include "palpable/page/shelf/recent_scenes.hpp"
#include "palpable/page/shelf/scene_forms.hpp"
#include "palpable/page/shelf/touch_slot.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace palpable::page::shelf {

/// A scene that is saved as another file.
struct SavePlan {
  /// Of this job alone; it is made, and removed with the job.
  std::filesystem::path folder;
  std::string file_name;
  SaveWords words;
};

/// What a job does: makes a scene unless its file is there already, then begins its touch or saves it.
struct JobPlan {
  std::int64_t number = 0;
  /// The scene's file: taken if it exists, else it is made there.
  std::filesystem::path scene;
  MakeWords make;
  /// Whether the scene is put among those opened lately.
  bool is_kept = false;
  /// The scene's id among those opened lately; empty: it is not one of them yet.
  std::string recent_id;
  /// Set: the scene is saved, and not touched.
  std::optional<SavePlan> save;
  /// The files that it is made of (Uploads).
  std::vector<std::string> uploads;
  /// Their folders, as in Making.
  std::vector<std::string> hidden_folders;
};

/// What all jobs use; outlives them.
struct JobTools {
  std::filesystem::path program;
  MakingLimits limits;
  RecentScenes* recent = nullptr;
  TouchSlot* touch = nullptr;
};

/// One scene on the way from files to a touch, on its own thread. The destructor cancels it and waits for its
/// end, which takes at most 0.2 s unless a touch is being opened.
class Job {
 public:
  Job(JobPlan plan, const JobTools& tools);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const JobPlan& plan() const { return plan_; }
  /// How far it is. Any thread.
  protocol::Job state() const;
  /// The same, and the job counts as followed now. For one thread, as the next two.
  protocol::Job follow();
  void cancel() { cancelled_ = true; }
  /// How long nobody has followed it.
  std::chrono::steady_clock::duration unfollowed() const;
  /// Whether the scene is being made, opened or saved.
  bool is_under_way() const;
  /// A file that it saved, by its place in protocol::Job::saved; nullopt if there is none.
  std::optional<std::filesystem::path> saved_file(std::size_t place) const;
  /// Whether its thread has ended.
  bool has_ended() const { return ended_; }

 private:
  /// A finer scene on its way from the job's thread to the server's; outlives the job if the touch does.
  struct Better {
    std::mutex mutex;
    std::shared_ptr<const models::Scene> scene;
  };

  void run();
  Result<void> carry_out();
  Result<void> begin_touch();
  Result<void> save();
  /// Makes the finer scene, while the first one is touched.
  void refine();
  /// Runs a command that writes `out`.
  Result<void> make(const std::vector<std::string>& words, const std::filesystem::path& out, int niceness);
  /// Files are called in the scene as the person chose them, without the folders of what was received: the
  /// scene outlives those. Rewrites the scene's file if that changes it.
  Result<void> keep_names_only(const std::filesystem::path& path, formats::SceneFile& file) const;
  void set_state(const char* state, const std::string& step);
  /// Each sentence once.
  void add_note(std::string sentence);

  JobPlan plan_;
  const JobTools& tools_;
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> ended_{false};
  /// Outlives the job if the touch does.
  std::shared_ptr<KeptScene> kept_;
  std::shared_ptr<Better> better_ = std::make_shared<Better>();
  mutable std::mutex mutex_;
  protocol::Job state_;
  std::chrono::steady_clock::time_point followed_;
  std::thread thread_;
};

}  // namespace palpable::page::shelf
