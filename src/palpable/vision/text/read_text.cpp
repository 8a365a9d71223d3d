// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/read_text.hpp"

#include "palpable/core/system/child_process.hpp"
#include "palpable/vision/text/ink.hpp"
#include "palpable/vision/text/numerals.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <poll.h>
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

/// Runs a program until it ends. Errors: interrupted; failed for a program that cannot be started, fails or
/// takes longer.
Result<void> run_to_end(const std::vector<std::string>& command, double most_seconds, const Work& work) {
  // One thread: the lines are shared between processes.
  std::vector<std::string> arguments{"OMP_THREAD_LIMIT=1"};
  arguments.insert(arguments.end(), command.begin(), command.end());
  const auto child = start_child("/usr/bin/env", arguments, {});
  if (!child) return child.error();
  // Readable when the child has ended; the wait is divided only so that a cancel is noticed.
  const Descriptor end(static_cast<int>(::syscall(SYS_pidfd_open, *child, 0)));
  const auto begin = std::chrono::steady_clock::now();
  const auto takes_too_long = [&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    return passed.count() > most_seconds;
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
  if (!by_itself) return Error{ErrorCode::failed, fmt::format("{} took too long", command.front()), {}};
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return Error{ErrorCode::failed, fmt::format("{} failed", command.front()), {}};
}

/// The picture's dark lettering as black on white, whatever is behind it: grey levels 0 ... 255.
cv::Mat lettering_of(const Raster<Rgb8>& picture, const ReadTextOptions& options) {
  const auto disc = [](int k) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {k, k}); };
  const cv::Mat contrast = darkness_of(picture, options.thickest_stroke_px);
  cv::Mat strongest, out(contrast.size(), CV_8U);
  cv::dilate(contrast, strongest, disc(options.contrast_window_px));
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) {
      const double part = contrast.at<std::uint8_t>(y, x) /
                          std::max<double>(options.full_contrast, strongest.at<std::uint8_t>(y, x));
      out.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(255.0 * (1.0 - part));
    }
  return out;
}

/// A line of lettering, straight, upright and enlarged. Reading goes to the right, or to the left if
/// reversed.
cv::Mat straightened(const cv::Mat& lettering, const TextLine& line, bool reversed,
                     const ReadTextOptions& options) {
  const double scale = options.letter_px / std::max(options.least_height_px, line.height_px);
  const double margin = options.margin * line.height_px;
  std::vector<MapPoint> p = line.centre;
  if (reversed) std::reverse(p.begin(), p.end());
  const double length = static_cast<double>(p.size() - 1);
  const int width = static_cast<int>((length + 2.0 * margin) * scale);
  const int height = static_cast<int>((line.height_px + 2.0 * margin) * scale);
  cv::Mat map_x(height, width, CV_32F), map_y(height, width, CV_32F);
  const auto reach = static_cast<std::ptrdiff_t>(line.height_px);
  for (int x = 0; x < width; ++x) {
    const double u = x / scale - margin;
    const auto i = static_cast<std::ptrdiff_t>(std::clamp(u, 0.0, length));
    const auto before = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i - reach));
    const auto after =
        static_cast<std::size_t>(std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(length), i + reach));
    const double dx = p[after].x - p[before].x;
    const double dy = p[after].y - p[before].y;
    const double n = std::max(1e-9, std::hypot(dx, dy));
    const double rest = u - static_cast<double>(i);
    const auto at = static_cast<std::size_t>(i);
    for (int y = 0; y < height; ++y) {
      const double v = y / scale - 0.5 * line.height_px - margin;
      map_x.at<float>(y, x) = static_cast<float>(p[at].x + rest * dx / n - v * dy / n);
      map_y.at<float>(y, x) = static_cast<float>(p[at].y + rest * dy / n + v * dx / n);
    }
  }
  cv::Mat out;
  cv::remap(lettering, out, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_CONSTANT, cv::Scalar(255));
  if (options.smoothing > 0.0) cv::GaussianBlur(out, out, {}, options.smoothing * options.letter_px);
  const int border = options.border_px;
  cv::copyMakeBorder(out, out, border, border, 2 * border, 2 * border, cv::BORDER_CONSTANT, cv::Scalar(255));
  return out;
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

