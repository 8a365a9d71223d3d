// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/command.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/drivers/udev_rules.hpp"
#include "palpable/device/url.hpp"
#include "palpable/haptics/servo/hand_measurement.hpp"
#include "palpable/haptics/servo/kept_rate.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"
#include "palpable/haptics/servo/watchdog.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

/// The result of one check. Without a `wanted` property a touch works, but less well.
struct Finding {
  enum class State { good, wanted, missing };
  std::string name;
  State state = State::good;
  std::string found;
  /// What to do about it; empty if nothing is necessary.
  std::string advice;
};

Finding realtime_priority() {
  Finding finding{"realtime-priority", Finding::State::good, {}, {}};
  int outcome = 0;
  // Requested on a separate thread, so that this one keeps its normal priority.
  std::thread([&outcome] {
    sched_param parameters{};
    parameters.sched_priority = 1;
    outcome = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  }).join();
  if (outcome == 0) {
    finding.found = "the servo may run at real-time priority";
    return finding;
  }
  finding.state = Finding::State::wanted;
  finding.found = fmt::format("the servo may not run at real-time priority ({})", std::strerror(outcome));
  finding.advice =
      "add '@audio - rtprio 90' to /etc/security/limits.d/palpable.conf, join the group audio and log in "
      "again";
  return finding;
}

/// Runs an empty loop at the default rate and at the highest rate.
Finding servo_rate() {
  constexpr double kMeasure_s = 0.3;
  Finding finding{"servo-rate", Finding::State::good, {}, {}};
  for (const double rate_hz : {1000.0, 4000.0}) {
    const auto kept = haptics::measure_rate(rate_hz, kMeasure_s, haptics::ServoOptions{}.realtime_priority);
    finding.found += fmt::format("{}an empty loop of {:.0f} Hz missed {:.1f} % of its deadlines",
                                 finding.found.empty() ? "" : ", ", rate_hz, 100.0 * kept.missed_fraction());
    if (haptics::check_kept(kept)) continue;
    finding.state = Finding::State::wanted;
    finding.advice = fmt::format(
        "end other programs that use the processor, or touch with a --rate below {:.0f}", rate_hz);
    break;
  }
  return finding;
}

/// Measures how soon the force of a hanging loop is cut on this machine.
Finding watchdog() {
  constexpr int kHangs = 50;
  constexpr double kPromised_ms = 5.0;
  const double rate_hz = haptics::ServoOptions{}.rate_hz;
  const auto latency = haptics::measure_watchdog(rate_hz, kHangs, haptics::ServoOptions{}.realtime_priority);
  // Relative to the time at which the write was due.
  const double period_ms = 1e3 / rate_hz;
  Finding finding{"watchdog", Finding::State::good, {}, {}};
  finding.found = fmt::format(
      "if the servo hangs, the watchdog cuts the force {:.1f} ms after the overdue write (99 %: {:.1f} ms, "
      "longest of {}: {:.1f} ms)",
      latency.p50_ms - period_ms, latency.p99_ms - period_ms, latency.hangs, latency.max_ms - period_ms);
  if (latency.max_ms - period_ms > kPromised_ms) {
    finding.state = Finding::State::wanted;
    finding.advice = "allow real-time priority, or end other programs that use the processor";
  }
  return finding;
}

Finding locked_memory() {
  constexpr rlim_t kWanted = rlim_t{512} << 20U;
  Finding finding{"locked-memory", Finding::State::good, {}, {}};
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || geteuid() == 0) {
    finding.found = "scenes may be locked in memory without a limit";
    return finding;
  }
  finding.found = fmt::format("{} MB may be locked in memory", limit.rlim_cur >> 20U);
  if (limit.rlim_cur < kWanted) {
    finding.state = Finding::State::wanted;
    finding.advice =
        "add '@audio - memlock 1048576' to /etc/security/limits.d/palpable.conf and log in again";
  }
  return finding;
}

Finding loopback() {
  Finding finding{"loopback", Finding::State::good, "the page can be served on 127.0.0.1", {}};
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool works = listener >= 0 &&
                     bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
                     listen(listener, 1) == 0;
  if (!works) {
    finding.state = Finding::State::missing;
    finding.found = fmt::format("nothing can be served on 127.0.0.1 ({})", std::strerror(errno));
    finding.advice = "let this program open a port on the loopback interface; --headless works without one";
  }
  if (listener >= 0) close(listener);
  return finding;
}

