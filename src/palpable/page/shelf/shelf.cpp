// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/shelf.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/system/system_failure.hpp"
#include "palpable/page/protocol.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <variant>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRemembered = 16;
// Their files take room on the disk.
constexpr std::size_t kMostSaved = 4;
constexpr std::string_view kSamplePrefix = "sample:";
constexpr std::uintmax_t kLargestPicture = 8'000'000;

Result<fs::path> private_folder() {
  std::error_code none;
  std::string name = (fs::temp_directory_path(none) / "palpable-home-XXXXXX").string();
  // mkdtemp() makes it accessible for this user alone.
  if (::mkdtemp(name.data()) == nullptr) return Error{ErrorCode::failed, system_failure(errno).message, name};
  return fs::path(name);
}

/// Locks the file by which a folder's shelf is known; none, if another process has it, or if it is not there
/// and `flags` do not create it.
Descriptor lock_of(const fs::path& folder, int flags) {
  const auto file = folder / "owner";
  Descriptor owner(
      ::open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | flags, S_IRUSR | S_IWUSR));
  return owner.number() >= 0 && ::flock(owner.number(), LOCK_EX | LOCK_NB) == 0 ? std::move(owner)
                                                                                : Descriptor();
}

/// Removes what shelves of this user left behind that were killed.
void remove_abandoned() {
  std::error_code error;
  for (fs::directory_iterator entry(fs::temp_directory_path(error), error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& folder = entry->path();
    struct stat status {};
    if (!folder.filename().string().starts_with("palpable-home-") || ::lstat(folder.c_str(), &status) != 0 ||
        !S_ISDIR(status.st_mode) || status.st_uid != ::getuid() || lock_of(folder, 0).number() < 0)
      continue;
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
}

/// Of a file that is called as a scene: "boat" of one that is called after its picture, boat.png.
std::string file_stem(const std::string& title) {
  constexpr std::size_t kLongestEnding = 5;
  std::string name = safe_file_name(title);
  // Other systems have them not in names of files.
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::string_view("<>:\"|?*").find(c) != std::string::npos; }, '_');
  const fs::path ending = fs::path(name).extension();
  const std::string letters = ending.string();
  const bool is_ending = letters.size() > 1 && letters.size() <= kLongestEnding &&
                         std::all_of(letters.begin() + 1, letters.end(),
                                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); });
  return is_ending ? name.substr(0, name.size() - letters.size()) : name;
}

Error unknown_scene() { return {ErrorCode::failed, "this scene is no longer on the shelf", {}}; }

}  // namespace

Result<std::unique_ptr<Shelf>> Shelf::open(ShelfOptions options) {
  remove_abandoned();
  auto folder = private_folder();
  if (!folder) return folder.error();
  Descriptor owner = lock_of(*folder, O_CREAT);
  if (owner.number() < 0) return Error{ErrorCode::failed, system_failure(errno).message, folder->string()};
  return std::unique_ptr<Shelf>(new Shelf(std::move(options), *std::move(folder), std::move(owner)));
}

Shelf::Shelf(ShelfOptions options, fs::path folder, Descriptor owner)
    : options_(std::move(options)),
      folder_(std::move(folder)),
      owner_(std::move(owner)),
      uploads_(folder_, options_.uploads),
      recent_(options_.state_folder, folder_, options_.recent),
      touch_(options_.begin_touch),
      tools_{options_.program, options_.making, &recent_, &touch_} {}

Shelf::~Shelf() {
  for (const auto& job : jobs_) job->cancel();
  jobs_.clear();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Shelf::update() {
  for (const auto& job : jobs_) {
    if (job->is_under_way() && job->unfollowed() > options_.patience) job->cancel();
    if (job->has_ended() && !job->plan().uploads.empty())
      uploads_.release(job->plan().uploads, job->state().state == "touching");
  }
  forget_old_jobs();
}

void Shelf::forget_old_jobs() {
  const auto forget = [this](std::size_t most, auto&& is_one) {
    const auto is_ended = [&](const auto& job) { return is_one(*job) && job->has_ended(); };
    if (static_cast<std::size_t>(std::count_if(jobs_.begin(), jobs_.end(), is_ended)) <= most) return;
    jobs_.erase(std::find_if(jobs_.begin(), jobs_.end(), is_ended));
  };
  forget(kMostSaved, [](const Job& job) { return job.plan().save.has_value(); });
  forget(kMostRemembered, [](const Job& job) { return !job.plan().save; });
}

Result<std::string> Shelf::answer(const protocol::FromShelf& message) {
  return std::visit([this](const auto& one) { return handle(one); }, message);
}

Result<std::unique_ptr<Upload>> Shelf::begin_upload(std::string_view name, std::uint64_t bytes) {
  return uploads_.begin(name, bytes);
}

std::optional<std::string> Shelf::picture(std::string_view name) {
  const auto path = recent_.picture(name);
  if (!path) return std::nullopt;
  const auto file = read_file(*path, kLargestPicture);
  if (!file) return std::nullopt;
  return std::string(as_text(*file));
}

std::optional<fs::path> Shelf::saved_file(std::string_view name) {
  std::int64_t number = 0;
  std::size_t place = 0;
  const char* const end = name.data() + name.size();
  const auto first = std::from_chars(name.data(), end, number);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, place);
  if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
  const Job* const job = find(number);
  return job == nullptr ? std::nullopt : job->saved_file(place);
}

