// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/npz.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/picture/image.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>

namespace palpable::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written in memory order");

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::string_view kSuffix = ".npy";

struct TypeName {
  NpyType type;
  std::string_view name;
  std::size_t bytes;
};
constexpr std::array<TypeName, 11> kTypes{{{NpyType::boolean, "b1", 1},
                                           {NpyType::u1, "u1", 1},
                                           {NpyType::i1, "i1", 1},
                                           {NpyType::u2, "u2", 2},
                                           {NpyType::i2, "i2", 2},
                                           {NpyType::u4, "u4", 4},
                                           {NpyType::i4, "i4", 4},
                                           {NpyType::u8, "u8", 8},
                                           {NpyType::i8, "i8", 8},
                                           {NpyType::f4, "f4", 4},
                                           {NpyType::f8, "f8", 8}}};

const TypeName& facts_of(NpyType type) { return kTypes[static_cast<std::size_t>(type)]; }

/// The text after 'key': in the header's Python dictionary, without leading blanks.
std::optional<std::string_view> entry(std::string_view header, std::string_view key) {
  const std::string quoted = "'" + std::string(key) + "'";
  const std::size_t at = header.find(quoted);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = header.substr(at + quoted.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(" :"), rest.size()));
  return rest;
}

/// "(3, 4)" or "(3,)" or "()".
std::optional<std::vector<std::size_t>> shape_of(std::string_view text) {
  const std::size_t close = text.find(')');
  if (!text.starts_with('(') || close == std::string_view::npos) return std::nullopt;
  text = text.substr(1, close - 1);
  std::vector<std::size_t> shape;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" ,L"), text.size()));
    if (text.empty()) return shape;
    std::size_t side = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
    constexpr std::size_t kMaxDimensions = 8;
    if (error != std::errc() || shape.size() == kMaxDimensions) return std::nullopt;
    shape.push_back(side);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
}

/// The product of the sides; nullopt if it is larger than any file may hold.
std::optional<std::size_t> count_of(const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (const std::size_t side : shape) {
    if (side != 0 && count > kMaxUnpackedBytes / side) return std::nullopt;
    count *= side;
  }
  return count;
}

void swap_bytes(std::span<std::byte> values, std::size_t each) {
  for (std::size_t i = 0; i + each <= values.size(); i += each)
    std::reverse(values.begin() + static_cast<std::ptrdiff_t>(i),
                 values.begin() + static_cast<std::ptrdiff_t>(i + each));
}

/// From column-major (first index fastest) to row-major.
std::vector<std::byte> to_row_major(std::span<const std::byte> values, const std::vector<std::size_t>& shape,
                                    std::size_t each) {
  std::vector<std::byte> out(values.size());
  std::vector<std::size_t> index(shape.size(), 0);
  std::vector<std::size_t> step(shape.size(), 1);
  for (std::size_t k = 1; k < shape.size(); ++k) step[k] = step[k - 1] * shape[k - 1];
  for (std::size_t i = 0; i < values.size() / each; ++i) {
    std::size_t from = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) from += index[k] * step[k];
    std::memcpy(out.data() + i * each, values.data() + from * each, each);
    for (std::size_t k = shape.size(); k-- > 0;) {
      if (++index[k] < shape[k]) break;
      index[k] = 0;
    }
  }
  return out;
}

template <class T>
T value_at(const std::byte* place) {
  T value{};
  std::memcpy(&value, place, sizeof value);
  return value;
}

template <class T>
NpyArray array_of(NpyType type, std::vector<std::size_t> shape, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  return {type, std::move(shape), {bytes.begin(), bytes.end()}};
}

template <class T>
NpyArray raster_array(NpyType type, const Raster<T>& values) {
  return array_of(type, {static_cast<std::size_t>(values.height()), static_cast<std::size_t>(values.width())},
                  values.values());
}

std::vector<std::size_t> table_shape(std::size_t count, std::size_t columns) {
  if (columns == 0) return {count};
  PALPABLE_CHECK(count % columns == 0);
  return {count / columns, columns};
}

}  // namespace

std::size_t size_of(NpyType type) { return facts_of(type).bytes; }

double NpyArray::number(std::size_t i) const {
  PALPABLE_CHECK(i < count());
  const std::byte* place = bytes.data() + i * size_of(type);
  switch (type) {
    case NpyType::boolean:
    case NpyType::u1:
      return value_at<std::uint8_t>(place);
    case NpyType::i1:
      return value_at<std::int8_t>(place);
    case NpyType::u2:
      return value_at<std::uint16_t>(place);
    case NpyType::i2:
      return value_at<std::int16_t>(place);
    case NpyType::u4:
      return value_at<std::uint32_t>(place);
    case NpyType::i4:
      return value_at<std::int32_t>(place);
    case NpyType::u8:
      return static_cast<double>(value_at<std::uint64_t>(place));
    case NpyType::i8:
      return static_cast<double>(value_at<std::int64_t>(place));
    case NpyType::f4:
      return static_cast<double>(value_at<float>(place));
    case NpyType::f8:
      return value_at<double>(place);
  }
  return 0.0;
}

