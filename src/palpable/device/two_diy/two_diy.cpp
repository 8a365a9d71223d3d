// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/two_diy.hpp"

#include "palpable/device/open_options.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

namespace palpable::device {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr auto kFirstAnswer = std::chrono::seconds(1);
/// So many answers in a row must be those of a board whose handle is near its home, and nothing else may
/// come.
constexpr int kFirstAnswers = 5;
constexpr auto kBeforeTorques = std::chrono::milliseconds(100);

/// The first angles are those at home on a board that takes them from the setup; one that was moved
/// meanwhile, or keeps older ones, is at most a workspace away: both links together.
constexpr double kFarthestFromHome_deg = 120.0;

/// Links turn less than this between two answers that follow each other.
constexpr double kMostTurned_deg = 45.0;

/// Zero torques, and as many zeros again: wherever an interrupted message left the board, it then reads
/// either zero torques or a reset, which frees its motors.
std::array<std::byte, 20> zero_message() noexcept {
  std::array<std::byte, 20> message{};
  std::ranges::copy(torque_message({0.0F, 0.0F}), message.begin());
  return message;
}

/// The force that the motors can hold in every direction everywhere in the workspace, N.
double greatest_force_N(const TwoDiyVariant& variant) {
  constexpr int kGrid = 16;
  double force_N = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kGrid; ++i)
    for (int k = 0; k <= kGrid; ++k) {
      const InPlane place{variant.centre.x + variant.size.x * (static_cast<double>(i) / kGrid - 0.5),
                          variant.centre.y + variant.size.y * (static_cast<double>(k) / kGrid - 0.5)};
      const auto angles = variant.linkage.angles_at(place);
      const auto moved = angles ? variant.linkage.jacobian(*angles) : std::nullopt;
      if (!moved) continue;
      for (const InPlane& lever : *moved)
        force_N = std::min(force_N, kTwoDiyMaxTorque_Nm / std::hypot(lever.x, lever.y));
    }
  return force_N;
}

Traits traits_of(const TwoDiyVariant& variant, double rate_hz, double continuous_force_N) {
  Traits traits;
  traits.name = "Haply 2DIY " + std::string(variant.name);
  traits.degrees_of_freedom = 2;
  // Its plane has no depth; scenes are scaled by width and height only.
  traits.workspace_m = {variant.size.x, variant.size.y, 0.05};
  traits.max_force_N = greatest_force_N(variant);
  traits.continuous_force_N = continuous_force(continuous_force_N, traits.max_force_N);
  // One count of the coarser encoder at the outer end of both links.
  const float counts = std::min(variant.joints[0].counts_per_turn, variant.joints[1].counts_per_turn);
  traits.position_resolution_m = (variant.linkage.inner_m + variant.linkage.outer_m) * 2.0 *
                                 std::numbers::pi / static_cast<double>(counts);
  traits.delay_samples = 1;
  traits.rate_hz = rate_hz;
  return traits;
}

/// Drops what comes until nothing comes any more; false if that does not end before `until`.
bool falls_silent(SerialPort& line, std::chrono::steady_clock::time_point until) {
  constexpr int kSilence_ms = 20;
  while (!line.lost() && std::chrono::steady_clock::now() < until) {
    if (!line.wait_for_input(kSilence_ms)) return true;
    line.drop_input();
  }
  return false;
}

/// Sends zero torques and waits for the angles that answer them, as long as kFirstAnswer. None if anything
/// but one answer comes: a port that sends back what it gets, as many modems do, or that sends all the time.
std::optional<std::array<float, 2>> one_answer(SerialPort& line) {
  // A board answers once, and then waits; bytes that belong to no answer come sooner than this.
  constexpr int kSurplus_ms = 3;
  const auto until = std::chrono::steady_clock::now() + kFirstAnswer;
  line.write(torque_message({0.0F, 0.0F}));
  TwoDiyAnswers answers;
  std::array<std::byte, 64> bytes{};
  for (std::size_t received = 0; !line.lost() && std::chrono::steady_clock::now() < until;) {
    if (!line.wait_for_input(10)) continue;
    const std::size_t count = line.read(bytes);
    received += count;
    const auto angles = answers.take(std::span(bytes).first(count));
    if (received > TwoDiyAnswers::kLength || answers.dropped() > 0) return std::nullopt;
    if (angles) return line.wait_for_input(kSurplus_ms) ? std::nullopt : angles;
  }
  return std::nullopt;
}

double off_by(std::array<float, 2> angles_deg, double first_deg, double second_deg) {
  return std::abs(static_cast<double>(angles_deg[0]) - first_deg) +
         std::abs(static_cast<double>(angles_deg[1]) - second_deg);
}

}  // namespace