/// Parses Tesseract's table: one page for each picture, its words with their confidences.
std::vector<ReadLine> lines_of_table(const fs::path& path, std::size_t count,
                                     const ReadTextOptions& options) {
  std::vector<ReadLine> out(count);
  std::vector<double> characters(count, 0.0);
  std::ifstream file(path);
  for (std::string row; std::getline(file, row);) {
    std::vector<std::string> cells;
    std::istringstream columns(row);
    for (std::string cell; std::getline(columns, cell, '\t');) cells.push_back(cell);
    constexpr std::size_t kPage = 1, kConfidence = 10, kText = 11;
    if (cells.size() <= kText) continue;
    std::size_t page = 0;
    double confidence = -1.0;
    const auto parse = [](const std::string& text, auto& value) {
      return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
    };
    if (!parse(cells[kPage], page) || !parse(cells[kConfidence], confidence)) continue;
    const std::string& word = cells[kText];
    if (page < 1 || page > count || confidence < 0.0) continue;
    if (std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isspace(c) != 0; })) continue;
    ReadLine& line = out[page - 1];
    line.text += (line.text.empty() ? "" : " ") + word;
    const auto n = static_cast<double>(word.size());
    line.confidence += n * confidence / 100.0;
    characters[page - 1] += n;
  }
  for (std::size_t i = 0; i < count; ++i) {
    out[i].text = with_numerals(cleaned(out[i].text, options));
    out[i].confidence = out[i].text.empty() ? 0.0 : out[i].confidence / characters[i];
    if (out[i].confidence < options.least_confidence) out[i] = {};
  }
  return out;
}

/// Reads pictures of one line each, in several processes.
Result<std::vector<ReadLine>> read_pictures(const std::vector<cv::Mat>& pictures, const fs::path& tesseract,
                                            const std::string& languages, const ReadTextOptions& options,
                                            const Work& work) {
  const std::size_t processes =
      std::clamp<std::size_t>(work.thread_count(), 1, std::max<std::size_t>(1, pictures.size() / 4));
  std::vector<ReadLine> out(pictures.size());
  if (pictures.empty()) return out;
  std::vector<std::optional<Error>> errors(processes);
  const TemporaryFolder folder;
  if (folder.path().empty()) return Error{ErrorCode::failed, "no temporary folder could be made", {}};
  parallel_for(work, static_cast<int>(processes), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto part = static_cast<std::size_t>(k);
      const std::size_t first = part * pictures.size() / processes;
      const std::size_t last = (part + 1) * pictures.size() / processes;
      const fs::path list = folder.path() / fmt::format("list{}.txt", k);
      std::ofstream names(list);
      bool written = true;
      for (std::size_t i = first; i < last; ++i) {
        const fs::path file = folder.path() / fmt::format("{}.pgm", i);
        written = written && write_pgm(file, pictures[i]);
        names << file.string() << '\n';
      }
      names.close();
      const fs::path table = folder.path() / fmt::format("read{}", k);
      auto ran = written && names ? run_to_end({tesseract.string(), list.string(), table.string(), "-l",
                                                languages, "--psm", "7", "tsv"},
                                               options.most_seconds, work)
                                  : Error{ErrorCode::failed, "a temporary file could not be written", {}};
      if (!ran) {
        errors[part] = ran.error();
        continue;
      }
      const auto lines = lines_of_table(table.string() + ".tsv", last - first, options);
      std::copy(lines.begin(), lines.end(), out.begin() + static_cast<std::ptrdiff_t>(first));
    }
  });
  for (const auto& error : errors)
    if (error) return *error;
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

