// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/job.hpp"

#include "palpable/core/work.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/page/shelf/scene_card.hpp"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

namespace palpable::page::shelf {
namespace {

using std::chrono::steady_clock;

constexpr int kPictureSide = 480;
constexpr std::size_t kMostNotes = 16;
/// Of a finer scene that is made while another one is touched.
constexpr int kRefiningNiceness = 10;

}  // namespace

Job::Job(JobPlan plan, const JobTools& tools)
    : plan_(std::move(plan)), tools_(tools), followed_(steady_clock::now()) {
  state_.job = plan_.number;
  state_.state = "making";
  state_.step = "Reading";
  thread_ = std::thread([this] { run(); });
}

Job::~Job() {
  cancel();
  thread_.join();
  // A scene that the shelf keeps was moved there; one that it could not keep goes with its job.
  std::error_code ignored;
  if (plan_.is_kept) std::filesystem::remove(plan_.scene, ignored);
}

protocol::Job Job::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

protocol::Job Job::follow() {
  followed_ = steady_clock::now();
  return state();
}

steady_clock::duration Job::unfollowed() const { return steady_clock::now() - followed_; }

bool Job::is_under_way() const {
  const std::string now = state().state;
  return now == "making" || now == "opening";
}

void Job::set_state(const char* state, const std::string& step) {
  const std::lock_guard lock(mutex_);
  state_.state = state;
  state_.step = step;
  state_.fraction.reset();
}

void Job::run() {
  Result<void> done;
  try {
    done = open();
    if (done) refine();
  } catch (const std::exception& e) {
    done = Error{ErrorCode::failed, std::string("the scene could not be opened: ") + e.what(), {}};
  }
  if (!done) {
    set_state(cancelled_ ? "cancelled" : "failed", {});
    const std::lock_guard lock(mutex_);
    if (!cancelled_) state_.sentence = done.error().sentence();
  }
  ended_ = true;
}

Result<void> Job::make(const std::vector<std::string>& words, const std::filesystem::path& out,
                       int niceness) {
  Making making{tools_.program, words, tools_.limits, plan_.hidden_folders};
  making.arguments.insert(making.arguments.end(), {"-o", out.string()});
  making.limits.niceness = niceness;
  MakingNews news;
  news.progress = [this](double fraction, std::string step) {
    const std::lock_guard lock(mutex_);
    state_.fraction = fraction;
    state_.step = std::move(step);
  };
  news.note = [this](std::string sentence) {
    const std::lock_guard lock(mutex_);
    auto& notes = state_.notes;
    if (notes.size() < kMostNotes && std::find(notes.begin(), notes.end(), sentence) == notes.end())
      notes.push_back(std::move(sentence));
  };
  return run_making(making, cancelled_, news);
}

Result<void> Job::keep_names_only(const std::filesystem::path& path, formats::SceneFile& file) const {
  bool changed = false;
  const auto shorten = [&](std::string& word) {
    for (const std::string& folder : plan_.hidden_folders)
      for (auto at = word.find(folder); at != std::string::npos; at = word.find(folder, at)) {
        word.erase(at, folder.size());
        changed = true;
      }
  };
  models::Provenance& source = file.scene.source;
  for (std::string& input : source.inputs) shorten(input);
  for (std::string& word : source.command) shorten(word);
  for (models::SourceFile& one : source.files) shorten(one.name);
  return changed ? formats::write_scene(path, file.scene, file.others) : Result<void>();
}

Result<void> Job::open() {
  std::error_code error;
  if (!std::filesystem::exists(plan_.scene, error)) {
    if (plan_.make.words.empty()) return Error{ErrorCode::failed, "this scene is no longer on the shelf", {}};
    const auto& words = plan_.make.quick_words.empty() ? plan_.make.words : plan_.make.quick_words;
    if (auto made = make(words, plan_.scene, 0); !made) return made;
  }
  set_state("opening", "Opening the touch");
  auto read = formats::read_scene(plan_.scene);
  if (!read) return Error{read.error().code, read.error().message, {}};
  if (cancelled_) return Work::interrupted();
  if (auto kept = keep_names_only(plan_.scene, *read); !kept) return kept;
  TouchRequest request;
  request.scene = std::make_shared<const models::Scene>(std::move(read->scene));
  const SceneCard card = scene_card(*request.scene);
  request.name = card.title;
  request.take_better_scene = [better = better_] {
    const std::lock_guard lock(better->mutex);
    return std::exchange(better->scene, nullptr);
  };
  request.better_follows = !plan_.make.quick_words.empty();
  if (plan_.is_kept) {
    auto id = tools_.recent->add(plan_.scene, card, scene_picture(*request.scene, kPictureSide));
    // It can be touched all the same.
    if (id) recent_id_ = *id;
  }
  if (cancelled_) return Work::interrupted();
  if (auto begun = tools_.touch->replace(request); !begun) return begun;
  set_state("touching", {});
  return {};
}

void Job::refine() {
  if (plan_.make.quick_words.empty()) return;
  auto out = plan_.scene;
  out.replace_filename("finer-" + plan_.scene.filename().string());
  // The first scene stays in place if this fails, or another scene is touched before it is done.
  if (!make(plan_.make.words, out, kRefiningNiceness)) return;
  auto read = formats::read_scene(out);
  if (!read || !keep_names_only(out, *read)) return;
  {
    const std::lock_guard lock(better_->mutex);
    better_->scene = std::make_shared<const models::Scene>(std::move(read->scene));
  }
  std::error_code ignored;
  if (plan_.is_kept) {
    static_cast<void>(tools_.recent->replace(recent_id_, out));
  } else {
    std::filesystem::rename(out, plan_.scene, ignored);
  }
  std::filesystem::remove(out, ignored);
}

}  // namespace palpable::page::shelf