TwoDiy::TwoDiy(std::unique_ptr<SerialPort> port, const TwoDiyVariant& variant, const Traits& traits)
    : port_(std::move(port)),
      variant_(variant),
      traits_(traits),
      period_s_(1.0 / traits.rate_hz),
      fresh_(period_s_) {}

Result<std::unique_ptr<TwoDiy>> TwoDiy::open(const std::string& path, const TwoDiyVariant& variant,
                                             double rate_hz, double continuous_force_N) {
  auto port = SerialPort::open(path);
  if (!port) return std::move(port).error();
  std::unique_ptr<TwoDiy> device(
      new TwoDiy(*std::move(port), variant, traits_of(variant, rate_hz, continuous_force_N)));
  SerialPort& line = *device->port_;
  line.write(reset_message());
  line.write(setup_message(variant));
  // What comes now is no answer: a board answers torques only.
  std::this_thread::sleep_for(kBeforeTorques);
  bool answers = falls_silent(line, std::chrono::steady_clock::now() + kFirstAnswer);
  for (int k = 0; answers && k < kFirstAnswers; ++k) {
    const auto angles = one_answer(line);
    answers = angles && (k == 0 ? device->begin(*angles) : device->goes_on(*angles));
  }
  if (answers) return device;
  return Error{ErrorCode::device,
               "does not answer as a 2DIY; check its power, and that ModemManager leaves the port alone",
               path, Reason::device_silent};
}

TwoDiy::~TwoDiy() {
  if (port_->write(zero_message())) return;
  port_->drop_output();
  port_->write(zero_message());
}

bool TwoDiy::begin(std::array<float, 2> first_deg) noexcept {
  // The setup has just set the angles to those at home, so the first answer shows the board's order.
  const auto& [first, second] = variant_.joints;
  const auto home = [](const TwoDiyJoint& joint) { return static_cast<double>(joint.home_deg); };
  const double by_motor = off_by(first_deg, home(first), home(second));
  const double by_port = first.port == 1 ? by_motor : off_by(first_deg, home(second), home(first));
  ordered_by_motor_ = by_motor < by_port;
  if (std::min(by_motor, by_port) > kFarthestFromHome_deg) return false;
  follow(first_deg);
  return has_place_;
}

bool TwoDiy::goes_on(std::array<float, 2> board_deg) noexcept {
  for (std::size_t k = 0; k < 2; ++k)
    if (!(std::abs(board_deg[k] - board_deg_[k]) <= static_cast<float>(kMostTurned_deg))) return false;
  follow(board_deg);
  return has_place_;
}

bool TwoDiy::is_plausible(std::array<float, 2> board_deg) const noexcept {
  // A hand at 3 m/s turns a link by at most this much; what goes beyond it was no answer.
  constexpr double kFastest_deg_per_s = 2500.0;
  constexpr double kLeast_deg = 2.0;
  // However long ago the last answer was: parts of answers that are taken for one often say 0 degrees.
  const double most_deg = std::min(kMostTurned_deg, kLeast_deg + kFastest_deg_per_s * fresh_.age_s());
  const auto turned = [&](std::size_t k) {
    return std::abs(static_cast<double>(board_deg[k]) - static_cast<double>(board_deg_[k]));
  };
  return turned(0) <= most_deg && turned(1) <= most_deg;
}

void TwoDiy::follow(std::array<float, 2> board_deg) noexcept {
  board_deg_ = board_deg;
  const auto rad = [&](std::size_t k) { return kRadians * static_cast<double>(board_deg[k]); };
  angles_ = {rad(is_swapped() ? 1 : 0), rad(is_swapped() ? 0 : 1)};
  const auto handle = variant_.linkage.handle_at(angles_);
  has_place_ = handle.has_value();
  // Without a place the hand counts as where it was.
  fresh_.renew(handle ? Vec3{variant_.centre.x - handle->x, variant_.centre.y - handle->y, 0.0}
                      : fresh_.reading().position.v,
               0, handle ? Status::ok : Status::stale);
}

std::array<float, 2> TwoDiy::in_board_order(std::array<double, 2> by_motor_Nm) const noexcept {
  const auto torque = [&](std::size_t k) { return static_cast<float>(by_motor_Nm[k]); };
  return is_swapped() ? std::array{torque(1), torque(0)} : std::array{torque(0), torque(1)};
}

