// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_picture.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/exif.hpp"
#include "palpable/sources/picture/file_marks.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/picture/picture_reply.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::sources {
namespace {

Note taken_as_metres() {
  return {"The file's numbers were taken as depth in metres.", Reason::depth_numbers_assumed};
}

/// A file's numbers, and their default meaning.
struct Numbers {
  Raster<float> values;
  /// The integer that corresponds to 1.0: 255 or 65535; 1 for floats.
  float most = 1.0F;
  /// The picture in the same file, if there is one.
  std::optional<Image> colour;
  DepthSettings stated;
  std::optional<Note> note;
};

Image without_alpha(const Image& image) {
  Image out{image.width, image.height, image.channels - 1, image.bits, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.samples.size(); ++i)
    if (i % channels != channels - 1) out.samples.push_back(image.samples[i]);
  return out;
}

float most_of(const Image& image) { return image.bits == 8 ? 255.0F : image.bits == 16 ? 65535.0F : 1.0F; }

Numbers from_alpha(const Image& image) {
  Numbers out{Raster<float>(image.width, image.height), most_of(image), without_alpha(image), {}, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < out.values.count(); ++i)
    out.values.values()[i] = std::round(out.most * image.samples[(i + 1) * channels - 1]);
  out.stated.meaning = DepthMeaning::nearness;
  out.note = Note("The picture's alpha channel was taken as nearness: opaque is nearest.");
  return out;
}

Result<Numbers> from_photo(const PhotoDepth& photo, Image colour, int orientation) {
  Image as_image{photo.values.width(),
                 photo.values.height(),
                 1,
                 32,
                 {photo.values.values().begin(), photo.values.values().end()}};
  as_image = upright(std::move(as_image), orientation);
  Numbers out{Raster<float>(as_image.width, as_image.height), 1.0F, std::move(colour), {}, {}};
  std::copy(as_image.samples.begin(), as_image.samples.end(), out.values.values().begin());
  const bool nearness = photo.coding == PhotoDepth::Coding::nearness;
  if (photo.near_m && photo.far_m) {
    ZBuffer buffer;
    buffer.near_m = *photo.near_m;
    buffer.far_m = *photo.far_m;
    buffer.far_plane = ZBuffer::FarPlane::is_a_surface;
    if (photo.coding == PhotoDepth::Coding::range_linear)
      buffer.projection = ZBuffer::Projection::orthographic;
    if (nearness) buffer.order = ZBuffer::Order::near_is_large;
    out.stated.meaning = DepthMeaning::zbuffer;
    out.stated.zbuffer = buffer;
  } else {
    for (float& v : out.values.values()) v = nearness ? v : 1.0F - v;
    out.stated.meaning = DepthMeaning::nearness;
    out.note = Note("The photograph's depth has no unit; only its shape is used.");
  }
  return out;
}

Result<Numbers> from_picture(std::span<const std::byte> file) {
  auto image = decode_picture(file);
  if (!image) return std::move(image).error();
  if (has_magic(file, "\xFF\xD8")) {
    const auto photo = depth_in_jpeg(file);
    if (!photo) return photo.error();
    if (*photo) return from_photo(**photo, *std::move(image), orientation_of(file));
  }
  if (image->channels == 2 || image->channels == 4) return from_alpha(*image);
  auto values = decode_raster(file);
  if (!values) return std::move(values).error();
  Numbers out{*std::move(values), most_of(*image), std::nullopt, {}, {}};
  if (image->bits == 8) {
    out.stated.meaning = DepthMeaning::nearness;
    out.note = Note("An 8-bit picture of depth was taken as nearness: white is nearest.",
                    Reason::depth_meaning_assumed);
  } else if (image->bits == 16) {
    constexpr double kMillimetres = 1e-3;
    out.stated.metres_per_unit = kMillimetres;
    out.note = Note("16-bit depth was taken as millimetres: 1000 is 1 m.", Reason::depth_scale_assumed);
  } else {
    out.note = taken_as_metres();
  }
  return out;
}

Result<Numbers> from_file(std::span<const std::byte> file) {
  if (is_heif(file)) {
    const auto photo = isolated::depth_in_heif(file);
    if (!photo) return photo.error();
    if (!*photo) return invalid_input("is a photograph that holds no depth");
    auto colour = isolated::decode_heif(file);
    if (!colour) return std::move(colour).error();
    constexpr int kUpright = 1;  // libheif has rotated both already
    return from_photo(**photo, *std::move(colour), kUpright);
  }
  const auto format = picture_format_of(file).value_or(PictureFormat::pfm);
  if (format != PictureFormat::pfm && format != PictureFormat::exr) return from_picture(file);
  auto values = decode_raster(file);
  if (!values) return std::move(values).error();
  return Numbers{*std::move(values), 1.0F, std::nullopt, {}, taken_as_metres()};
}

DisparityMap scaled_disparity(const Raster<float>& values, double scale, bool zero_is_unknown) {
  DisparityMap out{Raster<float>(values.width(), values.height(), kUnknownDepth), std::nullopt};
  for (std::size_t i = 0; i < values.count(); ++i) {
    const float v = values.values()[i];
    if (std::isfinite(v) && v >= 0.0F && !(zero_is_unknown && v == 0.0F))
      out.disparity_px.values()[i] = static_cast<float>(scale * static_cast<double>(v));
  }
  return out;
}

/// Converts distances along the rays to depth along the axis.
void turn_distance_into_depth(Raster<float>& values, const Pinhole& c) {
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) {
      const double u = (x - c.cx) / c.fx;
      const double v = (y - c.cy) / c.fy;
      values(x, y) = static_cast<float>(static_cast<double>(values(x, y)) / std::sqrt(1.0 + u * u + v * v));
    }
}

