// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/input/input.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/name_order.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/formats/vdb/vdb.hpp"
#include "palpable/sources/city_json.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/sources/picture/file_marks.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/solid/mesh_check.hpp"
#include "palpable/sources/stereo/stereo_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::byte>;

constexpr std::array<std::pair<InputKind, std::string_view>, 10> kKindNames{
    {{InputKind::picture, "picture"},
     {InputKind::stereo, "stereo"},
     {InputKind::depth, "depth"},
     {InputKind::video, "video"},
     {InputKind::map, "map"},
     {InputKind::mesh, "mesh"},
     {InputKind::points, "points"},
     {InputKind::shapes, "shapes"},
     {InputKind::level_set, "level-set"},
     {InputKind::scene, "scene"}}};

/// Long enough to skip a phone picture's EXIF block with its thumbnail (at most 64 KiB per segment).
constexpr std::size_t kStartBytes = std::size_t{256} << 10U;

bool is_video(Bytes file) {
  constexpr std::array<std::string_view, 12> kBrands{"isom", "iso2", "iso4", "iso5", "iso6", "mp41",
                                                     "mp42", "avc1", "M4V ", "qt  ", "3gp4", "3gp5"};
  const bool mp4 = has_magic(file, "ftyp", 4) && std::any_of(kBrands.begin(), kBrands.end(), [&](auto brand) {
                     return has_magic(file, brand, 8);
                   });
  return mp4 || (has_magic(file, "RIFF") && has_magic(file, "AVI ", 8)) ||
         has_magic(file, "\x1A\x45\xDF\xA3") || has_magic(file, "OggS") ||
         has_magic(file, std::string_view("\0\0\x01\xBA", 4)) || has_magic(file, "moov", 4) ||
         (has_magic(file, "G") && has_magic(file, "G", 188) && has_magic(file, "G", 376));
}

bool is_map(Bytes file) {
  if (has_magic(file, "OSMHeader", 6)) return true;
  const std::string_view start = as_text(file).substr(0, 1024);
  return start.find("<osm") != std::string_view::npos &&
         start.substr(0, 64).find('<') != std::string_view::npos;
}

/// Wavefront OBJ has no magic number, and its faces may be far from its start: every line must begin with one
/// of its keywords.
bool is_obj(std::string_view start) {
  constexpr std::array<std::string_view, 10> kWords{"v", "vn", "vt", "f",      "o",
                                                    "g", "s",  "l",  "mtllib", "usemtl"};
  int vertices = 0;
  for (std::size_t end = start.find('\n'); end != std::string_view::npos; end = start.find('\n')) {
    const std::string_view line = start.substr(0, end);
    start.remove_prefix(end + 1);
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    if (word.empty() || word.front() == '#') continue;
    if (std::find(kWords.begin(), kWords.end(), word) == kWords.end()) return false;
    if (word == "v") ++vertices;
  }
  return vertices > 0;
}

std::optional<InputKind> solid_kind(Bytes file, std::uintmax_t size) {
  if (has_magic(file, "glTF")) return InputKind::mesh;
  if (formats::is_vdb(file)) return InputKind::level_set;
  if (has_magic(file, "ply\n") || has_magic(file, "ply\r")) {
    const std::string_view text = as_text(file);
    const std::size_t faces = text.find("element face ");
    const bool none = faces == std::string_view::npos || text.substr(faces + 13).starts_with("0\n") ||
                      text.substr(faces + 13).starts_with("0\r");
    return none ? InputKind::points : InputKind::mesh;
  }
  const std::string_view start = as_text(file).substr(0, 4096);
  if (is_city_json(start)) return InputKind::mesh;
  if (start.find("\"primitives\"") != std::string_view::npos && has_magic(file, "{"))
    return InputKind::shapes;
  if (has_magic(file, "solid") && start.find("facet") != std::string_view::npos) return InputKind::mesh;
  if (is_obj(start)) return InputKind::mesh;
  // A binary STL has no magic number, but its size follows from its number of triangles.
  ByteReader reader(file);
  reader.seek(80);
  const std::uint64_t triangles = reader.u32();
  if (reader.ok() && triangles > 0 && size == 84 + 50 * triangles) return InputKind::mesh;
  return std::nullopt;
}

/// A zip archive is a scene file or a NumPy file, which the names of its members show.
Result<InputKind> archive_kind(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  const auto names = formats::member_names(*file);
  if (!names) return invalid_input(names.error().message, path.string());
  if (std::find(names->begin(), names->end(), "scene.json") != names->end()) return InputKind::scene;
  const bool arrays = std::any_of(names->begin(), names->end(),
                                  [](const std::string& name) { return name.ends_with(".npy"); });
  if (arrays) return InputKind::depth;
  return invalid_input("is a zip archive, but neither a scene nor a NumPy file", path.string());
}

