// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/make_again.hpp"

#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/video/video_outputs.hpp"
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/session/make/source_files.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Whether a scene's file keeps the word unchanged: it is UTF-8, and not too long.
bool is_kept(const std::string& word) {
  const std::string written = Json(word).dump(-1, ' ', false, Json::error_handler_t::ignore);
  return word.size() <= models::kMaxCommandWordBytes && Json::parse(written) == Json(word);
}

bool is_kept(const std::vector<std::string>& command) {
  return command.size() <= models::kMaxCommandWords &&
         std::all_of(command.begin(), command.end(), [](const std::string& word) { return is_kept(word); });
}

/// Replaces a file's name in a word of the command: the whole word, or what follows a mark before a file.
void replace_name(std::string& word, const std::string& name, const std::string& now) {
  const std::size_t at = word.find(name);
  if (at == std::string::npos) return;
  const bool begins = at == 0 || std::string_view("@:=").find(word[at - 1]) != std::string_view::npos;
  const std::size_t end = at + name.size();
  const bool ends = end == word.size() || std::string_view(",?&").find(word[end]) != std::string_view::npos;
  if (begins && ends) word.replace(at, name.size(), now);
}

/// Of a video, --poses names a file that is written.
bool writes_poses(const std::vector<std::string>& command) {
  std::vector<std::string> inputs;
  std::string kind;
  constexpr std::string_view kKind = "--kind=";
  bool has_poses = false;
  for (auto word = command.begin() + 1; word != command.end(); ++word) {
    if (word->starts_with(kKind)) kind = word->substr(kKind.size());
    if (word->starts_with("--poses")) has_poses = true;
    if (!word->starts_with("-")) inputs.push_back(*word);
  }
  return has_poses && is_video(inputs, kind);
}

/// A command, and the files that it reads.
struct Repeated {
  std::vector<std::string> command;
  std::vector<std::filesystem::path> files;
};

/// The scene's command with its files where they are now. Errors: as make_again().
Result<Repeated> repeated(const models::Provenance& source, const std::string& scene, const Work& work) {
  if (source.command.empty())
    return invalid_input("does not state how it was made: give the inputs and the options anew", scene);
  const bool is_maker = source.command.front() == "make" || source.command.front() == "correct";
  // It would never end.
  const bool is_again = std::any_of(source.command.begin(), source.command.end(),
                                    [](const std::string& word) { return word.starts_with("--again"); });
  if (!is_maker || is_again)
    return invalid_input("states that it was made by a command that makes no scenes", scene);
  if (writes_poses(source.command))
    return invalid_input("states that it was made by a command that writes another file", scene);
  auto places = session::find_source_files(source.files, scene, work);
  if (!places) return std::move(places).error();
  std::vector<std::string> command = source.command;
  for (std::size_t i = 0; i < places->size(); ++i)
    if (const std::string now = (*places)[i].string(); now != source.files[i].name)
      for (std::string& word : command) replace_name(word, source.files[i].name, now);
  return Repeated{std::move(command), *std::move(places)};
}

/// The scene's file without where it came from: files may have moved, and the program be another one.
Result<formats::Bytes> bytes_without_source(models::Scene scene) {
  scene.source = {};
  return formats::encode_scene(scene);
}

}  // namespace

MakingWords making_words(const Options& options) { return {options.repeated(), options.input_files()}; }

Result<void> add_making(const MakingWords& words, models::Scene& scene, const Work& work) {
  models::Provenance& source = scene.source;
  source.command = words.command();
  source.files.clear();
  const auto files = words.files();
  if (!is_kept(source.command) || files.size() > models::kMaxSourceFiles) {
    source.command.clear();
    return {};
  }
  auto hashed = session::source_files(files, work);
  if (!hashed) return std::move(hashed).error();
  source.files = *std::move(hashed);
  return {};
}

Result<Answer> make_again(const std::string& scene, const std::string& output, Console& console) {
  const auto before = read_scene_argument(scene);
  if (!before) return before.error();
  const models::Provenance& source = before->scene.source;
  auto again = repeated(source, scene, console.work());
  if (!again) return std::move(again).error();
  again->command.push_back("--output=" + output);
  auto answer = run_command(again->command, again->files, console.options());
  if (!answer && answer.error().code == ErrorCode::usage)
    return invalid_input("states a command that cannot be repeated: " + answer.error().sentence(), scene);
  if (!answer) return answer;
  const auto after = read_scene_argument(output);
  if (!after) return after.error();
  const auto old_bytes = bytes_without_source(before->scene), new_bytes = bytes_without_source(after->scene);
  if (!old_bytes) return old_bytes.error();
  if (!new_bytes) return new_bytes.error();
  const bool is_same = *old_bytes == *new_bytes;
  answer->json["again"] = scene;
  answer->json["identical"] = is_same;
  answer->text += is_same ? fmt::format("the same scene as {}, to the last bit\n", scene)
                          : fmt::format("not the same scene as {}, which {} made\n", scene, source.made_by);
  return answer;
}

}  // namespace palpable::cli
