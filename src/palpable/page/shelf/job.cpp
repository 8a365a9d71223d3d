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

#include <fmt/format.h>

namespace palpable::page::shelf {
namespace {

using std::chrono::steady_clock;

// protocol.json
constexpr std::size_t kMostNotes = 16, kMostSaved = 16;
constexpr const char* kIsNotKept =
    "The shelf could not keep this scene: save it if you want to open it again";
/// Of a finer scene that is made while another one is touched.
constexpr int kRefiningNiceness = 10;

}  // namespace

Job::Job(JobPlan plan, const JobTools& tools)
    : plan_(std::move(plan)), tools_(tools), followed_(steady_clock::now()) {
  state_.job = plan_.number;
  state_.state = plan_.save ? "saving" : "making";
  state_.step = "Reading";
  thread_ = std::thread([this] { run(); });
}

Job::~Job() {
  cancel();
  thread_.join();
  // A scene that the shelf keeps was moved there; one that it could not keep goes with its job.
  std::error_code ignored;
  if (plan_.is_kept) std::filesystem::remove(plan_.scene, ignored);
  if (plan_.save) std::filesystem::remove_all(plan_.save->folder, ignored);
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
  return now == "making" || now == "opening" || now == "saving";
}

std::optional<std::filesystem::path> Job::saved_file(std::size_t place) const {
  const std::lock_guard lock(mutex_);
  if (place >= state_.saved.size()) return std::nullopt;
  return plan_.save->folder / state_.saved[place].name;
}

void Job::set_state(const char* state, const std::string& step) {
  const std::lock_guard lock(mutex_);
  state_.state = state;
  state_.step = step;
  state_.fraction.reset();
}

void Job::add_note(std::string sentence) {
  const std::lock_guard lock(mutex_);
  auto& notes = state_.notes;
  if (notes.size() < kMostNotes && std::find(notes.begin(), notes.end(), sentence) == notes.end())
    notes.push_back(std::move(sentence));
}

void Job::run() {
  Result<void> done;
  try {
    done = carry_out();
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
  news.note = [this](std::string sentence) { add_note(std::move(sentence)); };
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

Result<void> Job::carry_out() {
  std::error_code error;
  if (!std::filesystem::exists(plan_.scene, error)) {
    if (plan_.make.words.empty()) return Error{ErrorCode::failed, "this scene is no longer on the shelf", {}};
    const bool in_full = plan_.save || plan_.make.quick_words.empty();
    if (auto made = make(in_full ? plan_.make.words : plan_.make.quick_words, plan_.scene, 0); !made)
      return made;
  }
  if (plan_.save) return save();
  if (auto begun = begin_touch(); !begun) return begun;
  refine();
  return {};
}

Result<void> Job::begin_touch() {
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
  std::string id = plan_.recent_id;
  if (plan_.is_kept) {
    // It can be touched all the same.
    if (auto added = tools_.recent->add(plan_.scene, card, scene_picture(*request.scene, kCardPictureSide))) {
      id = *std::move(added);
    } else {
      add_note(kIsNotKept);
    }
  }
  auto temporary = plan_.scene;
  temporary.replace_filename(fmt::format("named-{}.palp", plan_.number));
  kept_ = std::make_shared<KeptScene>(*tools_.recent, std::move(id), temporary, std::move(read->others));
  request.keep = [kept = kept_](const models::Scene& scene) { return kept->keep(scene); };
  request.notes = state().notes;
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
  std::error_code ignored;
  if (!kept_->replace(out) && !plan_.is_kept) std::filesystem::rename(out, plan_.scene, ignored);
  std::filesystem::remove(out, ignored);
  // Names that were given meanwhile are kept again with it, once the touch has it.
  const std::lock_guard lock(better_->mutex);
  better_->scene = std::make_shared<const models::Scene>(std::move(read->scene));
}

Result<void> Job::save() {
  namespace fs = std::filesystem;
  const SavePlan& plan = *plan_.save;
  set_state("saving", "Saving");
  std::error_code error;
  fs::create_directory(plan.folder, error);
  const fs::path out = plan.folder / plan.file_name;
  if (plan.words.is_copy) {
    if (auto read = formats::read_scene(plan_.scene); !read)
      return Error{read.error().code, read.error().message, plan.file_name};
    if (!error) fs::copy_file(plan_.scene, out, error);
  } else if (!error) {
    std::vector<std::string> words{"export", plan_.scene.string()};
    words.insert(words.end(), plan.words.options.begin(), plan.words.options.end());
    if (auto made = make(words, out, 0); !made) return made;
  }
  if (error) return Error{ErrorCode::failed, error.message(), plan.file_name};
  std::vector<std::string> names;
  for (fs::directory_iterator entry(plan.folder, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().string());
  // The drawing before the sheets of its key.
  std::sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return std::pair(a != plan.file_name, a) < std::pair(b != plan.file_name, b);
  });
  set_state("saved", {});
  const std::lock_guard lock(mutex_);
  for (const std::string& name : names)
    if (state_.saved.size() < kMostSaved)
      state_.saved.push_back({name, fmt::format("/saved/{}/{}", plan_.number, state_.saved.size())});
  return {};
}

}  // namespace palpable::page::shelf