/// Whether a file is called like a picture, whatever it holds.
bool is_named_as_picture(const fs::path& file) {
  constexpr std::array<std::string_view, 13> kSuffixes{".png",  ".jpg",  ".jpeg", ".jpe",  ".tif",
                                                       ".tiff", ".heic", ".heif", ".avif", ".webp",
                                                       ".pnm",  ".ppm",  ".pgm"};
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kSuffixes.begin(), kSuffixes.end(), suffix) != kSuffixes.end();
}

/// Names for a sentence: the first of them, and how many more.
std::string some_of(std::vector<std::string> names) {
  std::sort(names.begin(), names.end(), counted_before);
  if (names.size() == 1) return names.front();
  return fmt::format("{} and {} more", names.front(), names.size() - 1);
}

/// The pictures of a folder, as they are counted. `notes`: which files were left out though they are called
/// like pictures.
Result<std::vector<fs::path>> pictures_in(const fs::path& folder, std::vector<Note>& notes) {
  std::error_code failed;
  std::vector<fs::path> files;
  std::vector<std::string> left_out;
  for (auto it = fs::directory_iterator(folder, failed); !failed && it != fs::directory_iterator();
       it.increment(failed)) {
    std::error_code unknown;
    if (!it->is_regular_file(unknown) || it->path().filename().string().starts_with('.')) continue;
    const auto start = read_file_start(it->path(), kStartBytes);
    if (start && picture_format_of(*start))
      files.push_back(it->path());
    else if (is_named_as_picture(it->path()))
      left_out.push_back(it->path().filename().string());
  }
  if (failed) return invalid_input("cannot be read: " + failed.message(), folder.string());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return counted_before(a.filename().string(), b.filename().string());
  });
  if (files.size() < 2)
    return invalid_input(
        "is a folder with fewer than two pictures, so not a sequence: take several while you walk around the "
        "model",
        folder.string());
  if (!left_out.empty()) {
    const char* const why = left_out.size() == 1 ? "was left out: it is not a readable picture"
                                                 : "were left out: they are not readable pictures";
    notes.emplace_back(fmt::format("{} {}.", some_of(std::move(left_out)), why), Reason::unspecified);
  }
  return files;
}

Result<Input> recognise_folder(const fs::path& folder, std::optional<InputKind> wanted) {
  if (wanted.value_or(InputKind::video) != InputKind::video)
    return invalid_input("is a folder; only a sequence of pictures (video) can be one", folder.string());
  std::vector<Note> notes;
  auto files = pictures_in(folder, notes);
  if (!files) return std::move(files).error();
  return Input{InputKind::video, *std::move(files), std::move(notes)};
}

bool holds_a_picture(InputKind kind) { return kind == InputKind::picture || kind == InputKind::stereo; }

/// Whether 16-bit samples are 8-bit ones times 257, as an image editor converts a grey picture.
bool is_stretched_from_8_bits(const Image& image) {
  return image.bits == 16 && std::all_of(image.samples.begin(), image.samples.end(),
                                         [](float v) { return std::lround(v * 65535.0F) % 257 == 0; });
}

/// A picture of one channel may contain depth: the sidecar decides, then the number of bits.
Result<Input> recognise_grey(const fs::path& path, const Image& image) {
  const auto sidecar = read_depth_sidecar(path);
  if (!sidecar) return sidecar.error();
  if (sidecar->meaning || sidecar->metres_per_unit || sidecar->px_per_unit || sidecar->zbuffer)
    return Input{InputKind::depth, {path}, {}};
  if (image.bits <= 8) return Input{InputKind::picture, {path}, {}};
  if (is_stretched_from_8_bits(image))
    return Input{InputKind::picture,
                 {path},
                 {{"This grey picture has 16 bits but only 256 levels, as one of 8 bits: it was taken as a "
                   "picture, not "
                   "as depth.",
                   Reason::unexpected_input_kind}}};
  return Input{InputKind::depth,
               {path},
               {{fmt::format("This picture of one channel and {} bits was taken as depth.", image.bits),
                 Reason::photo_depth_used}}};
}

/// A file's picture if it has one channel. An error of decoding is reported when the file is read.
std::optional<Image> grey_in(Bytes file) {
  const auto format = picture_format_of(file);
  if (format != PictureFormat::png && format != PictureFormat::tiff && format != PictureFormat::pnm)
    return std::nullopt;
  auto image = decode_picture(file);
  return image && image->channels == 1 ? std::optional(*std::move(image)) : std::nullopt;
}

/// A picture of one channel that alone would be taken as depth; false for one that cannot be read.
bool holds_grey_depth(const fs::path& path) {
  const auto file = read_file(path);
  const auto image = file ? grey_in(*file) : std::nullopt;
  if (!image) return false;
  const auto input = recognise_grey(path, *image);
  return input && input->kind == InputKind::depth;
}

