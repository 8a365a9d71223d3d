// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/exr.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <fmt/format.h>

namespace palpable::sources {
namespace {

/// A file in memory, for OpenEXR.
class MemoryStream : public Imf::IStream {
 public:
  explicit MemoryStream(std::span<const std::byte> file) : Imf::IStream("picture"), file_(file) {}

  bool read(char* out, int count) override {
    if (count < 0 || static_cast<std::size_t>(count) > file_.size() - at_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(out, file_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < file_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > file_.size()) throw std::runtime_error("the file ends too early");
    at_ = static_cast<std::size_t>(at);
  }

 private:
  std::span<const std::byte> file_;
  std::size_t at_ = 0;
};

std::vector<std::string> channels_of(const Imf::InputFile& file) {
  std::vector<std::string> names;
  const Imf::ChannelList& list = file.header().channels();
  for (auto it = list.begin(); it != list.end(); ++it)
    if (it.channel().xSampling == 1 && it.channel().ySampling == 1) names.emplace_back(it.name());
  return names;
}

/// Reads the named channels, interleaved, as floats.
Result<Image> read_channels(Imf::InputFile& file, const std::vector<std::string>& names) {
  const Imath::Box2i window = file.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (auto size = check_picture_size(width, height); !size) return std::move(size).error();
  Image image{static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()), 32, {}};
  image.samples.resize(static_cast<std::size_t>(width * height) * names.size());
  const std::size_t pixel = names.size() * sizeof(float);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < names.size(); ++c)
    frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.samples.data() + c, window, pixel,
                                            pixel * static_cast<std::size_t>(width)));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

/// Calls `choose` with the names of the channels and reads the chosen ones; if there are none, the error says
/// which are `wanted`. Catches all exceptions of OpenEXR.
template <class Choose>
Result<Image> decode(std::span<const std::byte> bytes, std::string_view wanted, const Choose& choose) {
  try {
    MemoryStream stream(bytes);
    // Only the caller's thread, since OpenEXR's thread pool ignores the caller's number of threads.
    Imf::InputFile file(stream, 0);
    const std::vector<std::string> chosen = choose(channels_of(file));
    if (chosen.empty()) return invalid_input(fmt::format("is an OpenEXR file without {}", wanted));
    return read_channels(file, chosen);
  } catch (const std::exception&) {
    return invalid_input("is an OpenEXR file that is damaged, cut off or of an unknown kind");
  }
}

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Result<Image> decode_exr(std::span<const std::byte> file) {
  return decode(file, "the channels R, G and B, or Y",
                [](const std::vector<std::string>& names) -> std::vector<std::string> {
                  if (holds(names, "R") && holds(names, "G") && holds(names, "B"))
                    return holds(names, "A") ? std::vector<std::string>{"R", "G", "B", "A"}
                                             : std::vector<std::string>{"R", "G", "B"};
                  if (holds(names, "Y")) return {"Y"};
                  return {};
                });
}

Result<Raster<float>> decode_exr_depth(std::span<const std::byte> file) {
  auto image =
      decode(file, "a channel Z", [](const std::vector<std::string>& names) -> std::vector<std::string> {
        for (const std::string& name : names)
          if (name == "Z" || name.ends_with(".Z")) return {name};
        if (names.size() == 1) return {names.front()};
        return {};
      });
  if (!image) return image.error();
  return Raster<float>(image->width, image->height, std::move(image->samples));
}

}  // namespace palpable::sources
