// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/open_haptics/open_haptics.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/transport/vendor_text.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace palpable::device {
namespace {

constexpr double kMetres = 1e-3;
/// The force limit of a device for which the library states none.
constexpr double kUnknownForceLimit_N = 3.3;
constexpr Vec3 kUnknownTouchWorkspace_m{0.16, 0.12, 0.07};
/// Positions farther from the middle than this are no positions of such a device.
constexpr double kFarthestTouch_m = 0.6;
/// How long closing waits for the library's thread.
constexpr auto kPatience = std::chrono::milliseconds(20);
/// Of the library's thread.
constexpr double kCallPeriod_s = 0.001;
/// Calls between two looks at the calibration: it may be lost during a touch.
constexpr int kCalibrationPause = 100;
/// Calls without another error of the forces, after which the last one is over.
constexpr int kForceErrorPause = 2000;

bool stops_the_loop(unsigned code) noexcept {
  return code != 0 && (code < hd::kFirstForceError || code > hd::kLastForceError);
}

Error opening_error(const HdFunctions& functions, const std::string& what, unsigned code) {
  return {ErrorCode::device,
          what + " (" + vendor_text(functions.hdGetErrorString(code), "no reason given") + ")", "touch"};
}

/// Both corners of the usable workspace, millimetres; {0} if the library states none.
std::array<double, 6> usable_workspace_mm(const HdFunctions& functions) {
  std::array<double, 6> corners{};
  functions.hdGetDoublev(hd::kUsableWorkspace, corners.data());
  functions.hdGetError();
  const bool is_box = std::ranges::all_of(corners, [](double value) { return std::isfinite(value); }) &&
                      corners[3] > corners[0] && corners[4] > corners[1] && corners[5] > corners[2];
  return is_box ? corners : std::array<double, 6>{};
}

/// A force that the library states, N; nullopt if it states none.
std::optional<double> stated_force(const HdFunctions& functions, unsigned what) {
  double force_N = 0.0;
  functions.hdGetDoublev(what, &force_N);
  functions.hdGetError();
  return force_N > 0.0 && std::isfinite(force_N) ? std::optional(force_N) : std::nullopt;
}

}  // namespace

OpenHaptics::OpenHaptics(const HdFunctions& hd, unsigned handle, const OpenHapticsOptions& options)
    : hd_(hd), handle_(handle), fresh_(1.0 / options.rate_hz) {
  hd_.hdMakeCurrentDevice(handle_);
  traits_.name = vendor_text(hd_.hdGetString(hd::kModel), "3D Systems device");
  const auto box = usable_workspace_mm(hd_);
  const Vec3 size_mm{box[3] - box[0], box[4] - box[1], box[5] - box[2]};
  traits_.workspace_m = size_mm.x > 0.0 ? kMetres * size_mm : kUnknownTouchWorkspace_m;
  centre_mm_ = {0.5 * (box[0] + box[3]), 0.5 * (box[1] + box[4]), 0.5 * (box[2] + box[5])};
  const double limit_N =
      vendor_force_N(stated_force(hd_, hd::kNominalMaxForce).value_or(0.0), kUnknownForceLimit_N);
  traits_.max_force_N = options.max_force_N > 0.0 ? std::min(options.max_force_N, limit_N) : limit_N;
  const double stated_N = stated_force(hd_, hd::kNominalMaxContinuousForce).value_or(kNoForce_N);
  traits_.continuous_force_N = continuous_force(
      options.continuous_force_N > 0.0 ? options.continuous_force_N : stated_N, traits_.max_force_N);
  // One tick until the library's thread takes the force, one until its next frame writes it.
  traits_.delay_samples = 2;
  traits_.rate_hz = options.rate_hz;
}

Result<std::unique_ptr<OpenHaptics>> OpenHaptics::open(const HdFunctions& hd,
                                                       const OpenHapticsOptions& options) {
  const unsigned handle = hd.hdInitDevice(options.name.empty() ? nullptr : options.name.c_str());
  if (const HdError error = hd.hdGetError(); handle == hd::kNoHandle || error.code != 0)
    return opening_error(hd,
                         options.name.empty() ? "the default device cannot be opened"
                                              : "there is no device with the name " + options.name,
                         error.code);
  std::unique_ptr<OpenHaptics> device(new OpenHaptics(hd, handle, options));
  hd.hdEnable(hd::kForceOutput);
  device->task_ = hd.hdScheduleAsynchronous(&OpenHaptics::on_call, device.get(), hd::kHighestPriority);
  hd.hdStartScheduler();
  if (const HdError error = hd.hdGetError(); stops_the_loop(error.code))
    return opening_error(hd, "the device's loop does not start", error.code);
  return device;
}

OpenHaptics::~OpenHaptics() {
  stop();
  // The library's thread writes the zero; it is stopped only then, or if it does not run any more.
  forces_.wait_for_zero(kPatience);
  hd_.hdStopScheduler();
  hd_.hdUnschedule(task_);
  hd_.hdMakeCurrentDevice(handle_);
  hd_.hdDisable(hd::kForceOutput);
  hd_.hdDisableDevice(handle_);
}