Finding processors() {
  const unsigned count = std::thread::hardware_concurrency();
  Finding finding{"processors", Finding::State::good, fmt::format("{} processors", count), {}};
  if (count < 2) {
    finding.state = Finding::State::wanted;
    finding.advice = "with a single processor the page and the servo disturb each other; use two or more";
  }
  return finding;
}

/// Normal users can open USB devices only if udev rules allow it.
Finding device_rules() {
  Finding finding{"device-rules", Finding::State::good, {}, {}};
  for (const char* folder : {"/etc/udev/rules.d", "/usr/lib/udev/rules.d", "/lib/udev/rules.d"}) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      if (entry.path().filename().string().find("palpable") == std::string::npos) continue;
      const std::string file = entry.path().string();
      std::ifstream stream(file);
      const std::string rules{std::istreambuf_iterator<char>(stream), {}};
      finding.found = fmt::format("device rules are installed: {}", file);
      if (rules.find(device::kRules) != std::string::npos) return finding;
      finding.found = fmt::format("the device rules in {} are not those of this version", file);
    }
  }
  finding.state = Finding::State::wanted;
  if (finding.found.empty())
    finding.found = "no device rules are installed; the pointer and the simulated hand need none";
  finding.advice = fmt::format(
      "for a device on a serial port or USB (2diy:, falcon:, forcedimension:, touch:), write the rules that "
      "palpable doctor --rules prints to {}, and plug the device in again",
      device::kRulesFile);
  return finding;
}

/// ModemManager sends its own commands to new serial ports, which a device may take for its own.
Finding modem_manager() {
  Finding finding{"modem-manager", Finding::State::good, "ModemManager does not run", {}};
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    if (name != "ModemManager") continue;
    finding.state = Finding::State::wanted;
    finding.found = "ModemManager runs; it disturbs devices on serial ports when they are plugged in";
    finding.advice = fmt::format(
        "write the rules that palpable doctor --rules prints to {}, or stop it: systemctl stop ModemManager",
        device::kRulesFile);
  }
  return finding;
}

/// What can be touched with here, and why the other kinds of devices cannot: a library or a service that is
/// missing, permissions, or that none is plugged in.
Finding found_devices() {
  Finding finding{"devices", Finding::State::good, {}, {}};
  std::string missing;
  for (const device::DeviceKind& kind : device::list_devices()) {
    if (kind.available) {
      finding.found += (finding.found.empty() ? "available: " : ", ") + kind.url;
      if (kind.may_be) finding.found += " (" + kind.note + ")";
      continue;
    }
    missing += fmt::format("{}{} ({})", missing.empty() ? "" : "; ", kind.url, kind.note);
    finding.advice += fmt::format("{}for {} {}", finding.advice.empty() ? "" : "; ", kind.url, kind.advice);
  }
  if (!missing.empty()) finding.found += "; not available: " + missing;
  return finding;
}

std::string_view name_of(Finding::State state) {
  switch (state) {
    case Finding::State::good:
      return "good";
    case Finding::State::wanted:
      return "wanted";
    case Finding::State::missing:
      return "missing";
  }
  return "missing";
}

/// Whether what moves a device can be measured by pushing it.
Result<void> check_held(const std::string& device_url) {
  auto url = device::DeviceUrl::parse(device_url);
  if (!url) return std::move(url).error();
  if (url->scheme() == "replay")
    return Error{ErrorCode::usage,
                 "a recording does not move when it is pushed: name a device that a hand holds", device_url};
  if (url->scheme() == "remote")
    return Error{ErrorCode::usage,
                 "no forces are sent to a device at another computer: measure the hand there", "remote:"};
  if (url->scheme() == "sim" && url->take_text("script") != "hold")
    return Error{ErrorCode::usage,
                 "this simulated hand explores, and would be measured while it moves: add script=hold",
                 device_url};
  return {};
}

