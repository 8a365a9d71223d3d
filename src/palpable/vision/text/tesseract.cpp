// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/tesseract.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/vision/text/articles.hpp"
#include "palpable/vision/text/numerals.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::vision {
namespace {

namespace fs = std::filesystem;

/// A folder for temporary files, which is removed with all its files.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "palpable-text-XXXXXX").string();
    if (!error && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The program of that name in the folders of PATH; empty if there is none.
fs::path program_in_path(std::string_view name) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders != nullptr ? folders : "/usr/bin:/bin");
  for (std::string folder; std::getline(list, folder, ':');) {
    std::error_code error;
    const fs::path file = fs::path(folder) / name;
    if (!folder.empty() && fs::is_regular_file(file, error)) return file;
  }
  return {};
}

/// Runs a program until it ends, for at most `most_seconds` of processor time, which other programs on the
/// machine do not shorten. Errors: interrupted; failed for a program that cannot be started, fails or takes
/// longer.
Result<void> run_to_end(const std::vector<std::string>& command, double most_seconds, const Work& work) {
  // One thread: the lines are shared between processes.
  std::vector<std::string> arguments{"OMP_THREAD_LIMIT=1"};
  arguments.insert(arguments.end(), command.begin(), command.end());
  const auto child = start_child("/usr/bin/env", arguments, {});
  if (!child) return child.error();
  const auto processor_s = static_cast<rlim_t>(std::ceil(most_seconds));
  const rlimit limit{processor_s, processor_s + 1};
  ::prlimit(*child, RLIMIT_CPU, &limit, nullptr);
  // Readable when the child has ended; the wait is divided only so that a cancel is noticed.
  const Descriptor end(static_cast<int>(::syscall(SYS_pidfd_open, *child, 0)));
  const auto begin = std::chrono::steady_clock::now();
  const auto takes_too_long = [&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    // It may also wait for something that never comes.
    constexpr double kRest = 10.0;
    return passed.count() > kRest * most_seconds;
  };
  pollfd ended{end.number(), POLLIN, 0};
  constexpr int kNotice_ms = 50;
  while (::poll(&ended, 1, kNotice_ms) <= 0 && !work.cancelled() && !takes_too_long()) {
  }
  const bool by_itself = ended.revents != 0;
  if (!by_itself) kill(*child, SIGKILL);
  int status = 0;
  waitpid(*child, &status, 0);
  if (work.cancelled()) return Work::interrupted();
  if (!by_itself || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
    return Error{ErrorCode::failed, fmt::format("{} took too long", command.front()), {}};
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return Error{ErrorCode::failed, fmt::format("{} failed", command.front()), {}};
}

bool write_pgm(const fs::path& path, const cv::Mat& grey) {
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << grey.cols << ' ' << grey.rows << "\n255\n";
  for (int y = 0; y < grey.rows; ++y) file.write(reinterpret_cast<const char*>(grey.ptr(y)), grey.cols);
  return static_cast<bool>(file);
}

bool is_letter(unsigned char c) { return std::isalpha(c) != 0 || c >= 0x80; }

/// Bytes of a quotation mark or dash of Unicode (U+2010 ... U+203F), which Tesseract makes of specks; 0 if
/// there is none at `at`.
std::size_t mark_at(std::string_view text, std::size_t at) {
  constexpr std::size_t kBytes = 3;
  const bool is_mark = at + kBytes <= text.size() && text[at] == '\xE2' && text[at + 1] == '\x80' &&
                       static_cast<unsigned char>(text[at + 2]) >= 0x90;
  return is_mark ? kBytes : 0;
}

/// Without marks before and after the words; empty if there are too few letters in it.
std::string cleaned(const std::string& words, const ReadTextOptions& options) {
  const auto is_word = [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return is_letter(u) || std::isdigit(u) != 0;
  };
  std::size_t first = 0;
  while (first < words.size() && (mark_at(words, first) > 0 || !is_word(words[first])))
    first += std::max<std::size_t>(1, mark_at(words, first));
  std::size_t last = words.size();
  while (last > first && (!is_word(words[last - 1]) || (last >= 3 && mark_at(words, last - 3) > 0)))
    last -= last >= 3 && mark_at(words, last - 3) > 0 ? 3 : 1;
  const std::string out = words.substr(first, last - first);
  const auto letters =
      std::count_if(out.begin(), out.end(), [](char c) { return is_letter(static_cast<unsigned char>(c)); });
  const bool is_text = letters >= options.fewest_letters &&
                       static_cast<double>(letters) >= options.letter_part * static_cast<double>(out.size());
  return is_text ? out : std::string();
}

/// A word of a page, with its box in it.
struct Word {
  std::string text;
  double confidence = 0.0;
  cv::Rect box;
};

bool is_mark(const Word& word) {
  return std::none_of(word.text.begin(), word.text.end(), [](char c) {
    return is_letter(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
}

/// The words of a line as one reading, without marks (arrows) before and after them.
Reading reading_of(std::vector<Word> words, const cv::Mat& picture, const ReadTextOptions& options) {
  while (!words.empty() && is_mark(words.back())) words.pop_back();
  words.erase(words.begin(), std::find_if_not(words.begin(), words.end(), is_mark));
  if (words.size() > 1)
    words.back().text =
        numeral_or(words.back().text, picture(words.back().box & cv::Rect({}, picture.size())));
  Reading out;
  double characters = 0.0;
  for (const Word& word : words) {
    out.text += (out.text.empty() ? "" : " ") + word.text;
    const auto n = static_cast<double>(word.text.size());
    out.confidence += n * word.confidence;
    characters += n;
  }
  out.text = with_numerals(with_articles(cleaned(out.text, options)));
  out.confidence = out.text.empty() ? 0.0 : out.confidence / characters;
  return out.confidence < options.least_confidence ? Reading{} : out;
}

/// Parses a row of Tesseract's table: the page, from 1 on, and a word; nullopt for rows without one.
std::optional<std::pair<std::size_t, Word>> word_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream columns(row);
  for (std::string cell; std::getline(columns, cell, '\t');) cells.push_back(cell);
  constexpr std::size_t kPage = 1, kBox = 6, kConfidence = 10, kText = 11;
  if (cells.size() <= kText) return std::nullopt;
  const auto parse = [](const std::string& text, auto& value) {
    return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
  };
  std::size_t page = 0;
  Word word{cells[kText], -1.0, {}};
  const bool is_row = parse(cells[kPage], page) && parse(cells[kConfidence], word.confidence) &&
                      parse(cells[kBox], word.box.x) && parse(cells[kBox + 1], word.box.y) &&
                      parse(cells[kBox + 2], word.box.width) && parse(cells[kBox + 3], word.box.height);
  const bool is_blank =
      std::all_of(word.text.begin(), word.text.end(), [](unsigned char c) { return std::isspace(c) != 0; });
  if (!is_row || page < 1 || word.confidence < 0.0 || is_blank) return std::nullopt;
  word.confidence /= 100.0;
  return std::pair(page, std::move(word));
}

/// Parses Tesseract's table: one page for each picture.
std::vector<Reading> readings_of_table(const fs::path& path, std::span<const cv::Mat> pictures,
                                       const ReadTextOptions& options) {
  std::vector<std::vector<Word>> words(pictures.size());
  std::ifstream file(path);
  for (std::string row; std::getline(file, row);)
    if (auto word = word_of(row); word && word->first <= words.size())
      words[word->first - 1].push_back(std::move(word->second));
  std::vector<Reading> out;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    out.push_back(reading_of(std::move(words[i]), pictures[i], options));
  return out;
}

/// The languages whose data is installed: the files of Tesseract's data folders.
std::string installed_languages() {
  std::string out;
  std::vector<fs::path> folders;
  if (const char* prefix = std::getenv("TESSDATA_PREFIX")) folders.emplace_back(prefix);
  folders.insert(folders.end(), {"/usr/share/tesseract-ocr/5/tessdata",
                                 "/usr/share/tesseract-ocr/4.00/tessdata", "/usr/share/tessdata"});
  for (const fs::path& folder : folders) {
    std::error_code error;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".traineddata") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    for (const std::string& name : names)
      if (name != "osd" && name != "equ" && name != "snum") out += (out.empty() ? "" : "+") + name;
    if (!out.empty()) break;
  }
  return out;
}

}  // namespace

std::optional<Reader> installed_reader(const std::string& languages) {
  Reader reader{program_in_path("tesseract"), {}};
  std::istringstream list(languages.empty() ? installed_languages() : languages);
  for (std::string language; std::getline(list, language, '+');)
    if (!language.empty()) reader.languages.push_back(language);
  if (reader.program.empty() || reader.languages.empty()) return std::nullopt;
  return reader;
}

Result<std::vector<std::vector<Reading>>> read_pictures(std::span<const cv::Mat> pictures,
                                                        const Reader& reader, const ReadTextOptions& options,
                                                        const Work& work) {
  std::vector<std::vector<Reading>> out(pictures.size(), std::vector<Reading>(reader.languages.size()));
  if (pictures.empty()) return out;
  const TemporaryFolder folder;
  if (folder.path().empty()) return Error{ErrorCode::failed, "no temporary folder could be made", {}};
  for (std::size_t i = 0; i < pictures.size(); ++i)
    if (!write_pgm(folder.path() / fmt::format("{}.pgm", i), pictures[i]))
      return Error{ErrorCode::failed, "a temporary file could not be written", {}};
  // Each process reads a part of the pictures with one language.
  const std::size_t parts =
      std::clamp<std::size_t>(work.thread_count(), 1, std::max<std::size_t>(1, pictures.size() / 4));
  const std::size_t processes = parts * reader.languages.size();
  std::vector<std::optional<Error>> errors(processes);
  parallel_for(work, static_cast<int>(processes), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto number = static_cast<std::size_t>(k);
      const std::size_t part = number % parts, language = number / parts;
      const std::size_t first = part * pictures.size() / parts;
      const std::size_t last = (part + 1) * pictures.size() / parts;
      const fs::path list = folder.path() / fmt::format("list{}.txt", k);
      std::ofstream names(list);
      for (std::size_t i = first; i < last; ++i)
        names << (folder.path() / fmt::format("{}.pgm", i)).string() << '\n';
      names.close();
      const fs::path table = folder.path() / fmt::format("read{}", k);
      auto ran = names ? run_to_end({reader.program.string(), list.string(), table.string(), "-l",
                                     reader.languages[language], "--psm", "7", "tsv"},
                                    options.most_seconds, work)
                       : Error{ErrorCode::failed, "a temporary file could not be written", {}};
      if (!ran) {
        errors[number] = ran.error();
        continue;
      }
      auto readings =
          readings_of_table(table.string() + ".tsv", pictures.subspan(first, last - first), options);
      for (std::size_t i = first; i < last; ++i) out[i][language] = std::move(readings[i - first]);
    }
  });
  for (const auto& error : errors)
    if (error) return *error;
  return out;
}

}  // namespace palpable::vision
