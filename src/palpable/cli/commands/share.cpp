// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/ask_to_hold.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/safety/zero_force.hpp"
#include "palpable/haptics/servo/signal_thread.hpp"
#include "palpable/page/access.hpp"
#include "palpable/page/share/local_network.hpp"
#include "palpable/session/share/share_device.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ShareArguments {
  std::string device;
  std::string listen = "127.0.0.1";
  int port = 0;
  double hand_damping_Ns_per_m = haptics::kLeastHandDamping_Ns_per_m;
  std::optional<double> seconds;
};

/// The addresses by which other computers reach this one.
std::vector<std::string> addresses_for_others(const std::string& listen) {
  if (listen != "0.0.0.0" && listen != "::") return {listen};
  std::vector<std::string> found;
  const auto addresses = page::addresses_in_network();
  for (const std::string& address : addresses ? *addresses : std::vector<std::string>{})
    if (listen == "::" || address.find(':') == std::string::npos) found.push_back(address);
  return found;
}

/// What is typed at the other computer, by the first address; and the other addresses, and this computer's
/// name, which others may not know.
std::string words_for_others(const std::string& listen, std::uint16_t port, const std::string& token) {
  std::vector<std::string> places = addresses_for_others(listen);
  const bool has_names = listen == "0.0.0.0" || listen == "::";
  if (const std::string name = page::name_of_this_computer(); has_names && !name.empty())
    places.push_back(name);
  if (places.empty()) places.emplace_back("THIS-COMPUTER");
  std::string words;
  for (const std::string& place : places) {
    const std::string url = fmt::format("remote:{}?token={}", page::host_and_port(place, port), token);
    words += words.empty() ? fmt::format("palpable touch SCENE --device '{}'", url) : "\n  or: " + url;
  }
  return words;
}

Result<Answer> share(const ShareArguments& arguments, Console& console) {
  haptics::write_zero_force_on_crash();
  if (auto known = device::check_device_url(arguments.device); !known) return known.error();
  session::ShareOptions options;
  options.device_url = arguments.device;
  options.address = arguments.listen;
  options.port = static_cast<std::uint16_t>(arguments.port);
  options.seed = console.options().seed;
  options.hand_damping_Ns_per_m = arguments.hand_damping_Ns_per_m;
  if (arguments.seconds) options.seconds = *arguments.seconds;
  options.on_address = [&, is_first = true](std::uint16_t port, const std::string& token) mutable {
    if (std::exchange(is_first, false) && arguments.listen == "127.0.0.1")
      console.note(
          "Only programs of this computer can connect. With --listen 0.0.0.0 those of your network can, by "
          "the address that is printed; what they send is not encrypted.");
    console.say(words_for_others(arguments.listen, port, token));
  };
  options.on_news = [&console](const std::string& sentence) { console.note(sentence); };
  std::optional<Result<haptics::ServoStatistics>> ended;
  haptics::run_beside_signals(options.servo.realtime_priority - 1, [&] {
    if (const auto words = device::hold_words(options.device_url); !words.empty())
      ask_to_hold(Speech::off, console)(words);
    ended.emplace(session::share_device(options, console.work()));
  });
  if (!*ended) return ended->error();
  const haptics::ServoStatistics& servo = **ended;
  Answer answer;
  answer.json = {{"ticks", servo.touch.ticks},
                 {"rate_hz", servo.rate_hz},
                 {"missed", servo.missed},
                 {"contact_ticks", servo.touch.contact_ticks},
                 {"max_force_N", servo.touch.max_force_N},
                 {"made_max_J", servo.touch.made_max_J},
                 {"allocations_in_ticks", servo.allocations_in_ticks}};
  answer.text = fmt::format("Shared for {} ticks, {} of them in contact; greatest force {:.2f} N.\n",
                            servo.touch.ticks, servo.touch.contact_ticks, servo.touch.max_force_N);
  // Ctrl-C is the usual end: what was measured is still said.
  answer.exit_code = interrupted() ? static_cast<int>(ErrorCode::interrupted) : 0;
  return answer;
}

}  // namespace

void add_share(Program& program) {
  const auto arguments = std::make_shared<ShareArguments>();
  Options options = add_command(
      program, "share", "Let another computer touch with the device of this one",
      "  palpable share 2diy:\n"
      "  palpable share falcon: --listen 0.0.0.0 --port 7425\n"
      "It prints what to type at the computer with the scene: palpable touch SCENE --device 'remote:…'. The "
      "address is good for one touch; after it the next one is printed. Ctrl-C ends the sharing.",
      [arguments](Console& console) { return share(*arguments, console); });
  options.argument("DEVICE", arguments->device, "The device to share (palpable devices lists them)");
  options.text("--listen", arguments->listen,
               "Address of this computer at which to listen, in numbers; 0.0.0.0 = all; default: 127.0.0.1");
  options.integer("--port", arguments->port, {0, 65535}, "Port to listen at; 0 = any free one");
  options.number("--hand-damping", arguments->hand_damping_Ns_per_m, {0.1, 40.0},
                 "Least damping that the hand adds to the device, N·s/m; the stiffness limit depends on it");
  options.number("--seconds", arguments->seconds, {0.1, 86400.0}, "End after this time");
}

}  // namespace palpable::cli