/// Measures the hand that holds a device, for --hand-damping.
Result<Answer> examine_hand(const std::string& device_url, Console& console) {
  const bool is_simulated = device::is_virtual_device(device_url);
  if (auto held = check_held(device_url); !held) return std::move(held).error();
  device::OpenOptions open;
  open.seed = console.options().seed;
  auto device = device::open_device(device_url, open);
  if (!device) return std::move(device).error();
  const haptics::PulseOptions pulses;
  if (is_simulated)
    console.note("This hand is simulated: the figures check the measurement, and say nothing of a person's.");
  else
    console.note(fmt::format(
        "Hold the device in the middle of its workspace, as you do when you touch, and do not move: it will "
        "push {} times, in {:.0f} s.",
        pulses.pulses, pulses.duration_s()));
  const std::string name = (*device)->traits().name;
  const auto hand = haptics::measure_hand(std::move(*device), pulses);
  if (!hand) return hand.error();
  Answer answer;
  answer.json = {{"device", name},
                 {"simulated", is_simulated},
                 {"pulses", hand->pulses},
                 {"hand_damping_Ns_per_m",
                  {{"least", hand->least_damping_Ns_per_m},
                   {"median", hand->median_damping_Ns_per_m},
                   {"greatest", hand->greatest_damping_Ns_per_m}}},
                 {"device_and_hand",
                  {{"mass_kg", hand->together.mass_kg},
                   {"damping_Ns_per_m", hand->together.damping_Ns_per_m},
                   {"stiffness_N_per_m", hand->together.stiffness_N_per_m}}}};
  answer.text = fmt::format(
      "The {}hand adds {:.1f} N·s/m of damping ({:.1f} to {:.1f} in {} pulses) to {}; together they have "
      "{:.2f} kg and {:.0f} N/m.\n",
      is_simulated ? "simulated " : "", hand->median_damping_Ns_per_m, hand->least_damping_Ns_per_m,
      hand->greatest_damping_Ns_per_m, hand->pulses, name, hand->together.mass_kg,
      hand->together.stiffness_N_per_m);
  constexpr double kSmallest = 0.1;
  if (!is_simulated && hand->least_damping_Ns_per_m > kSmallest)
    answer.text +=
        fmt::format("A hand sometimes holds a device more loosely: use --hand-damping {:.1f} or less.\n",
                    hand->least_damping_Ns_per_m);
  return answer;
}

struct DoctorArguments {
  std::string hand_on_device;
  bool rules = false;
};

Result<Answer> examine(const DoctorArguments& arguments, Console& console) {
  if (!arguments.hand_on_device.empty()) return examine_hand(arguments.hand_on_device, console);
  if (arguments.rules) {
    Answer answer;
    answer.json = {{"rules", device::kRules}, {"file", device::kRulesFile}};
    answer.text = device::kRules;
    return answer;
  }
  Answer answer;
  answer.json["version"] = PALPABLE_VERSION;
  answer.json["findings"] = Json::array();
  bool ready = true;
  for (const Finding& finding : {processors(), realtime_priority(), servo_rate(), watchdog(), locked_memory(),
                                 loopback(), device_rules(), modem_manager(), found_devices()}) {
    answer.json["findings"].push_back({{"name", finding.name},
                                       {"state", name_of(finding.state)},
                                       {"found", finding.found},
                                       {"advice", finding.advice}});
    answer.text += fmt::format("{:8}{}: {}\n", name_of(finding.state), finding.name, finding.found);
    if (!finding.advice.empty()) answer.text += fmt::format("        To do: {}.\n", finding.advice);
    ready = ready && finding.state != Finding::State::missing;
  }
  answer.json["ready"] = ready;
  answer.text += ready ? "Ready to touch.\n" : "Not ready: see what is missing above.\n";
  answer.exit_code = ready ? 0 : static_cast<int>(ErrorCode::failed);
  return answer;
}

}  // namespace

void add_doctor(Program& program) {
  const auto arguments = std::make_shared<DoctorArguments>();
  Options options =
      add_command(program, "doctor", "Check how well this machine can render a touch, with advice",
                  "  palpable doctor\n"
                  "  palpable doctor --rules | sudo tee /etc/udev/rules.d/60-palpable.rules\n"
                  "  palpable doctor --measure-hand sim:?script=hold",
                  [arguments](Console& console) { return examine(*arguments, console); });
  options.flag("--rules", arguments->rules,
               "Instead, print the system's rules that let the logged-in user open devices");
  options.text("--measure-hand", arguments->hand_on_device,
               "Instead, measure the damping that the hand adds to this device (8 s)");
}

}  // namespace palpable::cli