/// A renderer's background (1e10 and similar values) has no depth.
void remove_background_values(Raster<float>& values) {
  constexpr float kEndless = 1e9F;
  for (float& v : values.values())
    if (v >= kEndless) v = kUnknownDepth;
}

Result<std::variant<DepthMap, DisparityMap>> interpreted(Numbers numbers, const DepthSettings& s) {
  using Depth = std::variant<DepthMap, DisparityMap>;
  const DepthMeaning meaning = s.meaning.value_or(DepthMeaning::depth);
  Raster<float>& values = numbers.values;
  const bool integers = numbers.most > 1.0F;
  if (meaning == DepthMeaning::disparity)
    return Depth(scaled_disparity(values, s.px_per_unit.value_or(1.0), integers));
  if (meaning == DepthMeaning::nearness) {
    // The unit is a step of an 8-bit picture, whatever the file's depth.
    constexpr double kSteps = 255.0;
    return Depth(scaled_disparity(values, kSteps / static_cast<double>(numbers.most), false));
  }
  if (meaning == DepthMeaning::zbuffer) {
    if (!s.zbuffer)
      return Error{
          ErrorCode::usage, "a depth buffer needs its near and far planes", {}, Reason::needs_clip_planes};
    for (float& v : values.values()) v /= numbers.most;
    auto depth = linearise_zbuffer(values, *s.zbuffer);
    if (!depth) return std::move(depth).error();
    return Depth(DepthMap{*std::move(depth), std::nullopt});
  }
  if (!integers) remove_background_values(values);
  if (meaning == DepthMeaning::distance) {
    if (!s.camera)
      return Error{ErrorCode::usage,
                   "distances along the rays need the camera, which a sidecar file may state too",
                   {},
                   Reason::needs_calibration};
    turn_distance_into_depth(values, *s.camera);
  }
  return Depth(depth_from_values(values, s.metres_per_unit.value_or(1.0)).depth);
}

const Raster<float>& raster_of(const std::variant<DepthMap, DisparityMap>& depth) {
  const auto* metres = std::get_if<DepthMap>(&depth);
  return metres != nullptr ? metres->depth_m : std::get<DisparityMap>(depth).disparity_px;
}