NpyArray npy_array(const Raster<float>& values) { return raster_array(NpyType::f4, values); }
NpyArray npy_array(const Raster<std::uint8_t>& values) { return raster_array(NpyType::u1, values); }
NpyArray npy_array(const Raster<std::uint16_t>& values) { return raster_array(NpyType::u2, values); }
NpyArray npy_array(double value) { return array_of<double>(NpyType::f8, {}, std::span(&value, 1)); }
NpyArray npy_array(std::span<const double> values, std::size_t columns) {
  return array_of(NpyType::f8, table_shape(values.size(), columns), values);
}
NpyArray npy_array(std::span<const float> values, std::size_t columns) {
  return array_of(NpyType::f4, table_shape(values.size(), columns), values);
}

Result<Raster<float>> raster_of(const NpyArray& array) {
  if (array.shape.size() != 2) return invalid_input("holds an array that is not two-dimensional");
  const auto height = static_cast<std::int64_t>(array.shape[0]);
  const auto width = static_cast<std::int64_t>(array.shape[1]);
  if (auto size = check_picture_size(width, height); !size) return std::move(size).error();
  Raster<float> out(static_cast<int>(width), static_cast<int>(height));
  for (std::size_t i = 0; i < out.count(); ++i) out.values()[i] = static_cast<float>(array.number(i));
  return out;
}

Result<NpyArray> decode_npy(std::span<const std::byte> file) {
  const Error damaged = invalid_input("is a NumPy array that is damaged or cut off");
  ByteReader reader(file);
  if (as_text(reader.bytes(kMagic.size())) != kMagic) return invalid_input("is not a NumPy array");
  const int version = reader.u8();
  reader.skip(1);
  const std::size_t length = version == 1 ? reader.u16() : reader.u32();
  const std::string_view header = as_text(reader.bytes(length));
  const auto descr = entry(header, "descr");
  const auto order = entry(header, "fortran_order");
  const auto shape_text = entry(header, "shape");
  if (!reader.ok() || version < 1 || version > 3 || !descr || !order || !shape_text) return damaged;

  const std::string_view kind = descr->substr(0, 5);
  const auto type = std::find_if(kTypes.begin(), kTypes.end(), [kind](const TypeName& t) {
    return kind.size() == 5 && kind[4] == '\'' && kind.substr(2, 2) == t.name;
  });
  if (type == kTypes.end() || std::string_view("<>|=").find(kind[1]) == std::string_view::npos)
    return invalid_input("holds a NumPy array of a kind that is not numbers");
  const auto shape = shape_of(*shape_text);
  const auto count = shape ? count_of(*shape) : std::nullopt;
  if (!count || *count > reader.left() / type->bytes) return damaged;

  const auto values = reader.bytes(*count * type->bytes);
  NpyArray array{type->type, *shape, {values.begin(), values.end()}};
  if (kind[1] == '>') swap_bytes(array.bytes, type->bytes);
  if (order->starts_with("True") && shape->size() > 1)
    array.bytes = to_row_major(array.bytes, *shape, type->bytes);
  return array;
}

std::vector<std::byte> encode_npy(const NpyArray& array) {
  const TypeName& type = facts_of(array.type);
  std::string header = std::string("{'descr': '") + (type.bytes == 1 ? "|" : "<") + std::string(type.name) +
                       "', 'fortran_order': False, 'shape': (";
  for (const std::size_t side : array.shape) header += std::to_string(side) + ",";
  header += "), }";
  // Magic, version, length and header together fill a multiple of 64 bytes and end in a line feed.
  constexpr std::size_t kBefore = 10;
  header.append(63 - (kBefore + header.size()) % 64, ' ');
  header += '\n';
  std::string start(kMagic);
  start += std::string("\x01\x00", 2);
  start += static_cast<char>(header.size() & 0xFFU);
  start += static_cast<char>(header.size() >> 8U);
  start += header;
  std::vector<std::byte> file;
  file.reserve(start.size() + array.bytes.size());
  const auto head = as_bytes(start);
  file.insert(file.end(), head.begin(), head.end());
  file.insert(file.end(), array.bytes.begin(), array.bytes.end());
  return file;
}

Result<Npz> decode_npz(std::span<const std::byte> file, std::uint64_t most_bytes) {
  const auto members = unzip(file, most_bytes);
  if (!members) return members.error();
  Npz arrays;
  for (const auto& [name, bytes] : *members) {
    if (!name.ends_with(kSuffix)) continue;
    auto array = decode_npy(bytes);
    if (!array) return invalid_input("member " + name + " " + array.error().message);
    arrays.emplace(name.substr(0, name.size() - kSuffix.size()), *std::move(array));
  }
  return arrays;
}

Result<std::vector<std::byte>> encode_npz(const Npz& arrays) {
  ZipMembers members;
  for (const auto& [name, array] : arrays) members.emplace(name + std::string(kSuffix), encode_npy(array));
  return zip(members);
}

Result<Npz> read_npz(const std::filesystem::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  auto arrays = decode_npz(*file);
  if (!arrays) arrays.error().place = path.string();
  return arrays;
}

Result<void> write_npz(const std::filesystem::path& path, const Npz& arrays) {
  const auto file = encode_npz(arrays);
  if (!file) return Error{file.error().code, file.error().message, path.string()};
  return write_file_atomically(path, *file);
}

}  // namespace palpable::formats
