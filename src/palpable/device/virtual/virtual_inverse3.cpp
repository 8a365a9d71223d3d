// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/virtual/virtual_inverse3.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>
#include <sys/socket.h>

namespace palpable::device {
namespace {

using boost::asio::ip::tcp;
using nlohmann::json;
namespace beast = boost::beast;

constexpr double kStep_s = 0.00025;
constexpr auto kLook = std::chrono::microseconds(100);
constexpr Vec3 kRest_m{0.01, -0.12, 0.18};

json as_json(Vec3 v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

}  // namespace

class VirtualInverse3::Server {
 public:
  explicit Server(const Options& options)
      : options_(options), acceptor_(context_, {boost::asio::ip::address_v4::loopback(), 0}) {
    handle_.position_m = handle_.goal_m = kRest_m;
    calibrated_ = options.calibrated;
    fault_ = options.at_first;
    thread_ = std::thread([this] { run(); });
  }
  ~Server() {
    ends_ = true;
    // Wakes accept() and read().
    ::shutdown(acceptor_.native_handle(), SHUT_RDWR);
    if (const int socket = socket_; socket >= 0) ::shutdown(socket, SHUT_RDWR);
    thread_.join();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  mutable std::mutex mutex_;
  MovedHandle handle_;
  Vec3 force_N_;
  bool calibrated_ = true;
  Fault fault_ = Fault::none;
  std::uint64_t messages_ = 0;
  std::uint64_t strange_ = 0;
  Vec3 stuck_at_m_ = kRest_m;
  std::string first_message_;

 private:
  void run() {
    while (!ends_) {
      beast::error_code error;
      tcp::socket accepted(context_);
      acceptor_.accept(accepted, error);
      if (error) return;
      socket_ = accepted.native_handle();
      serve(beast::websocket::stream<tcp::socket>(std::move(accepted)));
      // The last force stays: nothing is known of what the real service does.
      socket_ = -1;
    }
  }

  void serve(beast::websocket::stream<tcp::socket> link) {
    beast::error_code error;
    link.accept(error);
    link.text(true);
    if (error) return;
    const std::string first = options_.at_first == Fault::none ? state(true).dump() : answer_now();
    if (first == "closed") return;
    if (!first.empty()) link.write(boost::asio::buffer(first), error);
    beast::flat_buffer buffer;
    while (!ends_ && !error) {
      while (!ends_ && fault_now() == Fault::stalled) std::this_thread::sleep_for(kLook);
      link.read(buffer, error);
      if (error) return;
      take(beast::buffers_to_string(buffer.data()));
      buffer.consume(buffer.size());
      std::this_thread::sleep_for(std::chrono::duration<double>(kStep_s));
      const std::string answer = answer_now();
      if (answer == "closed") return;
      if (!answer.empty()) link.write(boost::asio::buffer(answer), error);
    }
  }

  Fault fault_now() const {
    const std::scoped_lock lock(mutex_);
    return fault_;
  }

  void take(const std::string& text) {
    const json message = json::parse(text, nullptr, false);
    const std::scoped_lock lock(mutex_);
    if (!message.is_object()) {
      ++strange_;
      return;
    }
    if (messages_++ == 0) first_message_ = text;
    const char* wanted = options_.takes_values ? "values" : "vector";
    const json none;
    const json& command = message.value("/inverse3/0/commands/set_cursor_force"_json_pointer, json::object());
    if (message.value("/inverse3/0/device_id"_json_pointer, "") == "0417" && command.contains(wanted)) {
      const json& v = command[wanted];
      const auto number = [&](const char* axis) { return v[axis].is_number() ? v[axis].get<double>() : NAN; };
      force_N_ = {number("x"), number("y"), number("z")};
      if (!is_finite(force_N_)) ++strange_;
      if (options_.on_force) options_.on_force(force_N_);
    }
    handle_.move(force_N_, kStep_s);
  }

  json state(bool with_config) const {
    const std::scoped_lock lock(mutex_);
    json device;
    device["device_id"] = "0417";
    if (with_config)
      device["config"] = {{"gravity_compensation", {{"enabled", true}, {"scaling", 1.0}}},
                          {"torque_scaling", {{"enabled", false}}}};
    Vec3 place = fault_ == Fault::stuck ? stuck_at_m_ : handle_.measured_m();
    if (fault_ == Fault::far_away) place.x += 4.0;
    device["state"] = {{"cursor_position", as_json(place)}, {"current_cursor_force", as_json(force_N_)}};
    device["status"] = {{"calibrated", calibrated_}, {"ready", true}};
    json message;
    message["session_id"] = 3;
    message["inverse3"] = json::array();
    if (options_.lists_a_device && fault_ != Fault::no_device) message["inverse3"].push_back(device);
    return message;
  }

  std::string answer_now() {
    switch (fault_now()) {
      case Fault::silent:
        return "";
      case Fault::short_packets: {
        const std::string whole = state(false).dump();
        return whole.substr(0, whole.size() / 2);
      }
      case Fault::dropped:
        if (messages_ % 2 == 0) return "";
        break;
      case Fault::reordered:
        if (messages_ % 2 == 0) return older_state_;
        return std::exchange(older_state_, state(false).dump());
      case Fault::garbage:
        return "\x01{]not json";
      case Fault::not_finite:
        return R"({"inverse3":[{"device_id":"0417","state":{"cursor_position":{"x":NaN,"y":1e999,"z":0}}}]})";
      case Fault::nested:
        return std::string(100'000, '[');
      case Fault::huge:
        return std::string(2'000'000, ' ');
      case Fault::closed:
        return "closed";
      case Fault::none:
      case Fault::far_away:
      case Fault::no_device:
      case Fault::stuck:
      case Fault::stalled:
        break;
    }
    return state(false).dump();
  }

  Options options_;
  std::string older_state_;
  boost::asio::io_context context_;
  tcp::acceptor acceptor_;
  std::atomic<bool> ends_{false};
  std::atomic<int> socket_{-1};
  std::thread thread_;
};

VirtualInverse3::VirtualInverse3(const Options& options) : server_(std::make_unique<Server>(options)) {}
VirtualInverse3::~VirtualInverse3() = default;

std::uint16_t VirtualInverse3::port() const { return server_->port(); }

Vec3 VirtualInverse3::force_N() const {
  const std::scoped_lock lock(server_->mutex_);
  return server_->force_N_;
}

void VirtualInverse3::pull_to(Vec3 goal_m) {
  const std::scoped_lock lock(server_->mutex_);
  server_->handle_.goal_m = kRest_m + goal_m;
}

void VirtualInverse3::hold_at_rest() {
  const std::scoped_lock lock(server_->mutex_);
  server_->handle_.position_m = server_->handle_.goal_m = kRest_m;
  server_->handle_.velocity_m_per_s = {};
}

void VirtualInverse3::inject(Fault fault) {
  const std::scoped_lock lock(server_->mutex_);
  server_->fault_ = fault;
  server_->stuck_at_m_ = server_->handle_.measured_m();
}

void VirtualInverse3::calibrate() {
  const std::scoped_lock lock(server_->mutex_);
  server_->calibrated_ = true;
}

std::uint64_t VirtualInverse3::messages() const {
  const std::scoped_lock lock(server_->mutex_);
  return server_->messages_;
}

std::uint64_t VirtualInverse3::strange() const {
  const std::scoped_lock lock(server_->mutex_);
  return server_->strange_;
}

std::string VirtualInverse3::first_message() const {
  const std::scoped_lock lock(server_->mutex_);
  return server_->first_message_;
}

}  // namespace palpable::device
