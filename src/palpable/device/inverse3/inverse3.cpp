// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/inverse3/inverse3.hpp"

#include "palpable/core/system/thread_priority.hpp"
#include "palpable/device/inverse3/inverse3_socket.hpp"
#include "palpable/device/open_options.hpp"
#include "palpable/device/transport/force_hand_off.hpp"
#include "palpable/device/url.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

namespace palpable::device {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using InverseClock = std::chrono::steady_clock;

constexpr auto kFirstState = std::chrono::seconds(2);
/// How often the driver looks whether a force must be taken back while the service does not answer.
constexpr auto kLook = std::chrono::milliseconds(1);
/// Silences, each after an answer, until those that are missing count as lost.
constexpr int kDoubted = 10;
constexpr auto kLeaving = std::chrono::milliseconds(20);
/// Positions farther from the base than this are no positions of an Inverse3.
constexpr double kFarthestInverse_m = 0.6;

constexpr const char* kInversePlace = "inverse3";

/// What a service did that ended its connection by this error.
std::string ending_of(beast::error_code error) {
  if (error == websocket::error::message_too_big) return "sends a message of more than a megabyte";
  const bool closed = error == websocket::error::closed || error == asio::error::eof ||
                      error == asio::error::connection_reset || error == asio::error::broken_pipe;
  return closed ? "closed the connection" : "breaks the connection's protocol (" + error.message() + ")";
}

double seconds_between(InverseClock::time_point from, InverseClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

/// The connection and its thread. Handlers run in that thread only.
class Inverse3::Link {
 public:
  struct State {
    Vec3 position_m;
    bool ready = false;
  };

  explicit Link(const Inverse3Options& options) : options_(options), socket_(context_), timer_(context_) {}
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Connects, and waits for the first position.
  Result<State> start();

  const std::string& filters() const { return filters_; }

  LatestValue<State> states;
  ForceHandOff forces;
  std::atomic<bool> lost{false};

  // Any thread.
  /// How the connection was lost, once it is.
  const std::string& ending() const { return ending_; }
  /// Whether the service says that the device is calibrated and ready.
  bool is_ready() const { return said_ready_.load(std::memory_order_relaxed); }
  /// Whether the service sends, but no position.
  bool sends_no_position() const { return since_position_.load(std::memory_order_relaxed) > 0; }

 private:
  /// The most that came of what a service sends.
  enum class Heard : std::uint8_t { nothing, web_socket, other, list, device, far_away };

  void connect(beast::error_code& error);
  /// Why start() has got no position.
  std::string no_position() const;
  void read();
  void on_message(beast::error_code error, std::size_t bytes);
  void follow(const Inverse3State& state);
  void send();
  void watch();
  /// The connection is lost. `how`: what the service did, with the sentence's subject left out.
  void lose(const std::string& how);

  Inverse3Options options_;
  asio::io_context context_;
  websocket::stream<asio::ip::tcp::socket> socket_;
  asio::steady_timer timer_;
  beast::flat_buffer buffer_;
  std::thread thread_;

  std::string device_id_;
  std::string filters_;
  std::optional<Vec3> position_m_;
  bool calibrated_ = true;
  bool ready_ = true;
  std::atomic<bool> said_ready_{true};
  bool first_ = true;
  Heard heard_ = Heard::nothing;
  /// Written before `lost`, which orders it for other threads.
  std::string ending_;
  /// Messages since the last position.
  std::atomic<unsigned> since_position_{0};
  bool writing_ = false;
  /// A command with a force was begun. A zero that was sent after it may not have been read, so it stays set.
  bool has_pushed_ = false;
  /// Commands that were sent and not yet answered.
  int awaited_ = 0;
  /// Answers to older commands that may still come.
  int owed_ = 0;
  bool heard_since_sent_ = false;
  /// How many silences in a row followed an answer.
  int doubted_ = 0;
  std::string command_;
  ForceHandOff::Taken in_flight_;
  InverseClock::time_point last_take_ = InverseClock::now();
  /// When the last position came. An older one makes no force.
  InverseClock::time_point placed_;
};

Inverse3::Link::~Link() {
  if (thread_.joinable()) {
    forces.cut();
    forces.wait_for_zero(kLeaving);
    context_.stop();
    thread_.join();
  }
  beast::error_code ignored;
  socket_.next_layer().close(ignored);
}

void Inverse3::Link::connect(beast::error_code& error) {
  error = connect_within(context_, socket_.next_layer(), options_.port, kFirstState);
  if (error) return;
  socket_.next_layer().set_option(asio::ip::tcp::no_delay(true), error);
  websocket::stream_base::timeout limits{};
  limits.handshake_timeout = kFirstState;
  limits.idle_timeout = websocket::stream_base::none();
  socket_.set_option(limits);
  socket_.read_message_max(kLongestInverse3Message_bytes);
  socket_.text(true);
}

Result<Inverse3::Link::State> Inverse3::Link::start() {
  beast::error_code error;
  connect(error);
  if (error)
    return Error{ErrorCode::device,
                 "the service of the Inverse3 does not run on port " + std::to_string(options_.port) + " (" +
                     error.message() + ")",
                 kInversePlace, Reason::device_silent};
  socket_.async_handshake("localhost:" + std::to_string(options_.port), "/",
                          [this](beast::error_code failed) {
                            if (failed) return lose("opens no WebSocket (" + failed.message() + ")");
                            heard_ = Heard::web_socket;
                            read();
                          });
  const auto until = InverseClock::now() + kFirstState;
  const auto may_answer = [&] {
    return !lost && !position_m_ && (heard_ <= Heard::web_socket || !device_id_.empty());
  };
  while (may_answer() && InverseClock::now() < until) context_.run_for(std::chrono::milliseconds(20));
  if (!position_m_) return Error{ErrorCode::device, no_position(), kInversePlace, Reason::device_silent};
  watch();
  thread_ = std::thread([this] {
    static_cast<void>(request_priority(kForcePriority));
    context_.run();
  });
  return State{*position_m_, calibrated_ && ready_};
}

std::string Inverse3::Link::no_position() const {
  const std::string other =
      "what runs on port " + std::to_string(options_.port) + " is no service of an Inverse3: it ";
  if (lost) return heard_ < Heard::list ? other + ending_ : "the service of the Inverse3 " + ending_;
  switch (heard_) {
    case Heard::nothing:
      return other + "opens no WebSocket within 2 s";
    case Heard::web_socket:
      return other + "sends no message within 2 s";
    case Heard::other:
      return other + "sends something else than a list of devices";
    case Heard::list:
      return options_.device_id.empty()
                 ? "the service answers, but lists no Inverse3"
                 : "the service lists no Inverse3 with the identifier " + options_.device_id;
    case Heard::device:
      return "the Inverse3 gives no position; check its power";
    case Heard::far_away:
      break;
  }
  return "the positions that the service gives are more than 0.6 m away from the Inverse3's base, which are "
         "none";
}

void Inverse3::Link::read() {
  socket_.async_read(buffer_,
                     [this](beast::error_code error, std::size_t bytes) { on_message(error, bytes); });
}

void Inverse3::Link::on_message(beast::error_code error, std::size_t /*bytes*/) {
  if (error) return lose(ending_of(error));
  const auto data = buffer_.cdata();
  const std::string_view text(static_cast<const char*>(data.data()), data.size());
  const auto state =
      parse_inverse3_state(text, device_id_.empty() ? std::string_view(options_.device_id) : device_id_);
  // The first message lists all devices there are.
  if (!state && heard_ < Heard::list) heard_ = is_inverse3_list(text) ? Heard::list : Heard::other;
  since_position_.fetch_add(1, std::memory_order_relaxed);
  if (state) follow(*state);
  buffer_.consume(buffer_.size());
  heard_since_sent_ = true;
  int& answered = owed_ > 0 ? owed_ : awaited_;
  answered = std::max(0, answered - 1);
  // Without a device there is nothing to command; the next message may list one.
  if (!device_id_.empty() && !writing_ && awaited_ + owed_ == 0) send();
  read();
}

void Inverse3::Link::follow(const Inverse3State& state) {
  if (device_id_.empty()) {
    device_id_ = state.device_id;
    for (const auto& filter : state.filters) filters_ += (filters_.empty() ? "" : ", ") + filter;
  }
  calibrated_ = state.calibrated.value_or(calibrated_);
  ready_ = state.ready.value_or(ready_);
  said_ready_ = calibrated_ && ready_;
  if (!position_m_) heard_ = state.position_m ? Heard::far_away : Heard::device;
  if (!state.position_m || norm(*state.position_m) > kFarthestInverse_m) return;
  position_m_ = *state.position_m;
  placed_ = InverseClock::now();
  since_position_.store(0, std::memory_order_relaxed);
  states.put({*state.position_m, calibrated_ && ready_});
}

void Inverse3::Link::send() {
  const auto now = InverseClock::now();
  in_flight_ =
      forces.take(seconds_between(last_take_, now),
                  calibrated_ && ready_ && seconds_between(placed_, now) < ForceHandOff::kUnwritten_s);
  last_take_ = now;
  const Vec3 force = in_flight_.valid ? in_flight_.command : Vec3{};
  command_ = inverse3_command(device_id_, force, options_.form, std::exchange(first_, false));
  writing_ = true;
  has_pushed_ = has_pushed_ || force != Vec3{};
  ++awaited_;
  heard_since_sent_ = false;
  socket_.async_write(asio::buffer(command_), [this](beast::error_code error, std::size_t) {
    writing_ = false;
    if (error) return lose(ending_of(error));
    forces.sent(in_flight_);
  });
}

void Inverse3::Link::lose(const std::string& how) {
  if (lost) return;
  ending_ = how;
  lost = true;
  // A service that still writes into this connection would be held up by it, and answer no other.
  beast::error_code ignored;
  socket_.next_layer().close(ignored);
  if (!has_pushed_) return;
  constexpr int kAttempts = 10;
  const auto free = inverse3_command(device_id_, {}, options_.form, true);
  for (int n = 0; n < kAttempts && !send_anew(options_.port, free); ++n) {
  }
}

void Inverse3::Link::watch() {
  timer_.expires_after(kLook);
  timer_.async_wait([this](beast::error_code error) {
    if (error) return;
    // A service that does not answer is sent zero all the same, once the force is no longer valid.
    const auto now = InverseClock::now();
    if (!writing_ && !device_id_.empty() && !lost &&
        seconds_between(last_take_, now) >= ForceHandOff::kUnwritten_s) {
      // The answers that are missing may come later, and must not make commands of their own: else each
      // silence would leave more of them on the way, and a force would act later and later. They are lost if
      // others came before each of several silences.
      doubted_ = heard_since_sent_ ? doubted_ + 1 : 0;
      const bool are_lost = doubted_ >= kDoubted;
      owed_ = are_lost ? 0 : owed_ + awaited_;
      awaited_ = 0;
      send();
    }
    watch();
  });
}

Inverse3::Inverse3(std::unique_ptr<Link> link, const Inverse3Options& options)
    : link_(std::move(link)), fresh_(1.0 / options.rate_hz) {
  traits_.name = "Haply Inverse3";
  if (!link_->filters().empty()) traits_.name += " (its service's filters: " + link_->filters() + ")";
  // About the reach of its arms around the middle; no hardware has confirmed it.
  traits_.workspace_m = {0.16, 0.12, 0.12};
  traits_.max_force_N = options.max_force_N;
  traits_.continuous_force_N = continuous_force(options.continuous_force_N, traits_.max_force_N);
  traits_.delay_samples = 2;
  traits_.rate_hz = options.rate_hz;
}

Result<std::unique_ptr<Inverse3>> Inverse3::open(const Inverse3Options& options) {
  auto link = std::make_unique<Link>(options);
  const auto first = link->start();
  if (!first) return first.error();
  std::unique_ptr<Inverse3> device(new Inverse3(std::move(link), options));
  device->centre_m_ = first->position_m;
  return device;
}

Inverse3::~Inverse3() = default;

Reading Inverse3::read() noexcept {
  fresh_.pass();
  if (link_->forces.notice_taken_back()) fresh_.rest();
  if (Link::State state; link_->states.take(state)) {
    const Vec3 moved = state.position_m - centre_m_;
    fresh_.renew_plausible({moved.x, moved.z, -moved.y}, 0, state.ready ? Status::ok : Status::not_ready);
  }
  return fresh_.now(link_->lost.load(std::memory_order_relaxed));
}

void Inverse3::write(Vector<DeviceFrame> force_N) noexcept {
  const Vec3 force = fresh_.allowed(force_N.v);
  link_->forces.put({force.x, -force.z, force.y});
}

void Inverse3::stop() noexcept { link_->forces.cut(); }

std::string Inverse3::fault() const {
  if (link_->lost) return "the service of the Inverse3 " + link_->ending();
  if (link_->sends_no_position()) return FreshReading::silence_of("service of the Inverse3");
  return "the service of the Inverse3 does not answer any more";
}

std::string Inverse3::guidance() const {
  return link_->is_ready()
             ? std::string()
             : "Calibrate the Inverse3 in its maker's program: there is no force until its service says "
               "that it is calibrated and ready";
}

Result<std::vector<std::string>> inverse3_ports() {
  asio::io_context context;
  asio::ip::tcp::socket socket(context);
  if (connect_within(context, socket, Inverse3Options{}.port, kFirstState))
    return Error{ErrorCode::device, "its service does not run", kInversePlace};
  return std::vector<std::string>{""};
}

Result<std::unique_ptr<Device>> open_inverse3(DeviceUrl& url, const OpenOptions& options) {
  Inverse3Options wanted;
  wanted.device_id = url.path();
  wanted.port = static_cast<std::uint16_t>(url.take_count("port", wanted.port, 1, 65535));
  wanted.max_force_N = url.take_number("max-force", wanted.max_force_N, 0.1, 40.0);
  wanted.continuous_force_N = take_continuous_force(url);
  const std::string form = url.take_word("form", {"both", "vector", "values"});
  wanted.form = form == "vector"   ? Inverse3Form::vector
                : form == "values" ? Inverse3Form::values
                                   : Inverse3Form::both;
  wanted.rate_hz = options.rate_hz;
  if (auto valid = url.finish(); !valid) return std::move(valid).error();
  auto device = Inverse3::open(wanted);
  if (!device) return std::move(device).error();
  return std::unique_ptr<Device>(*std::move(device));
}

}  // namespace palpable::device
