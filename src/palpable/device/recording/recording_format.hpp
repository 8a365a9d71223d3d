// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace palpable::device::recording_format {

// The binary format of docs/recording.md, shared by the writer and the reader. All numbers are little-endian.
inline constexpr std::string_view kMagic = "PALPREC1";
inline constexpr std::uint32_t kHeader = 0x44414548;     // "HEAD"
inline constexpr std::uint32_t kProgram = 0x474F5250;    // "PROG"
inline constexpr std::uint32_t kTicks = 0x4B434954;      // "TICK"
inline constexpr std::uint32_t kMoreTicks = 0x45524F4D;  // "MORE"
inline constexpr std::uint32_t kTurns = 0x4E525554;      // "TURN"
inline constexpr std::uint32_t kFades = 0x45444146;      // "FADE"
inline constexpr std::uint32_t kEnd = 0x20444E45;        // "END "
/// Kind, size of the payload, CRC-32 of the payload.
inline constexpr std::size_t kChunkHead_bytes = 12;
inline constexpr std::size_t kTick_bytes = 192;
inline constexpr std::size_t kTurn_bytes = 144;
inline constexpr std::size_t kFade_bytes = 12;
inline constexpr std::size_t kMostText_bytes = 1U << 20;
inline constexpr std::size_t kMostTicks = 1U << 16;

}  // namespace palpable::device::recording_format