Result<Input> recognise_two(std::span<const fs::path> paths, std::optional<InputKind> wanted) {
  Input input{InputKind::stereo, {paths.begin(), paths.end()}, {}};
  std::array<InputKind, 2> kinds{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto kind = kind_of_file(paths[i]);
    if (!kind) return kind.error();
    kinds[i] = *kind;
    if (!holds_a_picture(*kind) && *kind != InputKind::depth)
      return invalid_input("is not a picture, so the two are not a stereo pair", paths[i].string());
  }
  // A depth camera's file beside its colours; two that look like depth are a pair of grey pictures.
  if (kinds == std::array{InputKind::picture, InputKind::picture} && wanted != InputKind::stereo) {
    const std::array depth{holds_grey_depth(paths[0]), holds_grey_depth(paths[1])};
    if (depth[0] != depth[1]) {
      kinds[depth[0] ? 0 : 1] = InputKind::depth;
      if (!wanted)
        input.notes.emplace_back(
            "One picture has one channel and 16 bits: it was taken as the other one's depth.",
            Reason::unexpected_input_kind);
    }
  }
  if (!holds_a_picture(kinds[0]) && holds_a_picture(kinds[1])) std::swap(input.files[0], input.files[1]);
  const bool numbers = kinds[0] == InputKind::depth || kinds[1] == InputKind::depth;
  input.kind = wanted.value_or(numbers ? InputKind::depth : InputKind::stereo);
  if (input.kind != InputKind::stereo && input.kind != InputKind::depth)
    return Error{ErrorCode::usage, "two files are a stereo pair, or a picture with its depth", {}};
  return input;
}

/// A single picture is a picture, unless it is a photograph with depth inside or its pixels are depth.
Result<Input> recognise_one_picture(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  if (!announces_depth(*file)) {
    const auto grey = grey_in(*file);
    auto input = grey ? recognise_grey(path, *grey) : Result(Input{InputKind::picture, {path}, {}});
    if (input && is_animated_png(*file))
      input->notes.emplace_back("This PNG holds several pictures that are shown in turn: the first was used.",
                                Reason::unspecified);
    return input;
  }
  return Input{InputKind::depth,
               {path},
               {Note("The photograph holds depth, which was used.", Reason::photo_depth_used)}};
}

}  // namespace

std::string_view name_of(InputKind kind) { return kKindNames[static_cast<std::size_t>(kind)].second; }

std::optional<InputKind> input_kind_from(std::string_view name) {
  for (const auto& [kind, known] : kKindNames)
    if (name == known) return kind;
  return std::nullopt;
}

Result<InputKind> kind_of_file(const fs::path& path) {
  const auto start = read_file_start(path, kStartBytes);
  if (!start) return start.error();
  const Bytes file = *start;
  std::error_code unknown;
  const std::uintmax_t size = fs::file_size(path, unknown);
  if (has_magic(file, "PK\x03\x04")) return archive_kind(path);
  if (has_magic(file, "\x93NUMPY")) return InputKind::depth;
  if (is_map(file)) return InputKind::map;
  if (is_video(file)) return InputKind::video;
  if (const auto solid = solid_kind(file, unknown ? 0 : size)) return *solid;
  const auto picture = picture_format_of(file);
  // A truncated binary STL can be recognised only by its name; its reader reports what is missing.
  if (!picture && is_named_stl(path)) return InputKind::mesh;
  if (picture == PictureFormat::pfm || picture == PictureFormat::exr) return InputKind::depth;
  if (picture == PictureFormat::jpeg && is_stereo_jpeg(file)) return InputKind::stereo;
  if (picture) return InputKind::picture;
  auto reason = decode_picture(file);
  if (reason) return InputKind::picture;
  reason.error().place = path.string();
  return std::move(reason).error();
}

Result<Input> recognise_input(std::span<const fs::path> paths, std::optional<InputKind> wanted) {
  if (paths.empty()) return Error{ErrorCode::usage, "no input is named", {}};
  std::error_code unknown;
  if (paths.size() == 1 && fs::is_directory(paths[0], unknown)) return recognise_folder(paths[0], wanted);
  if (paths.size() == 2) return recognise_two(paths, wanted);
  if (paths.size() > 2) {
    if (wanted.value_or(InputKind::video) != InputKind::video)
      return Error{ErrorCode::usage, "more than two files can only be a sequence (video)", {}};
    return Input{InputKind::video, {paths.begin(), paths.end()}, {}};
  }
  if (wanted) {
    // The reader of this kind says what a file lacks that can be read.
    if (const auto start = read_file_start(paths[0], 1); !start) return start.error();
    return Input{*wanted, {paths[0]}, {}};
  }
  const auto kind = kind_of_file(paths[0]);
  if (!kind) return kind.error();
  if (*kind == InputKind::picture) return recognise_one_picture(paths[0]);
  return Input{*kind, {paths[0]}, {}};
}

}  // namespace palpable::sources