/// The colour picture at this size: unchanged, or scaled by one factor with nearest neighbours.
Result<Image> fitted(const Image& colour, int width, int height) {
  if (colour.width == width && colour.height == height) return colour;
  const double sx = static_cast<double>(colour.width) / width;
  const double sy = static_cast<double>(colour.height) / height;
  constexpr double kSameShape = 0.02;
  if (std::abs(sx / sy - 1.0) > kSameShape)
    return invalid_input("has " + size_text(colour.width, colour.height) + " pixels, but its depth " +
                         size_text(width, height) + ": they do not show the same");
  Image out{width, height, colour.channels, colour.bits, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* p = colour.pixel(std::min(static_cast<int>((x + 0.5) * sx), colour.width - 1),
                                    std::min(static_cast<int>((y + 0.5) * sy), colour.height - 1));
      out.samples.insert(out.samples.end(), p, p + colour.channels);
    }
  return out;
}

/// Sets the camera, which must match the picture's size.
Result<void> give_camera(DepthPicture& picture, const std::optional<Pinhole>& camera) {
  auto* depth = std::get_if<DepthMap>(&picture.depth);
  if (!camera || depth == nullptr) return {};
  if (camera->width != depth->depth_m.width() || camera->height != depth->depth_m.height())
    return invalid_input("has " + size_text(depth->depth_m.width(), depth->depth_m.height()) +
                         " pixels, but its camera is stated for " + size_text(camera->width, camera->height));
  depth->camera = *camera;
  return {};
}

Result<void> give_colour(DepthPicture& picture, const Image& colour, const DepthSettings& settings) {
  const auto* depth = std::get_if<DepthMap>(&picture.depth);
  const Raster<float>& values = raster_of(picture.depth);
  auto placed = settings.colour && depth != nullptr ? colour_at_depth(*depth, colour, *settings.colour)
                                                    : fitted(colour, values.width(), values.height());
  if (!placed) return std::move(placed).error();
  picture.colour = *std::move(placed);
  return {};
}

Result<DepthPicture> assembled(std::span<const std::byte> file, const std::optional<Image>& colour,
                               const DepthSettings& settings) {
  auto numbers = from_file(file);
  if (!numbers) return std::move(numbers).error();
  DepthPicture out;
  const bool assumed =
      !settings.meaning && !settings.metres_per_unit && !settings.px_per_unit && !settings.zbuffer;
  if (assumed && numbers->note) out.notes.push_back(*numbers->note);
  DepthSettings stated = settings;
  // A given scale, or given planes, also determine the meaning of the numbers.
  if (!stated.meaning && stated.metres_per_unit) stated.meaning = DepthMeaning::depth;
  if (!stated.meaning && stated.px_per_unit) stated.meaning = DepthMeaning::disparity;
  if (!stated.meaning && stated.zbuffer) stated.meaning = DepthMeaning::zbuffer;
  const DepthSettings all = merged(stated, numbers->stated);
  const std::optional<Image> own = std::move(numbers->colour);
  auto depth = interpreted(*std::move(numbers), all);
  if (!depth) return std::move(depth).error();
  out.depth = *std::move(depth);
  const Raster<float>& values = raster_of(out.depth);
  out.unknown = static_cast<std::size_t>(
      std::count_if(values.values().begin(), values.values().end(), [](float v) { return std::isnan(v); }));
  if (out.unknown == values.count())
    return invalid_input("has no pixel with a depth: all are zero, negative, empty or not a number");
  if (auto given = give_camera(out, all.camera); !given) return std::move(given).error();
  const std::optional<Image>& picture = colour ? colour : own;
  if (picture)
    if (auto given = give_colour(out, *picture, all); !given) return std::move(given).error();
  return out;
}

}  // namespace

Result<DepthPicture> read_depth_picture(std::span<const std::filesystem::path> files,
                                        const DepthSettings& settings) {
  if (files.empty() || files.size() > 2)
    return Error{ErrorCode::usage, "depth is one file, or a colour picture and its depth", {}};
  const std::filesystem::path& path = files.back();
  const auto file = read_file(path);
  if (!file) return file.error();
  const auto sidecar = read_depth_sidecar(path);
  if (!sidecar) return sidecar.error();
  std::optional<Image> colour;
  if (files.size() == 2) {
    auto image = read_picture(files.front());
    if (!image) return std::move(image).error();
    colour = *std::move(image);
  }
  auto picture = assembled(*file, colour, merged(settings, *sidecar));
  if (!picture) picture.error().place = path.string();
  return picture;
}

}  // namespace palpable::sources
