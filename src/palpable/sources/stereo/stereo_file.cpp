// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/stereo/stereo_file.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/sources/picture/exif.hpp"
#include "palpable/sources/picture/picture.hpp"

#include <algorithm>
#include <optional>

namespace palpable::sources {
namespace {

using Bytes = std::span<const std::byte>;

/// One entry of a multi-picture file's index (CIPA DC-007, 5.2.3.3).
struct MpEntry {
  std::uint32_t attributes = 0;
  std::uint32_t size = 0;
  /// Relative to the start of the multi-picture block; 0 = the first picture of the file.
  std::uint32_t offset = 0;
};

struct MpIndex {
  std::size_t block_at = 0;
  std::vector<MpEntry> stereo;
};

MpIndex stereo_entries(Bytes file) {
  MpIndex index;
  visit_jpeg_segments(file, [&](int marker, Bytes content) {
    constexpr std::size_t kNameBytes = 4;
    if (marker != 0xE2 || !has_magic(content, std::string_view("MPF\0", kNameBytes)) || index.block_at != 0)
      return;
    const Bytes block = content.subspan(kNameBytes);
    index.block_at = static_cast<std::size_t>(block.data() - file.data());
    visit_first_ifd(block, [&](const IfdEntry& entry) {
      constexpr std::uint16_t kEntries = 0xB002;
      constexpr std::uint32_t kEntryBytes = 16;
      if (entry.tag != kEntries) return;
      ByteReader reader(block, has_magic(block, "II") ? std::endian::little : std::endian::big);
      reader.seek(entry.value);
      for (std::uint32_t i = 0; i < entry.count / kEntryBytes && reader.ok(); ++i) {
        const MpEntry picture{reader.u32(), reader.u32(), reader.u32()};
        reader.skip(4);
        constexpr std::uint32_t kDisparity = 0x020002;
        if (reader.ok() && (picture.attributes & 0xFFFFFFU) == kDisparity) index.stereo.push_back(picture);
      }
    });
  });
  return index;
}

/// The 32 bits after "_JPSJPS_" and a length: separation, flags, layout, kind (VRex, 2000).
std::optional<std::uint32_t> jps_descriptor(Bytes file) {
  std::optional<std::uint32_t> found;
  visit_jpeg_segments(file, [&found](int marker, Bytes content) {
    if (found || marker != 0xE3 || !has_magic(content, "_JPSJPS_")) return;
    ByteReader reader(content, std::endian::big);
    reader.skip(10);
    const std::uint32_t descriptor = reader.u32();
    if (reader.ok()) found = descriptor;
  });
  return found;
}

constexpr std::uint32_t kHalfHeight = 1U << 16U;
constexpr std::uint32_t kHalfWidth = 2U << 16U;
constexpr std::uint32_t kLeftFirst = 4U << 16U;

bool is_stereo(std::uint32_t jps) { return (jps & 0xFFU) == 1U; }

Result<StereoLayout> layout_of(std::uint32_t jps) {
  const bool left_first = (jps & kLeftFirst) != 0U;
  switch ((jps >> 8U) & 0xFFU) {
    case 2:
      return left_first ? StereoLayout::side_by_side : StereoLayout::side_by_side_crossed;
    case 3:
      return left_first ? StereoLayout::over_under : StereoLayout::over_under_crossed;
    case 4:
      return invalid_input("is an anaglyph, which holds no two whole pictures");
    default:
      return invalid_input("holds its two pictures in interleaved lines, which is not supported");
  }
}

/// Stretched to twice the width (or height), interpolated: restores the aspect ratio of squeezed halves.
Image stretched(const Image& image, bool across) {
  Image out{across ? 2 * image.width : image.width,
            across ? image.height : 2 * image.height,
            image.channels,
            image.bits,
            {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      // New pixel centres are a quarter of an old pixel from the old ones.
      const int place = across ? x : y;
      const int most = (across ? image.width : image.height) - 1;
      const int near = place / 2;
      const int other = std::clamp(place % 2 == 0 ? near - 1 : near + 1, 0, most);
      const float* a = across ? image.pixel(near, y) : image.pixel(x, near);
      const float* b = across ? image.pixel(other, y) : image.pixel(x, other);
      for (std::size_t c = 0; c < channels; ++c) out.samples.push_back(0.75F * a[c] + 0.25F * b[c]);
    }
  return out;
}

Result<StereoPictures> from_multi_picture(Bytes file, const MpIndex& index) {
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    const MpEntry& entry = index.stereo[i];
    const std::size_t at = entry.offset == 0 ? 0 : index.block_at + entry.offset;
    if (at > file.size() || entry.size > file.size() - at)
      return invalid_input("is a stereo file (MPO) that is cut off: one of its pictures is missing");
    auto picture = decode_picture(file.subspan(at, entry.size));
    if (!picture) return std::move(picture).error();
    pictures.push_back(*std::move(picture));
  }
  return StereoPictures{std::move(pictures[0]), std::move(pictures[1]), {}};
}

Result<StereoPictures> same_size(Result<StereoPictures> pair) {
  if (!pair || (pair->left.width == pair->right.width && pair->left.height == pair->right.height))
    return pair;
  const auto size = [](const Image& i) { return std::to_string(i.width) + " x " + std::to_string(i.height); };
  return invalid_input("the two pictures of a pair have the same size, but the left has " + size(pair->left) +
                       " pixels and the right " + size(pair->right));
}

}  // namespace

Result<StereoPictures> split_pair(const Image& both, StereoLayout layout) {
  if (layout == StereoLayout::automatic)
    layout = both.width > both.height ? StereoLayout::side_by_side : StereoLayout::over_under;
  const bool across = layout == StereoLayout::side_by_side || layout == StereoLayout::side_by_side_crossed;
  auto halves = across ? split_side_by_side(both) : split_over_under(both);
  if (!halves) return std::move(halves).error();
  StereoPictures pair{std::move(halves->first), std::move(halves->second), {}};
  if (layout == StereoLayout::side_by_side_crossed || layout == StereoLayout::over_under_crossed)
    std::swap(pair.left, pair.right);
  return pair;
}

bool is_stereo_jpeg(std::span<const std::byte> file) {
  const auto jps = jps_descriptor(file);
  return (jps && is_stereo(*jps)) || stereo_entries(file).stereo.size() >= 2;
}

Result<StereoPictures> decode_stereo(std::span<const std::byte> file, StereoLayout layout) {
  if (const MpIndex index = stereo_entries(file); index.stereo.size() >= 2)
    return same_size(from_multi_picture(file, index));
  const auto jps = jps_descriptor(file);
  const bool described = jps && is_stereo(*jps);
  if (described && layout == StereoLayout::automatic) {
    const auto stated = layout_of(*jps);
    if (!stated) return stated.error();
    layout = *stated;
  }
  const auto both = decode_picture(file);
  if (!both) return both.error();
  auto pair = split_pair(*both, layout);
  if (!pair || !described || (*jps & (kHalfWidth | kHalfHeight)) == 0U) return pair;
  const bool across = (*jps & kHalfWidth) != 0U;
  if (auto size = check_picture_size(2 * std::int64_t{pair->left.width}, pair->left.height); !size)
    return std::move(size).error();
  pair->left = stretched(pair->left, across);
  pair->right = stretched(pair->right, across);
  pair->notes.emplace_back("The file holds squeezed halves; they were stretched to their aspect ratio.");
  return pair;
}

Result<StereoPictures> read_stereo(std::span<const std::filesystem::path> files, StereoLayout layout) {
  if (files.size() == 1) {
    const auto file = read_file(files[0]);
    if (!file) return file.error();
    auto pair = decode_stereo(*file, layout);
    if (!pair) pair.error().place = files[0].string();
    return pair;
  }
  if (files.size() != 2)
    return Error{ErrorCode::usage, "a stereo pair is two pictures, or one that holds both", {}};
  auto left = read_picture(files[0]);
  if (!left) return std::move(left).error();
  auto right = read_picture(files[1]);
  if (!right) return std::move(right).error();
  auto pair = same_size(StereoPictures{*std::move(left), *std::move(right), {}});
  if (!pair) pair.error().place = files[1].string();
  return pair;
}

}  // namespace palpable::sources