Reading TwoDiy::read() noexcept {
  const auto now = std::chrono::steady_clock::now();
  // The silence before a late tick is the servo's own, as before the first one: after kPatience_s its
  // watchdog has cut the force.
  const double late_s = std::chrono::duration<double>(now - std::exchange(read_at_, now)).count();
  fresh_.pass(std::min(late_s, kPatience_s));
  std::array<std::byte, 64> bytes{};
  const auto dropped = answers_.dropped();
  const auto angles = answers_.take(std::span(bytes).first(port_->read(bytes)));
  // Among bytes that belong to no answer, some may look like one by chance.
  const bool is_clean = answers_.dropped() == dropped;
  if (angles && is_clean && is_plausible(*angles)) follow(*angles);
  awaited_ -= std::min(awaited_, answers_.complete() - answered_);
  answered_ = answers_.complete();
  return fresh_.now(port_->lost());
}

void TwoDiy::write(Vector<DeviceFrame> force_N) noexcept {
  since_sent_s_ += period_s_;
  // Without a place the force has no direction.
  const auto torques = fresh_.reading().status == Status::ok
                           ? variant_.linkage.torques(angles_, {-force_N.v.x, -force_N.v.y})
                           : std::nullopt;
  std::array<double, 2> sent = torques.value_or(std::array{0.0, 0.0});
  const bool zero = sent[0] == 0.0 && sent[1] == 0.0;
  const bool releases = zero && !sent_zero_;
  if (awaited_ > 0 && !releases && since_sent_s_ < kPatience_s) return;
  // Both are reduced by the same factor, so that the force keeps its direction.
  const double most = std::max(std::abs(sent[0]), std::abs(sent[1]));
  const double gain = variant_.torque_gain * (most > kTwoDiyMaxTorque_Nm ? kTwoDiyMaxTorque_Nm / most : 1.0);
  for (double& torque : sent) torque *= gain;
  if (awaited_ > 0 && since_sent_s_ >= kPatience_s) {
    // What comes of older answers now is not the answer to this message.
    port_->drop_input();
    answers_.reset();
  }
  if (!port_->write(torque_message(in_board_order(sent)))) return;
  awaited_ = since_sent_s_ < kPatience_s ? awaited_ + 1 : 1;
  since_sent_s_ = 0.0;
  sent_zero_ = zero;
}

void TwoDiy::stop() noexcept {
  if (port_->write(torque_message({0.0F, 0.0F}))) return;
  port_->drop_output();
  port_->write(zero_message());
}

std::string TwoDiy::fault() const {
  if (port_->lost()) return "the 2DIY was unplugged";
  return FreshReading::silence_of("2DIY");
}

std::optional<ZeroWrite> TwoDiy::zero_write() const {
  // Twice, in case that the program was killed within a message. No reset: the servo may only stand still.
  const auto zero = torque_message({0.0F, 0.0F});
  ZeroWrite out{port_->descriptor(), {zero.begin(), zero.end()}};
  out.bytes.insert(out.bytes.end(), zero.begin(), zero.end());
  return out;
}

std::vector<std::string> two_diy_ports() {
  std::vector<std::string> ports;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", none))
    if (entry.path().filename().string().starts_with("ttyACM")) ports.push_back(entry.path().string());
  std::ranges::sort(ports);
  return ports;
}

namespace {

bool says_two_diy(const std::string& port) {
  const auto identity = usb_identity(port);
  return identity && is_surely_two_diy(*identity);
}

}  // namespace

bool is_surely_two_diy(const UsbIdentity& identity) {
  std::string words = identity.maker + " " + identity.product;
  std::ranges::transform(words, words.begin(), [](unsigned char c) { return std::tolower(c); });
  return words.find("haply") != std::string::npos;
}

Result<std::unique_ptr<Device>> open_two_diy(DeviceUrl& url, const OpenOptions& options) {
  std::vector<std::string> names;
  for (const auto& variant : kTwoDiyVariants) names.emplace_back(variant.name);
  const std::string name = url.take_word("variant", names);
  const double continuous_force_N = take_continuous_force(url);
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  std::string path = url.path();
  if (path.empty()) {
    auto ports = two_diy_ports();
    // One that says what it is comes before the others.
    std::stable_partition(ports.begin(), ports.end(), says_two_diy);
    const bool is_one = ports.size() > 1 && says_two_diy(ports[0]) && !says_two_diy(ports[1]);
    if (is_one) ports.resize(1);
    if (ports.empty())
      return Error{ErrorCode::device, "no 2DIY is plugged in: there is no /dev/ttyACM port", "2diy"};
    if (ports.size() > 1)
      return Error{ErrorCode::device,
                   "there are " + std::to_string(ports.size()) + " ports: name one, such as 2diy:" + ports[0],
                   "2diy"};
    path = ports[0];
  }
  const auto variant = std::ranges::find(kTwoDiyVariants, name, &TwoDiyVariant::name);
  auto device = TwoDiy::open(path, *variant, options.rate_hz, continuous_force_N);
  if (!device) return std::move(device).error();
  return std::unique_ptr<Device>(*std::move(device));
}

}  // namespace palpable::device
