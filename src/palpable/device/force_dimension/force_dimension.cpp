// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/force_dimension/force_dimension.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/transport/vendor_text.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

namespace palpable::device {
namespace {

/// The largest box in a device's workspace, ours x, y, z; from the vendor's figures for diameter and length.
struct DhdWorkspace {
  std::string_view name;
  Vec3 size_m;
};
constexpr std::array kWorkspaces{
    DhdWorkspace{"omega", {0.11, 0.11, 0.10}},
    DhdWorkspace{"delta", {0.28, 0.28, 0.25}},
    DhdWorkspace{"sigma", {0.13, 0.13, 0.12}},
    DhdWorkspace{"falcon", {0.09, 0.09, 0.09}},
};
constexpr Vec3 kUnknownWorkspace_m{0.08, 0.08, 0.08};
/// Positions farther from the middle than this are no positions of such a device.
constexpr double kFarthest_m = 0.5;
constexpr int kButtons = 8;
constexpr int kHighestIndex = 15;

bool is_error(int answer) noexcept { return answer < 0; }

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

Error library_error(const DhdFunctions& dhd, const std::string& what) {
  const std::string why = vendor_text(dhd.dhdErrorGetLastStr(), {});
  return {ErrorCode::device, why.empty() ? what : what + " (" + why + ")", "forcedimension"};
}

Traits traits_of(const DhdFunctions& dhd, char number, const ForceDimensionOptions& options) {
  Traits traits;
  traits.name = vendor_text(dhd.dhdGetSystemName(number), "Force Dimension device");
  const std::string name = lower(traits.name);
  const auto known = std::ranges::find_if(
      kWorkspaces, [&](const auto& each) { return name.find(each.name) != std::string::npos; });
  traits.workspace_m = known == kWorkspaces.end() ? kUnknownWorkspace_m : known->size_m;
  const double limit_N = vendor_force_N(dhd.dhdGetMaxForce(number), ForceDimension::kUnknownForce_N);
  traits.max_force_N = options.max_force_N > 0.0 ? std::min(options.max_force_N, limit_N) : limit_N;
  traits.continuous_force_N = options.continuous_force_N;
  traits.delay_samples = 1;
  traits.rate_hz = options.rate_hz;
  return traits;
}

}  // namespace

ForceDimension::ForceDimension(const DhdFunctions& dhd, char number, const ForceDimensionOptions& options)
    : dhd_(dhd), number_(number), traits_(traits_of(dhd, number, options)), fresh_(1.0 / options.rate_hz) {}

Result<std::unique_ptr<ForceDimension>> ForceDimension::open(const DhdFunctions& dhd,
                                                             const ForceDimensionOptions& options) {
  const int count = dhd.dhdGetDeviceCount();
  if (count <= 0) return library_error(dhd, "no device of Force Dimension is plugged in");
  if (options.index >= count)
    return Error{ErrorCode::device,
                 "there is no device " + std::to_string(options.index) + ": " + std::to_string(count) +
                     " plugged in, counted from 0",
                 "forcedimension"};
  const int number = dhd.dhdOpenID(static_cast<char>(options.index));
  if (is_error(number)) return library_error(dhd, "the device cannot be opened");
  std::unique_ptr<ForceDimension> device(new ForceDimension(dhd, static_cast<char>(number), options));
  if (options.initialise && dhd.drdAutoInit != nullptr && is_error(dhd.drdAutoInit(device->number_)))
    return library_error(dhd, "the device did not find its position by itself");
  if (is_error(dhd.dhdSetForce(0.0, 0.0, 0.0, device->number_)) ||
      is_error(dhd.dhdEnableForce(1, device->number_)))
    return library_error(dhd, "the device does not take forces");
  return device;
}

ForceDimension::~ForceDimension() {
  stop();
  dhd_.dhdEnableForce(0, number_);
  dhd_.dhdStop(number_);
  dhd_.dhdClose(number_);
}

Reading ForceDimension::read() noexcept {
  fresh_.pass();
  // The vendor's frame: x towards the user, y to the right, z up.
  Vec3 theirs{NAN, NAN, NAN};
  if (!is_error(dhd_.dhdGetPosition(&theirs.x, &theirs.y, &theirs.z, number_)) && is_finite(theirs) &&
      norm(theirs) < kFarthest_m) {
    std::uint32_t buttons = 0;
    for (int k = 0; k < kButtons; ++k)
      if (dhd_.dhdGetButton(k, number_) == 1) buttons |= 1U << static_cast<unsigned>(k);
    fresh_.renew_plausible({theirs.y, theirs.z, theirs.x}, buttons, Status::ok);
  }
  is_silent_ = fresh_.age_s() > FreshReading::kStale_s;
  // One that takes no forces any more is as one that is silent.
  if (refused_s_ > FreshReading::kStale_s) fresh_.rest();
  return fresh_.now(refused_s_ > FreshReading::kSilent_s);
}

void ForceDimension::write(Vector<DeviceFrame> force_N) noexcept {
  const Vec3 force = fresh_.allowed(force_N.v);
  const bool refused = is_error(dhd_.dhdSetForce(force.z, force.x, force.y, number_));
  refused_s_ = refused ? refused_s_ + 1.0 / traits_.rate_hz : 0.0;
}

void ForceDimension::stop() noexcept { dhd_.dhdSetForce(0.0, 0.0, 0.0, number_); }

std::string ForceDimension::fault() const {
  const std::string why = vendor_text(dhd_.dhdErrorGetLastStr(), {});
  const bool refuses = !is_silent_ && refused_s_ > FreshReading::kSilent_s;
  const std::string what =
      refuses ? "the " + traits_.name + " takes no forces any more" : FreshReading::silence_of(traits_.name);
  return what + (why.empty() ? "" : " (" + why + ")");
}

Result<std::vector<std::string>> force_dimension_ports() {
  const auto dhd = load_dhd({});
  if (!dhd) return dhd.error();
  std::vector<std::string> ports;
  for (int k = 0; k < dhd->dhdGetDeviceCount(); ++k) ports.push_back(std::to_string(k));
  return ports;
}

Result<std::unique_ptr<Device>> open_force_dimension(DeviceUrl& url, const OpenOptions& options) {
  ForceDimensionOptions wanted;
  wanted.initialise = url.take_word("initialise", {"yes", "no"}) == "yes" &&
                      options.vendor_library != VendorLibrary::here_to_free_motors;
  wanted.max_force_N = url.take_number("max-force", 0.0, 0.1, 40.0);
  wanted.continuous_force_N = take_continuous_force(url);
  wanted.rate_hz = options.rate_hz;
  const std::string file = url.take_text("library");
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  const auto index = url.path_number(kHighestIndex);
  if (!index) return index.error();
  wanted.index = std::max(0, *index);
  const auto dhd = load_dhd(file);
  if (!dhd) return dhd.error();
  auto device = ForceDimension::open(*dhd, wanted);
  if (!device) return std::move(device).error();
  return std::unique_ptr<Device>(*std::move(device));
}

}  // namespace palpable::device
