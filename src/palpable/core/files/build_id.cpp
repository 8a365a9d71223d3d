// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/build_id.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

#include <elf.h>
#include <link.h>

namespace palpable {
namespace {

/// Searches the notes of one segment for the identifier. Name and content of a note begin at multiples of the
/// alignment, counted from the note's beginning.
std::string id_in(std::span<const std::byte> notes, std::size_t alignment) {
  const auto padding_after = [alignment](std::size_t size) {
    return (alignment - size % alignment) % alignment;
  };
  ByteReader in(notes, std::endian::native);
  while (in.left() >= sizeof(ElfW(Nhdr))) {
    const std::size_t name_size = in.u32(), content_size = in.u32();
    const std::uint32_t type = in.u32();
    const auto name = in.bytes(name_size + padding_after(sizeof(ElfW(Nhdr)) + name_size));
    const auto content = in.bytes(content_size);
    if (!in.ok()) return {};
    in.bytes(std::min(padding_after(content_size), in.left()));
    if (type != NT_GNU_BUILD_ID || !as_text(name).starts_with("GNU")) continue;
    std::string text;
    for (const std::byte byte : content.first(content_size)) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += kDigits[std::to_integer<unsigned>(byte) >> 4U];
      text += kDigits[std::to_integer<unsigned>(byte) & 15U];
    }
    return text;
  }
  return {};
}

/// The first object is the program itself; the search ends there.
int look(dl_phdr_info* object, std::size_t, void* found) {
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[k];
    if (segment.p_type != PT_NOTE) continue;
    const auto* begin = reinterpret_cast<const std::byte*>(object->dlpi_addr + segment.p_vaddr);
    auto& text = *static_cast<std::string*>(found);
    // Some linkers put notes of both alignments into one segment, and state the greater one.
    for (const std::size_t alignment : {4U, 8U}) {
      text = id_in({begin, segment.p_memsz}, alignment);
      if (!text.empty()) return 1;
    }
  }
  return 1;
}

}  // namespace

std::string build_id() {
  std::string id;
  dl_iterate_phdr(look, &id);
  return id;
}

}  // namespace palpable
