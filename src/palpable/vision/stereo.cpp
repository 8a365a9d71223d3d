// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo.hpp"

#include "palpable/vision/disparity_range.hpp"
#include "palpable/vision/match_input.hpp"
#include "palpable/vision/stereo_method.hpp"

#include <algorithm>
#include <array>
#include <new>

namespace palpable::vision {
namespace {

struct MethodEntry {
  StereoMethod method;
  std::string_view name;
  /// Null where the method is named by the papers but not built yet.
  MethodFunction function;
};

constexpr std::array kMethods{
    MethodEntry{StereoMethod::scanline, "scanline", nullptr},
    MethodEntry{StereoMethod::graph_cut, "graph-cut", nullptr},
    MethodEntry{StereoMethod::segments, "segments", nullptr},
    MethodEntry{StereoMethod::pyramid, "pyramid", nullptr},
    MethodEntry{StereoMethod::fast, "fast", nullptr},
    MethodEntry{StereoMethod::best, "best", nullptr},
};

const MethodEntry& entry_of(StereoMethod method) {
  return *std::find_if(kMethods.begin(), kMethods.end(), [&](const auto& e) { return e.method == method; });
}

/// The method's function; `best` is scanline until it exists.
MethodFunction function_of(StereoMethod method) {
  const MethodFunction own = entry_of(method).function;
  return own == nullptr && method == StereoMethod::best ? entry_of(StereoMethod::scanline).function : own;
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

}  // namespace

std::string_view name_of(StereoMethod method) { return entry_of(method).name; }

std::optional<StereoMethod> stereo_method_from(std::string_view name) {
  for (const MethodEntry& entry : kMethods)
    if (entry.name == name) return entry.method;
  return std::nullopt;
}

Result<StereoMatch> match(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                          const Work& work) {
  if (const auto sizes = check_sizes(pair); !sizes) return sizes.error();
  const MethodFunction function = function_of(method);
  if (function == nullptr)
    return Error{
        ErrorCode::usage, "the stereo method " + std::string(name_of(method)) + " is not built yet", {}};
  if (options.max_disparity_px < 0 || options.max_disparity_px >= pair.left.width)
    return Error{ErrorCode::usage,
                 "the greatest disparity must lie between 1 and the picture's width less one, " +
                     std::to_string(pair.left.width - 1) + " pixels",
                 {}};
  try {
    MatchInput input = prepare_pictures(pair);
    DisparityRange range{0, options.max_disparity_px, 1.0, 1.0};
    if (options.max_disparity_px == 0) {
      work.report(0.0, "finding the range of disparities");
      range = find_disparity_range(input.left_grey, input.right_grey, work);
    }
    if (work.cancelled()) return Work::interrupted();
    if (range.min_px != 0) {
      input.right = shifted(input.right, range.min_px);
      input.right_grey = shifted(input.right_grey, range.min_px);
    }
    input.disparities = range.max_px - range.min_px + 1;
    Result<MatchOutput> output = function(input, options, work);
    if (!output) return output.error();
    for (float& d : output->disparity_px.values()) d += static_cast<float>(range.min_px);
    return StereoMatch{{std::move(output->disparity_px), pair.rig}, std::move(output->confidence), {}};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::failed, "there is not enough memory to match pictures of this size", {}};
  }
}

}  // namespace palpable::vision