unsigned OpenHaptics::on_call(void* self) {
  static_cast<OpenHaptics*>(self)->exchange();
  return hd::kCallbackContinue;
}

bool OpenHaptics::is_calibrated() noexcept {
  if (--until_calibration_check_ > 0) return calibrated_;
  until_calibration_check_ = kCalibrationPause;
  const unsigned state = hd_.hdCheckCalibration();
  calibrated_ = state == hd::kCalibrationOk;
  if (state != hd::kCalibrationNeedsUpdate) return calibrated_;
  int styles = 0;
  hd_.hdGetIntegerv(hd::kCalibrationStyles, &styles);
  const auto has = [&](unsigned style) { return (static_cast<unsigned>(styles) & style) != 0; };
  // Resetting the encoders is right only at the reset position, which nobody here knows.
  if (has(hd::kAutomatic) || has(hd::kInkwell))
    hd_.hdUpdateCalibration(has(hd::kAutomatic) ? hd::kAutomatic : hd::kInkwell);
  return calibrated_;
}

void OpenHaptics::exchange() noexcept {
  const LibraryCall call(in_call_since_ns_);
  hd_.hdBeginFrame(handle_);
  State state;
  state.calibrated = is_calibrated();
  std::array<double, 3> position{NAN, NAN, NAN};
  hd_.hdGetDoublev(hd::kPosition, position.data());
  state.position_mm = {position[0], position[1], position[2]};
  int buttons = 0;
  hd_.hdGetIntegerv(hd::kButtons, &buttons);
  state.buttons = static_cast<std::uint32_t>(buttons);

  const auto taken = forces_.take(kCallPeriod_s, state.calibrated);
  const Vec3 force = taken.valid ? taken.command : Vec3{};
  const std::array<double, 3> written{force.x, force.y, force.z};
  hd_.hdSetDoublev(hd::kCurrentForce, written.data());
  hd_.hdEndFrame(handle_);
  forces_.sent(taken);

  if (note_error(hd_.hdGetError().code)) states_.put(state);
}

bool OpenHaptics::note_error(unsigned code) noexcept {
  if (stops_the_loop(code)) {
    error_.store(code, std::memory_order_relaxed);
    return false;
  }
  if (code != 0) {
    force_error_.store(code, std::memory_order_relaxed);
    since_force_error_ = 0;
  } else if (++since_force_error_ == kForceErrorPause) {
    force_error_.store(0, std::memory_order_relaxed);
  }
  return true;
}

Reading OpenHaptics::read() noexcept {
  fresh_.pass();
  if (forces_.notice_taken_back()) fresh_.rest();
  if (states_.take(state_)) {
    const Vec3 position = kMetres * (state_.position_mm - centre_mm_);
    if (is_finite(position) && norm(position) < kFarthestTouch_m)
      fresh_.renew_plausible(position, state_.buttons, state_.calibrated ? Status::ok : Status::not_ready);
  }
  return fresh_.now(false);
}

void OpenHaptics::write(Vector<DeviceFrame> force_N) noexcept { forces_.put(fresh_.allowed(force_N.v)); }

void OpenHaptics::stop() noexcept { forces_.cut(); }

std::string OpenHaptics::fault() const {
  const unsigned code = error_.load(std::memory_order_relaxed);
  if (code == 0) return FreshReading::silence_of(traits_.name);
  return "the " + traits_.name + " failed (" + vendor_text(hd_.hdGetErrorString(code), "no reason given") +
         ")";
}

std::string OpenHaptics::guidance() const {
  if (!calibrated_)
    return "Put the stylus into its well: there is no force until the device has its calibration";
  const unsigned code = force_error_.load(std::memory_order_relaxed);
  if (code == 0) return {};
  if (code == hd::kWarmMotors)
    return "The device says that its motors are warm: press less until they have cooled";
  return "The device limits the force (" + vendor_text(hd_.hdGetErrorString(code), "no reason given") +
         "): press less, and move more slowly";
}

Result<std::vector<std::string>> open_haptics_ports() {
  if (const auto hd = load_hd({}); !hd) return hd.error();
  return std::vector<std::string>{""};
}

Result<std::unique_ptr<Device>> open_open_haptics(DeviceUrl& url, const OpenOptions& options) {
  OpenHapticsOptions wanted;
  wanted.name = url.path();
  wanted.max_force_N = url.take_number("max-force", 0.0, 0.1, 40.0);
  wanted.continuous_force_N = take_continuous_force(url);
  wanted.rate_hz = options.rate_hz;
  const std::string file = url.take_text("library");
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  const auto hd = load_hd(file);
  if (!hd) return hd.error();
  auto device = OpenHaptics::open(*hd, wanted);
  if (!device) return std::move(device).error();
  return std::unique_ptr<Device>(*std::move(device));
}

}  // namespace palpable::device
