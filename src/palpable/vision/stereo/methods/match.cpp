// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/match.hpp"

#include "palpable/vision/stereo/methods/best.hpp"
#include "palpable/vision/stereo/methods/fast.hpp"
#include "palpable/vision/stereo/methods/pyramid.hpp"
#include "palpable/vision/stereo/methods/segments.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"
#include "palpable/vision/stereo/range/disparity_range.hpp"
#include "palpable/vision/stereo/range/pair_check.hpp"

#include <algorithm>
#include <array>
#include <new>

namespace palpable::vision {
namespace {

struct MethodEntry {
  StereoMethod method;
  std::string_view name;
  MethodFunction function;
};

constexpr std::array kMethods{
    MethodEntry{StereoMethod::scanline, "scanline", match_scanline},
    MethodEntry{StereoMethod::graph_cut, "graph-cut", match_graph_cut},
    MethodEntry{StereoMethod::segments, "segments", match_segments},
    MethodEntry{StereoMethod::pyramid, "pyramid", match_pyramid},
    MethodEntry{StereoMethod::fast, "fast", match_fast},
    MethodEntry{StereoMethod::best, "best", match_best},
};

const MethodEntry& entry_of(StereoMethod method) {
  return *std::find_if(kMethods.begin(), kMethods.end(), [&](const auto& e) { return e.method == method; });
}

Result<void> check_sizes(const StereoPair& pair) {
  const auto size = [](const Image& i) { return std::to_string(i.width) + "x" + std::to_string(i.height); };
  if (pair.left.width != pair.right.width || pair.left.height != pair.right.height)
    return invalid_input("the two pictures of a stereo pair must have the same size, but the left one has " +
                         size(pair.left) + " and the right one " + size(pair.right) + " pixels");
  if (std::min(pair.left.width, pair.left.height) < kMinStereoSide)
    return invalid_input("a stereo pair needs pictures of at least " + std::to_string(kMinStereoSide) +
                         " pixels on each side, but these have " + size(pair.left));
  return {};
}

void mirror(MatchInput& input) {
  const auto flip = [](auto& picture) {
    for (int y = 0; y < picture.height(); ++y) std::reverse(picture.row(y).begin(), picture.row(y).end());
  };
  flip(input.left);
  flip(input.right);
  flip(input.left_grey);
  flip(input.right_grey);
}

/// Where an exchanged pair's first picture stays the reference: mirrored, it is the left one of its pair.
Result<MatchOutput> match_mirrored(MatchInput& input, MethodFunction function, const StereoOptions& options,
                                   const Work& work) {
  mirror(input);
  Result<MatchOutput> output = function(input, options, work);
  if (!output) return output;
  for (Raster<float>* map : {&output->disparity_px, &output->confidence})
    for (int y = 0; y < map->height(); ++y) std::reverse(map->row(y).begin(), map->row(y).end());
  return output;
}

Result<StereoMatch> match_prepared(const StereoPair& pair, MethodFunction function,
                                   const StereoOptions& options, const Work& work) {
  Exposure exposure;
  MatchInput input = prepare_pictures(pair, work, &exposure);
  work.report(0.0, "looking at the pair");
  DisparityRange range = find_disparity_range(input.left_grey, input.right_grey, work);
  const VerticalOffset offset = measure_vertical_offset(input.left_grey, input.right_grey, work);
  std::vector<std::string> notes = pair_notes(range, offset, contrast_beyond_grain(input.left_grey));
  if (exposure.differs && agree(range)) notes.push_back(sentence_of(exposure));
  const bool exchanged = options.max_disparity_px == 0 && looks_swapped(range);
  if (exchanged) range = {std::max(0, -range.max_px), -range.min_px, range.agreement, range.textured};
  if (options.max_disparity_px > 0) range = {0, options.max_disparity_px, range.agreement, range.textured};
  if (work.cancelled()) return Work::interrupted();

  const int shift = exchanged ? -range.min_px : range.min_px;
  if (shift != 0) {
    input.right = shifted(input.right, shift);
    input.right_grey = shifted(input.right_grey, shift);
  }
  input.disparities = range.max_px - range.min_px + 1;
  input.right_first = std::max(0, range.min_px);
  Result<MatchOutput> output =
      exchanged ? match_mirrored(input, function, options, work) : function(input, options, work);
  if (!output) return output.error();
  for (float& d : output->disparity_px.values()) d += static_cast<float>(range.min_px);
  return StereoMatch{
      {std::move(output->disparity_px), pair.rig}, std::move(output->confidence), std::move(notes)};
}

}  // namespace

std::string_view name_of(StereoMethod method) { return entry_of(method).name; }

std::optional<StereoMethod> stereo_method_from(std::string_view name) {
  for (const MethodEntry& entry : kMethods)
    if (entry.name == name) return entry.method;
  return std::nullopt;
}

std::vector<StereoMethod> available_stereo_methods() {
  std::vector<StereoMethod> methods;
  for (const MethodEntry& entry : kMethods) methods.push_back(entry.method);
  return methods;
}

Result<StereoMatch> match(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                          const Work& work) {
  if (const auto sizes = check_sizes(pair); !sizes) return sizes.error();
  const MethodFunction function = entry_of(method).function;
  if (options.max_disparity_px < 0 || options.max_disparity_px >= pair.left.width)
    return Error{ErrorCode::usage,
                 "the greatest disparity must lie between 1 and the picture's width less one, " +
                     std::to_string(pair.left.width - 1) + " pixels",
                 {}};
  try {
    return match_prepared(pair, function, options, work);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::failed, "there is not enough memory to match pictures of this size", {}};
  }
}

}  // namespace palpable::vision
