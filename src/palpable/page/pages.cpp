// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/pages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace palpable::page {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Enough for the page's mesh and sound; the state carries the exact height.
constexpr int kLongestHeightSide = 320;
constexpr int kLongestPictureSide = 1024;
constexpr auto kRestPeriod = std::chrono::seconds(1);

template <class Message>
SharedFrame text_frame(const Message& message) {
  return std::make_shared<const Frame>(Frame{protocol::write_message(message), false});
}

// Whether two states are equal for a user: within a micrometre and two millinewtons.
bool nearly_equal(const protocol::ProbeState& a, const protocol::ProbeState& b) {
  const auto near = [](double p, double q, double limit) { return std::abs(p - q) < limit; };
  return a.probe == b.probe && a.page == b.page && a.contact == b.contact && a.label == b.label &&
         near(a.x_m, b.x_m, 1e-6) && near(a.y_m, b.y_m, 1e-6) && near(a.z_m, b.z_m, 1e-6) &&
         near(a.surface_m, b.surface_m, 1e-6) && near(a.fx_N, b.fx_N, 2e-3) && near(a.fy_N, b.fy_N, 2e-3) &&
         near(a.fz_N, b.fz_N, 2e-3);
}

}  // namespace

std::string Pages::full_sentence() const {
  return "This session is open in " + std::to_string(options_.most_clients) +
         " pages already, which is the limit: close one of them.";
}

void Pages::add_client(boost::beast::tcp_stream stream, const Client::Upgrade& upgrade) {
  Client::Events events;
  events.opened = [this](Client& client) {
    send_everything(client);
    note_activity();
  };
  events.message = [this](Client& client, const protocol::FromPage& message) {
    std::visit([&](const auto& m) { handle(client, m); }, message);
    note_activity();
  };
  events.closed = [this](Client& client) {
    release_probes(client);
    std::erase_if(clients_,
                  [&](const auto& other) { return other.expired() || other.lock().get() == &client; });
  };
  auto client = std::make_shared<Client>(std::move(stream), options_, std::move(events));
  client->page = next_page_++;
  clients_.push_back(client);
  client->accept(upgrade);
}

void Pages::update() {
  while (const auto notice = host_.next_notice()) broadcast(text_frame(*notice));
  if (clients_.empty()) return;
  host_.update();
  if (const auto scene = host_.scene(); scene != shown_) {
    show(scene);
    broadcast(text_frame(host_.laws()));
    for (const auto& frame : scene_frames_) broadcast(frame);
  }
  if (const auto settings = host_.settings(); settings != sent_settings_) {
    sent_settings_ = settings;
    broadcast(text_frame(settings));
  }
  if (auto materials = host_.materials(); materials != sent_materials_) {
    sent_materials_ = std::move(materials);
    broadcast(text_frame(sent_materials_));
  }
  send_state();
}

bool Pages::is_at_rest() const { return steady_clock::now() - active_at_ >= kRestPeriod; }

void Pages::close_all() {
  for_each_client([](Client& client) {
    client.close(boost::beast::websocket::close_code::going_away, "the session has ended");
  });
}

void Pages::note_activity() {
  active_at_ = steady_clock::now();
  on_activity_();
}

// Once per second at rest; otherwise each time, to the pages that keep up.
void Pages::send_state() {
  protocol::State state = host_.state();
  for (auto& probe : state.probes) probe.page = movers_.at(static_cast<std::size_t>(probe.probe));
  const auto now = steady_clock::now();
  const bool moved = !std::equal(state.probes.begin(), state.probes.end(), sent_probes_.begin(),
                                 sent_probes_.end(), nearly_equal);
  if (moved) active_at_ = now;
  const bool is_due = moved || now - sent_state_at_ >= kRestPeriod;
  SharedFrame frame;
  for_each_client([&](Client& client) {
    if (!client.visible || !(is_due || client.is_behind)) return;
    if (frame == nullptr) frame = text_frame(state);
    client.is_behind = !client.send_if_idle(frame);
  });
  if (!is_due) return;
  sent_probes_ = std::move(state.probes);
  sent_state_at_ = now;
}

// Removes the additional probes that this page moved; the first probe stays.
void Pages::release_probes(const Client& client) {
  for (std::size_t probe = 1; probe < client.moved.size(); ++probe)
    if (client.moved.test(probe)) host_.lift({static_cast<std::int64_t>(probe)});
  for (auto& mover : movers_)
    if (mover == client.page) mover.reset();
}

void Pages::send_everything(Client& client) {
  auto hello = host_.hello();
  hello.page = client.page;
  client.send(text_frame(hello));
  client.send(text_frame(host_.laws()));
  if (const auto scene = host_.scene(); scene != shown_) show(scene);
  for (const auto& frame : scene_frames_) client.send(frame);
  sent_settings_ = host_.settings();
  client.send(text_frame(sent_settings_));
  sent_materials_ = host_.materials();
  client.send(text_frame(sent_materials_));
}

void Pages::show(const std::shared_ptr<const PageScene>& scene) {
  shown_ = scene;
  const auto number = static_cast<std::uint32_t>(scene->about.scene);
  const auto binary = [](std::string bytes) {
    return std::make_shared<const Frame>(Frame{std::move(bytes), true});
  };
  scene_frames_ = {
      text_frame(scene->about),
      binary(protocol::write_heights(number, protocol::thinned(scene->height_m, kLongestHeightSide)))};
  const auto push = [&](protocol::RasterKind kind, const Raster<Rgb8>& picture) {
    scene_frames_.push_back(
        binary(protocol::write_picture(kind, number, protocol::thinned(picture, kLongestPictureSide))));
  };
  if (scene->about.has_picture) push(protocol::RasterKind::picture, scene->picture);
  if (scene->about.cells) push(protocol::RasterKind::cells, scene->cells);
}

// Iterates over a copy, since a disconnected client is removed from the list.
template <class Do>
void Pages::for_each_client(Do act) {
  const auto clients = clients_;
  for (const auto& weak : clients)
    if (const auto client = weak.lock()) act(*client);
}

void Pages::broadcast(const SharedFrame& frame) {
  for_each_client([&](Client& client) { client.send(frame); });
}

void Pages::handle(Client& client, const protocol::Pointer& pointer) {
  const auto probe = static_cast<std::size_t>(pointer.probe);
  client.moved.set(probe);
  if (probe > 0 || host_.hello().pointer_moves) movers_.at(probe) = client.page;
  host_.move(pointer);
}

void Pages::handle(Client& client, const protocol::Lift& probe) {
  client.moved.reset(static_cast<std::size_t>(probe.probe));
  movers_.at(static_cast<std::size_t>(probe.probe)).reset();
  host_.lift(probe);
}

void Pages::handle(Client& client, const protocol::Ask& ask) {
  client.send(text_frame(protocol::Words{ask.serial, host_.answer(ask)}));
}

void Pages::handle(Client& client, const protocol::Visible& visible) {
  client.visible = visible.visible;
  client.is_behind = true;
}

}  // namespace palpable::page
