// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace palpable::formats {

/// The number types of NumPy files that can be read and written; written as little-endian.
enum class NpyType : std::uint8_t { boolean, u1, i1, u2, i2, u4, i4, u8, i8, f4, f8 };

std::size_t size_of(NpyType type);

/// A NumPy array: row-major (C order), values in the machine's byte order.
struct NpyArray {
  NpyType type = NpyType::f4;
  /// Outermost first: a picture is {height, width}; empty = a single number.
  std::vector<std::size_t> shape;
  std::vector<std::byte> bytes;

  std::size_t count() const { return bytes.size() / size_of(type); }
  /// Value i in row-major order, as a double (64-bit integers beyond 2^53 are rounded).
  double number(std::size_t i) const;
};

NpyArray npy_array(const Raster<float>& values);
NpyArray npy_array(const Raster<std::uint8_t>& values);
NpyArray npy_array(const Raster<std::uint16_t>& values);
NpyArray npy_array(double value);
/// A list, or (with `columns` > 0) a table of rows of that many values; values.size() is a multiple of
/// columns.
NpyArray npy_array(std::span<const double> values, std::size_t columns = 0);
NpyArray npy_array(std::span<const float> values, std::size_t columns = 0);

/// A two-dimensional array as floats, shape {height, width}. Errors: invalid_input for another shape or more
/// than kMaxPixels values.
Result<Raster<float>> raster_of(const NpyArray& array);

/// Arrays by name, as in numpy.savez and numpy.load.
using Npz = std::map<std::string, NpyArray>;

/// An .npy file: format versions 1 to 3, C or Fortran order, either byte order. Errors: invalid_input for
/// files that are damaged, truncated, or of a type not in NpyType (objects, structures, text, complex
/// numbers).
Result<NpyArray> decode_npy(std::span<const std::byte> file);
/// Version 1.0, little-endian, C order.
std::vector<std::byte> encode_npy(const NpyArray& array);

/// An .npz file, members stored or deflated; members that are not .npy are ignored. Errors as decode_npy(),
/// and for more than `most_bytes` of decompressed members, which are refused before they are unpacked.
Result<Npz> decode_npz(std::span<const std::byte> file, std::uint64_t most_bytes = kMaxUnpackedBytes);
/// Deflated. Errors: failed.
Result<std::vector<std::byte>> encode_npz(const Npz& arrays);

/// The same for a file, written atomically. Errors name the file.
Result<Npz> read_npz(const std::filesystem::path& path);
Result<void> write_npz(const std::filesystem::path& path, const Npz& arrays);

}  // namespace palpable::formats
