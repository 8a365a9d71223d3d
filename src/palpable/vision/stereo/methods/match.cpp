// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/match.hpp"

#include "palpable/core/system/memory.hpp"
#include "palpable/vision/stereo/methods/matching_memory.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"
#include "palpable/vision/stereo/problem/undefined_pixels.hpp"
#include "palpable/vision/stereo/range/disparity_range.hpp"
#include "palpable/vision/stereo/range/pair_check.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

namespace palpable::vision {
namespace {

struct MethodEntry {
  StereoMethod method;
  std::string_view name;
  std::string_view summary;
  std::string_view paper;
  Result<MatchOutput> (*function)(const MatchInput&, const StereoOptions&, const Work&);
  std::vector<Parameter> (*parameters)(StereoOptions&);
  Result<void> (*check)(const StereoOptions&);
};

/// One method: its own function and its own options.
template <auto kMatch, auto kOptions>
constexpr MethodEntry entry(StereoMethod method, std::string_view name, std::string_view summary,
                            std::string_view paper) {
  return {method,
          name,
          summary,
          paper,
          [](const MatchInput& input, const StereoOptions& options, const Work& work) {
            return kMatch(input, options.*kOptions, work);
          },
          [](StereoOptions& options) { return parameters_of(options.*kOptions); },
          [](const StereoOptions& options) { return check(options.*kOptions); }};
}

constexpr std::array kMethods{
    entry<match_scanline, &StereoOptions::scanline>(StereoMethod::scanline, "scanline",
                                                    "Least-cost paths along scanlines with occlusions",
                                                    "Shi & Pai 1997; Intille & Bobick 1994"),
    entry<match_graph_cut, &StereoOptions::graph_cut>(StereoMethod::graph_cut, "graph-cut",
                                                      "Expansion moves by minimum cuts",
                                                      "Park & Howard 2012, eqs. 1 to 5"),
    entry<match_segments, &StereoOptions::segments>(StereoMethod::segments, "segments",
                                                    "Planes of colour segments",
                                                    "Hong & Chen 2004; Gomez Aguinaga 2012"),
    entry<match_pyramid, &StereoOptions::pyramid>(StereoMethod::pyramid, "pyramid",
                                                  "Normalised correlation from coarse to fine",
                                                  "Beeler et al. 2010; Gomez Aguinaga 2012"),
    entry<match_fast, &StereoOptions::fast>(
        StereoMethod::fast, "fast", "Semi-global matching in 8 bits, for live use", "Hirschmüller 2008"),
    entry<match_best, &StereoOptions::best>(StereoMethod::best, "best",
                                            "Semi-global search over slanted planes, for files",
                                            "Hirschmüller 2008; Mei et al. 2011; Bleyer et al. 2011"),
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

/// Asked before the work: where the system does not say what is available, matching is tried.
Result<void> check_memory(const StereoPair& pair, StereoMethod method, int disparities) {
  const auto available = available_memory_bytes();
  if (!available) return {};
  return check_matching_memory(method, pair.left.width, pair.left.height, disparities, *available);
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

/// A method's result and its confidence, in the frame of `input`.
Result<StereoMatch> match_input(const MatchInput& input, const MethodEntry& method,
                                const StereoOptions& options, const Work& work) {
  Result<MatchOutput> output = method.function(input, options, work);
  if (!output) return output.error();
  StereoMatch found;
  found.confidence = confidence_of(input, output->disparity_px, options.confidence, work);
  if (work.cancelled()) return Work::interrupted();
  found.disparity.disparity_px = std::move(output->disparity_px);
  found.confirmed = std::move(output->confirmed);
  return found;
}

/// Matches an exchanged pair with its first picture as the reference: mirrored, it is the left one.
Result<StereoMatch> match_mirrored(MatchInput& input, const MethodEntry& method, const StereoOptions& options,
                                   const Work& work) {
  mirror(input);
  Result<StereoMatch> found = match_input(input, method, options, work);
  if (!found) return found;
  for (Raster<float>* map : {&found->disparity.disparity_px, &found->confidence, &found->confirmed})
    for (int y = 0; y < map->height(); ++y) std::reverse(map->row(y).begin(), map->row(y).end());
  found->exchanged = true;
  return found;
}

/// The share of the pixels whose depth is no guess.
double measured_share(const Raster<float>& confidence) {
  const auto values = confidence.values();
  const auto measured =
      std::count_if(values.begin(), values.end(), [](float c) { return c >= kGuessedBelow; });
  return static_cast<double>(measured) / static_cast<double>(values.size());
}

/// From the 5th to the 95th percentile of the disparities that are no guess.
double measured_spread_px(const StereoMatch& match) {
  Raster<float> measured = match.confidence;
  for (float& c : measured.values()) c = c >= kGuessedBelow ? 1.0F : 0.0F;
  const Raster<float>& d = match.disparity.disparity_px;
  return static_cast<double>(quantile_where(d, measured, 0.95) - quantile_where(d, measured, 0.05));
}

Result<StereoMatch> match_prepared(const StereoPair& pair, const MethodEntry& method,
                                   const StereoOptions& options, const Work& work) {
  Exposure exposure;
  MatchInput input = prepare_pictures(pair, work, &exposure, options.preparation);
  work.report(0.0, "measuring the pair");
  const DisparityRange searched =
      find_disparity_range(input.left_grey, input.right_grey, options.range, work);
  const VerticalOffset offset = measure_vertical_offset(input.left_grey, input.right_grey, work);
  const double contrast = contrast_beyond_grain(input.left_grey);
  const bool exchanged = options.max_disparity_px == 0 && looks_swapped(searched);
  DisparityRange range = searched;
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
  if (auto fits = check_memory(pair, method.method, input.disparities); !fits) return std::move(fits).error();
  Result<StereoMatch> found =
      exchanged ? match_mirrored(input, method, options, work) : match_input(input, method, options, work);
  if (!found) return found;
  for (float& d : found->disparity.disparity_px.values()) d += static_cast<float>(range.min_px);
  found->disparity.rig = pair.rig;
  const double measured = measured_share(found->confidence);
  found->notes = pair_notes(searched, range, offset, contrast, measured, options.pair_check);
  if (agree(searched, measured, options.pair_check)) {
    if (exposure.differs) found->notes.push_back(sentence_of(exposure));
    if (auto flat = flat_note(measured_spread_px(*found), options.pair_check))
      found->notes.push_back(*std::move(flat));
  }
  forget_undefined(pair, *found);
  return found;
}

}  // namespace

std::string_view name_of(StereoMethod method) { return entry_of(method).name; }

std::string_view summary_of(StereoMethod method) { return entry_of(method).summary; }

std::string_view paper_of(StereoMethod method) { return entry_of(method).paper; }

std::vector<Parameter> parameters_of(StereoOptions& options, StereoMethod method) {
  std::vector<Parameter> all = entry_of(method).parameters(options);
  append_parameters(all, "preparation", parameters_of(options.preparation));
  append_parameters(all, "range", parameters_of(options.range));
  append_parameters(all, "pair_check", parameters_of(options.pair_check));
  append_parameters(all, "confidence", parameters_of(options.confidence));
  return all;
}

Result<void> check(const StereoOptions& options, StereoMethod method) {
  if (auto ok = check_ranges(options.preparation); !ok) return ok;
  if (auto ok = check_ranges(options.range); !ok) return ok;
  if (auto ok = check_ranges(options.pair_check); !ok) return ok;
  if (auto ok = check_ranges(options.confidence); !ok) return ok;
  return entry_of(method).check(options);
}

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
  for (const Image* picture : {&pair.left, &pair.right})
    if (const auto valid = palpable::check(*picture); !valid) return valid.error();
  if (const auto sizes = check_sizes(pair); !sizes) return sizes.error();
  if (const auto defined = check_any_defined(pair); !defined) return defined.error();
  if (pair.frame) {
    auto found = match(in_epipolar_frame(pair), method, options, work);
    return found ? in_left_picture(std::move(*found), pair) : found;
  }
  if (const auto ok = check(options, method); !ok) return ok.error();
  if (options.max_disparity_px < 0 || options.max_disparity_px >= pair.left.width)
    return Error{ErrorCode::usage,
                 "the greatest disparity must lie between 1 and the picture's width less one, " +
                     std::to_string(pair.left.width - 1) + " pixels",
                 {}};
  if (auto fits = check_memory(pair, method, std::max(1, options.max_disparity_px)); !fits)
    return std::move(fits).error();
  try {
    return match_prepared(pair, entry_of(method), options, work);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::failed, "there is not enough memory to match pictures of this size", {}};
  }
}

}  // namespace palpable::vision
