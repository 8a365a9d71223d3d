// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/touch_page.hpp"

#include "palpable/cli/commands/touch/open_browser.hpp"
#include "palpable/cli/commands/touch/touch_robot.hpp"
#include "palpable/page/server.hpp"
#include "palpable/page/share/local_network.hpp"
#include "palpable/page/share/sharing.hpp"
#include "palpable/page/touch_host.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Keeps notes until a page can show them. Any thread.
class NoteBox {
 public:
  void put(const Note& note) {
    const std::lock_guard lock(mutex_);
    if (receiver_) {
      receiver_(note);
    } else {
      kept_.push_back(note);
    }
  }
  /// Passes the kept notes and all later ones to `receiver`; an empty one keeps them again.
  void open(Notes receiver) {
    const std::lock_guard lock(mutex_);
    receiver_ = std::move(receiver);
    if (!receiver_) return;
    for (const Note& note : std::exchange(kept_, {})) receiver_(note);
  }

 private:
  std::mutex mutex_;
  Notes receiver_;
  std::vector<Note> kept_;
};

/// Without the brackets that it has in a link.
Result<std::string> shared_address(const std::string& text) {
  const auto address = page::ip_address(text);
  if (!address) return Error{ErrorCode::usage, "\"" + text + "\" is not an IP address", "--share-address"};
  if (page::is_link_local(*address))
    return Error{ErrorCode::usage, "browsers cannot be sent to a link-local address (fe80::)",
                 "--share-address"};
  return address->to_string();
}

/// Null if the touch is not shared.
Result<std::unique_ptr<page::Sharing>> open_sharing(const TouchArguments& arguments, Console& console) {
  if (!arguments.share) return std::unique_ptr<page::Sharing>();
  page::Sharing::Options options;
  if (!arguments.share_address.empty()) {
    auto address = shared_address(arguments.share_address);
    if (!address) return std::move(address).error();
    options.addresses = {*std::move(address)};
  }
  options.port = static_cast<std::uint16_t>(arguments.share_port);
  options.on_link = [&console](const page::protocol::Invitation& link, const std::string& code) {
    console.draw(code);
    console.say(
        fmt::format("Let one phone or tablet {}: {}\nThe link is valid once, for {} minutes; the page makes "
                    "further ones.",
                    link.role, link.link, link.minutes));
    if (link.other_link) console.say(fmt::format("In a network without IPv4: {}", *link.other_link));
  };
  options.on_news = [&console](const std::string& sentence) { console.say(sentence); };
  auto sharing = page::Sharing::open(std::move(options));
  if (sharing)
    console.say(fmt::format(
        "Phones warn that the certificate is not known, since it was made for this touch. Its SHA-256 "
        "fingerprint must be\n{}",
        (*sharing)->certificate().fingerprint));
  return sharing;
}

/// Serves the page of a running touch until the user ends it.
Result<void> serve_page(const TouchArguments& arguments, const TouchPlan& plan,
                        session::TouchSession& session, session::MakerThread& maker, NoteBox& notes,
                        page::ShareHost* share, Console& console) {
  page::TouchHost::Options shown;
  shown.program = std::string("palpable ") + PALPABLE_VERSION;
  shown.take_better_scene = [&maker] { return maker.take(std::chrono::milliseconds(0)); };
  shown.better_follows = plan.live == nullptr && !maker.outcome();
  shown.save_as = save_path(plan);
  shown.egocentric = !plan.walk.empty();
  shown.live = plan.live != nullptr;
  shown.robot = plan.live ? plan.live->robot() : nullptr;
  shown.head = plan.head.get();
  page::TouchHost host(session, std::move(shown));
  notes.open([&host](const Note& note) { host.say("info", note.sentence); });
  std::optional<OpenedBrowser> browser;
  page::ServeOptions options;
  options.port = static_cast<std::uint16_t>(arguments.port);
  options.share = share;
  options.on_ready = [&](const std::string& address) {
    console.say(fmt::format(
        "Touch the scene at {}\nThe address lets one browser in, once; its further tabs need only "
        "what stands before the #. End with Ctrl-C.",
        address));
    if (!arguments.no_browser) browser.emplace(address);
  };
  auto served = page::serve(host, options, interrupted());
  notes.open({});
  return served;
}

}  // namespace

Result<Answer> touch_with_page(const TouchArguments& arguments, const TouchPlan& plan, Console& console) {
  const auto sharing = open_sharing(arguments, console);
  if (!sharing) return sharing.error();
  NoteBox notes;
  session::MakerThread maker(maker_of(plan,
                                      [&](const Note& note) {
                                        console.note(note);
                                        notes.put(note);
                                      }),
                             console.work());
  auto scene = maker.first_scene(console.work());
  if (!scene) return scene.error();
  session::SessionOptions options = plan.options;
  options.further_probes = haptics::kMaxLiveProbes - 1 - options.further_devices.size();
  options.recording = arguments.recording;
  auto opened = session::TouchSession::open(
      std::move(*scene), plan.settings, arguments.devices.empty() ? "pointer:" : arguments.devices.front(),
      options, plan.begin_ns);
  if (!opened) return opened.error();
  session::TouchSession& session = **opened;
  auto feeding = std::make_unique<session::Feeding>(
      plan.live.get(), session, [&](const std::string& sentence, session::LiveSubject subject) {
        console.note(sentence);
        if (subject != session::LiveSubject::robot) notes.put(Note(sentence));
      });
  auto terminal = std::make_unique<RobotTerminal>(plan.live ? plan.live->robot() : nullptr, console);
  const auto served = serve_page(arguments, plan, session, maker, notes, sharing->get(), console);
  terminal.reset();
  feeding.reset();
  const auto recorded = session.stop();
  if (!served) return served.error();
  if (!recorded) return recorded.error();
  auto statistics = session.statistics();
  if (plan.live) statistics.live = plan.live->statistics();
  return answer_of(statistics);
}

}  // namespace palpable::cli
