// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/touch/open_browser.hpp"
#include "palpable/cli/commands/touch/touch_plan.hpp"
#include "palpable/cli/input_files.hpp"
#include "palpable/core/files/build_id.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/haptics/safety/zero_force.hpp"
#include "palpable/haptics/servo/signal_thread.hpp"
#include "palpable/page/server.hpp"
#include "palpable/page/shelf/shelf.hpp"
#include "palpable/page/touch_host.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct HomeArguments {
  std::string device;
  int port = 0;
  bool no_browser = false;
};

/// The session of a touch with the page's view of it, which ends first.
struct HomeTouch {
  std::unique_ptr<session::TouchSession> session;
  page::TouchHost host;
};

page::shelf::BeginTouch begin_touch(const HomeArguments& arguments, const CommonOptions& common) {
  return [arguments,
          common](const page::shelf::TouchRequest& request) -> Result<std::shared_ptr<page::PageHost>> {
    session::SessionOptions options;
    options.seed = common.seed;
    options.made_by = std::string("palpable ") + PALPABLE_VERSION + " (build " + build_id() + ")";
    options.command = common.command;
    options.work = {static_cast<unsigned>(common.threads), common.seed, {}, &interrupted()};
    options.further_probes = haptics::kMaxLiveProbes - 1;
    session::TouchSettings settings;
    auto opened = session::TouchSession::open(
        request.scene, settings, arguments.device.empty() ? "pointer:" : arguments.device, options);
    if (!opened) return opened.error();
    page::TouchHost::Options host;
    host.program = std::string("palpable ") + PALPABLE_VERSION;
    host.name = request.name;
    host.take_better_scene = request.take_better_scene;
    host.better_follows = request.better_follows;
    host.keep = request.keep;
    host.notes = request.notes;
    host.save_as = free_scene_file(page::shelf::safe_file_name(request.name));
    host.home = true;
    session::TouchSession& session = **opened;
    auto touch = std::shared_ptr<HomeTouch>(new HomeTouch{*std::move(opened), {session, std::move(host)}});
    return std::shared_ptr<page::PageHost>(touch, &touch->host);
  };
}

page::shelf::Sample sample(std::string name, page::shelf::SceneCard card) {
  const std::string input = std::string(kSamplePrefix) + name;
  return {name, std::move(card), "/samples/" + name + ".png", {{"make", input}, {}}};
}

std::vector<page::shelf::Sample> samples() {
  std::vector<page::shelf::Sample> all{
      sample("sculptures",
             {"Sculptures on a table", "a relief",
              "Eight small objects, made from a pair of photographs: a head, a ball, a bowl, a ring."}),
      sample("drawing", {"A sailing boat", "a drawing's lines",
                         "A line drawing whose lines are grooves that lead the finger along."}),
      sample("church",
             {"A church", "a solid", "A small church with tower, nave and apse, to be touched all round."}),
      sample("map",
             {"Oldbridge", "a street map",
              "Streets, a roundabout and steps of a town that does not exist; their names are spoken."})};
  auto& pair = all.front().make;
  pair.quick_words = pair.words;
  pair.quick_words.emplace_back("--method=fast");
  return all;
}

Result<Answer> serve_home(const HomeArguments& arguments, Console& console) {
  page::shelf::ShelfOptions options;
  options.samples = samples();
  const std::filesystem::path state_folder = page::shelf::user_state_folder();
  options.state_folder = state_folder;
  options.begin_touch = begin_touch(arguments, console.options());
  auto shelf = page::shelf::Shelf::open(std::move(options));
  if (!shelf) return shelf.error();
  if (!(*shelf)->keeps_scenes())
    console.say(
        fmt::format("Scenes that you open are kept only until this ends: the folder {} cannot be used.",
                    state_folder.empty() ? "~/.local/state" : state_folder.string()));
  std::optional<OpenedBrowser> browser;
  page::ServeOptions serving;
  serving.port = static_cast<std::uint16_t>(arguments.port);
  serving.on_ready = [&](const std::string& address) {
    console.say(fmt::format(
        "Open pictures and scenes at {}\nThe address lets one browser in, once; its further tabs need only "
        "what stands before the #. End with Ctrl-C.",
        address));
    if (!arguments.no_browser) browser.emplace(address);
  };
  if (auto served = page::serve_shelf(**shelf, serving, interrupted()); !served) return served.error();
  Answer answer;
  answer.exit_code = interrupted() ? static_cast<int>(ErrorCode::interrupted) : 0;
  return answer;
}

Result<Answer> home(const HomeArguments& arguments, Console& console) {
  haptics::write_zero_force_on_crash();
  if (!arguments.device.empty())
    if (auto known = device::check_device_url(arguments.device); !known) return known.error();
  std::optional<Result<Answer>> answer;
  haptics::run_beside_signals(haptics::ServoOptions{}.realtime_priority - 1,
                              [&] { answer.emplace(serve_home(arguments, console)); });
  return *std::move(answer);
}

}  // namespace

Action home_action() {
  return [](Console& console) { return home({}, console); };
}

void add_home(Program& program) {
  const auto arguments = std::make_shared<HomeArguments>();
  Options options =
      add_command(program, "home",
                  "Open the home page in the browser: samples, scenes opened lately, and your own pictures",
                  "  palpable\n"
                  "  palpable home --device falcon:",
                  [arguments](Console& console) { return home(*arguments, console); });
  options.text("--device", arguments->device,
               "Device (palpable devices lists them); default: the page's pointer");
  options.integer("--port", arguments->port, {0, 65535}, "Port of the page on 127.0.0.1; 0 = any free one");
  options.flag("--no-browser", arguments->no_browser, "Do not open the browser");
}

}  // namespace palpable::cli