Result<std::string> Shelf::handle(const protocol::Look&) {
  protocol::Shelf shelf;
  shelf.version = protocol::kVersion;
  for (const Sample& sample : options_.samples)
    shelf.samples.push_back({std::string(kSamplePrefix) + sample.name, sample.card.title, sample.card.kind,
                             sample.card.sentence, sample.picture, forms_of(sample.card.kind)});
  for (RecentScene& scene : recent_.list()) {
    std::optional<std::string> picture;
    if (scene.has_picture) picture = "/picture/" + scene.id;
    auto forms = forms_of(scene.card.kind);
    shelf.recent.push_back({std::move(scene.id), std::move(scene.card.title), std::move(scene.card.kind),
                            std::move(scene.card.sentence), std::move(picture), std::move(forms)});
  }
  if (std::string name = touch_.name(); !name.empty()) shelf.touching = std::move(name);
  shelf.most_files = 8;
  shelf.most_file_bytes = static_cast<std::int64_t>(options_.uploads.most_file_bytes);
  return protocol::write_message(shelf);
}

Result<std::string> Shelf::handle(const protocol::Make& wanted) {
  std::vector<fs::path> files;
  for (const std::string& id : wanted.files) {
    const auto file = uploads_.find(id);
    if (!file) return Error{ErrorCode::failed, "a file is no longer there: choose it again", {}};
    files.push_back(*file);
  }
  auto words = make_words(wanted, files);
  if (!words) return words.error();
  JobPlan plan;
  plan.scene = folder_ / fmt::format("made-{}.palp", next_job_);
  plan.make = *std::move(words);
  plan.is_kept = true;
  plan.uploads = wanted.files;
  auto started = start(std::move(plan));
  if (started) uploads_.hold(wanted.files);
  return started;
}

std::optional<Shelf::OnShelf> Shelf::on_shelf(const std::string& scene) {
  OnShelf found;
  if (const auto file = recent_.scene(scene)) {
    for (RecentScene& one : recent_.list())
      if (one.id == scene) found.card = std::move(one.card);
    found.plan.scene = *file;
    found.plan.recent_id = scene;
    return found;
  }
  for (const Sample& sample : options_.samples) {
    if (scene != std::string(kSamplePrefix) + sample.name) continue;
    found.card = sample.card;
    found.plan.scene = folder_ / fmt::format("sample-{}.palp", sample.name);
    found.plan.make = sample.make;
    return found;
  }
  return std::nullopt;
}

Result<std::string> Shelf::handle(const protocol::Open& wanted) {
  auto found = on_shelf(wanted.scene);
  if (!found) return unknown_scene();
  if (!found->plan.recent_id.empty()) recent_.note_opened(wanted.scene);
  return start(std::move(found->plan));
}

Result<std::string> Shelf::handle(const protocol::SaveAs& wanted) {
  auto found = on_shelf(wanted.scene);
  if (!found) return unknown_scene();
  auto words = save_words(wanted, found->card.kind);
  if (!words) return words.error();
  JobPlan& plan = found->plan;
  const fs::path folder = folder_ / fmt::format("saved-{}", next_job_);
  plan.hidden_folders = {folder.string() + "/", plan.scene.parent_path().string() + "/"};
  plan.save = SavePlan{folder, file_stem(found->card.title) + words->suffix, *std::move(words)};
  return start(std::move(plan));
}

Result<std::string> Shelf::start(JobPlan plan) {
  const auto under_way =
      std::count_if(jobs_.begin(), jobs_.end(), [](const auto& job) { return job->is_under_way(); });
  if (static_cast<std::size_t>(under_way) >= options_.most_jobs)
    return Error{ErrorCode::failed,
                 fmt::format("{} scenes are being made already, in other pages: wait for one, or cancel it",
                             under_way),
                 {}};
  plan.number = next_job_++;
  // The person names a file as it was chosen, not as it is stored.
  for (const std::string& id : plan.uploads) plan.hidden_folders.push_back((folder_ / id).string() + "/");
  jobs_.push_back(std::make_unique<Job>(std::move(plan), tools_));
  if (!jobs_.back()->plan().save) cancel_refinements(*jobs_.back());
  return protocol::write_message(jobs_.back()->follow());
}

// The touch whose finer scene they make is about to end.
void Shelf::cancel_refinements(const Job& newest) {
  for (const auto& job : jobs_)
    if (job.get() != &newest && !job->is_under_way()) job->cancel();
}

Job* Shelf::find(std::int64_t number) {
  for (const auto& job : jobs_)
    if (job->plan().number == number) return job.get();
  return nullptr;
}

Result<std::string> Shelf::handle(const protocol::Follow& wanted) {
  Job* const job = find(wanted.job);
  if (job == nullptr) return unknown_scene();
  return protocol::write_message(job->follow());
}

Result<std::string> Shelf::handle(const protocol::Cancel& wanted) {
  Job* const job = find(wanted.job);
  if (job == nullptr) return unknown_scene();
  job->cancel();
  return protocol::write_message(job->follow());
}

Result<std::string> Shelf::handle(const protocol::Discard& wanted) {
  uploads_.discard(wanted.file);
  return handle(protocol::Look{});
}

Result<std::string> Shelf::handle(const protocol::Forget& wanted) {
  if (wanted.scene) {
    recent_.forget(*wanted.scene);
  } else {
    recent_.forget_all();
  }
  return handle(protocol::Look{});
}

}  // namespace palpable::page::shelf