/// What is compared of two readings of a line.
std::string letters_of(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (is_letter(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Reads the lines again, smaller and larger: a line on which no two sizes agree is not read.
Result<void> keep_agreed(std::vector<ReadLine>& read, std::span<const TextLine> lines,
                         const cv::Mat& lettering, const fs::path& tesseract, const std::string& languages,
                         const ReadTextOptions& options, const Work& work) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < read.size(); ++i)
    if (!read[i].text.empty()) numbers.push_back(i);
  std::vector<std::vector<ReadLine>> again;
  for (const double scale : {options.larger, options.smaller}) {
    ReadTextOptions scaled = options;
    scaled.letter_px = static_cast<int>(std::lround(scale * options.letter_px));
    std::vector<cv::Mat> pictures;
    for (const std::size_t i : numbers)
      pictures.push_back(straightened(lettering, lines[i], read[i].reversed, scaled));
    auto part = read_pictures(pictures, tesseract, languages, scaled, work);
    if (!part) return part.error();
    again.push_back(*std::move(part));
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    ReadLine& line = read[numbers[k]];
    const bool reversed = line.reversed;
    const std::array<ReadLine, 3> readings{line, again[0][k], again[1][k]};
    line = {};
    for (std::size_t a = 0; a < readings.size(); ++a)
      for (std::size_t b = a + 1; b < readings.size(); ++b) {
        const bool same =
            !readings[a].text.empty() && letters_of(readings[a].text) == letters_of(readings[b].text);
        const double confidence = std::max(readings[a].confidence, readings[b].confidence);
        if (same && confidence > line.confidence) line = {readings[a].text, confidence, reversed};
      }
  }
  return {};
}

}  // namespace

Result<TextReading> read_text_lines(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                    const ReadTextOptions& options, const Work& work) {
  TextReading out;
  out.lines.resize(lines.size());
  if (lines.empty()) return out;
  const fs::path tesseract = program_in_path("tesseract");
  const std::string languages = options.languages.empty() ? installed_languages() : options.languages;
  if (tesseract.empty() || languages.empty()) {
    out.notes.emplace_back(
        "Names were not read: that needs the program tesseract and its language data (in Debian: "
        "tesseract-ocr, and "
        "tesseract-ocr-deu for German).");
    return out;
  }
  const cv::Mat lettering = lettering_of(picture, options);
  const auto leftwards = [](const TextLine& line) { return line.centre.back().x < line.centre.front().x; };
  std::vector<cv::Mat> pictures;
  for (const TextLine& line : lines)
    pictures.push_back(straightened(lettering, line, leftwards(line), options));
  const auto unread = [&](const Error& error) -> Result<TextReading> {
    if (error.code == ErrorCode::interrupted) return error;
    TextReading none;
    none.lines.resize(lines.size());
    none.notes.emplace_back("Names were not read: " + error.message +
                            "; check its language data (in Debian: tesseract-ocr-eng).");
    return none;
  };
  auto first = read_pictures(pictures, tesseract, languages, options, work);
  if (!first) return unread(first.error());
  std::vector<std::size_t> unsure;
  pictures.clear();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    out.lines[i] = std::move((*first)[i]);
    out.lines[i].reversed = leftwards(lines[i]);
    if (out.lines[i].confidence >= options.sure) continue;
    unsure.push_back(i);
    pictures.push_back(straightened(lettering, lines[i], !leftwards(lines[i]), options));
  }
  auto second = read_pictures(pictures, tesseract, languages, options, work);
  if (!second) return unread(second.error());
  for (std::size_t k = 0; k < unsure.size(); ++k) {
    ReadLine& line = out.lines[unsure[k]];
    if ((*second)[k].confidence <= line.confidence) continue;
    const bool reversed = !line.reversed;
    line = std::move((*second)[k]);
    line.reversed = reversed;
  }
  const auto agreed = keep_agreed(out.lines, lines, lettering, tesseract, languages, options, work);
  if (!agreed) return unread(agreed.error());
  return out;
}

}  // namespace palpable::vision
