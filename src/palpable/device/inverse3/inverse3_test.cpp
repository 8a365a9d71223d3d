// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/inverse3/inverse3.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/device/drivers/open.hpp"
#include "palpable/device/virtual/virtual_inverse3.hpp"

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace palpable::device {
namespace {

using InverseFault = VirtualInverse3::Fault;

Result<std::unique_ptr<Device>> opened(const VirtualInverse3& service, const std::string& options = {}) {
  return open_device("inverse3:?port=" + std::to_string(service.port()) + options, {});
}

/// Ticks of 1 ms with this force until the condition holds; false if it does not within ten seconds.
bool tick_until(Device& device, Vec3 force_N, const std::function<bool(const Reading&)>& holds) {
  for (int k = 0; k < 10'000; ++k) {
    const Reading reading = device.read();
    device.write({force_N});
    if (holds(reading)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(Inverse3Device, ReadsFromWhereTheHandleWasInOurAxes) {
  VirtualInverse3 service;
  const auto device = opened(service);
  ASSERT_TRUE(device) << device.error().sentence();
  EXPECT_EQ((*device)->traits().name, "Haply Inverse3 (its service's filters: gravity_compensation)");
  // To the right, away from the user, up.
  service.pull_to({0.03, 0.02, 0.01});
  EXPECT_TRUE(tick_until(**device, {}, [](const Reading& reading) {
    return reading.status == Status::ok && norm(reading.position.v - Vec3{0.03, 0.01, -0.02}) < 5e-5;
  }));
}

TEST(Inverse3Device, MakesTheForceThatIsWrittenWithBothFormsOfTheMessage) {
  for (const bool values : {false, true}) {
    VirtualInverse3::Options options;
    options.takes_values = values;
    VirtualInverse3 service(options);
    const auto device = opened(service);
    ASSERT_TRUE(device) << device.error().sentence();
    EXPECT_TRUE(tick_until(**device, {0.1, 0.2, 0.3}, [&](const Reading&) {
      return service.force_N() == Vec3{0.1, -0.3, 0.2};
    })) << values;
  }
}

TEST(Inverse3Device, NamesItselfInItsFirstMessageOnly) {
  VirtualInverse3 service;
  const auto device = opened(service, "&form=vector");
  ASSERT_TRUE(device);
  EXPECT_TRUE(tick_until(**device, {}, [&](const Reading&) { return service.messages() > 3; }));
  EXPECT_NE(service.first_message().find("Palpable"), std::string::npos);
  EXPECT_EQ(service.first_message().find("values"), std::string::npos);
  EXPECT_EQ(inverse3_command("0417", {}, Inverse3Form::both, false).find("session"), std::string::npos);
}

TEST(Inverse3Device, IsFreeWithoutTheServoAndAfterACutAndWhenItIsClosed) {
  VirtualInverse3 service;
  auto device = opened(service);
  ASSERT_TRUE(device);
  const auto pushes = [&](const Reading&) { return service.force_N() != Vec3{}; };
  const auto is_free = [&] {
    for (int k = 0; k < 10'000 && service.force_N() != Vec3{}; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return service.force_N() == Vec3{};
  };
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, pushes));
  EXPECT_TRUE(is_free());
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, pushes));
  (*device)->cut_force();
  EXPECT_TRUE(is_free());
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, pushes));
  device->reset();
  EXPECT_TRUE(is_free());
}

TEST(Inverse3Device, GetsNoForceBeforeItIsCalibrated) {
  VirtualInverse3::Options options;
  options.calibrated = false;
  VirtualInverse3 service(options);
  const auto device = opened(service);
  ASSERT_TRUE(device);
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, [&](const Reading& reading) {
    EXPECT_EQ(reading.status, Status::not_ready);
    return service.messages() > 50;
  }));
  EXPECT_EQ(service.force_N(), Vec3{});
  service.calibrate();
  EXPECT_TRUE(tick_until(**device, {0.5, 0.0, 0.0}, [&](const Reading& reading) {
    return reading.status == Status::ok && service.force_N() == Vec3{0.5, 0.0, 0.0};
  }));
}

class Inverse3WithAFault : public testing::TestWithParam<InverseFault> {};

TEST_P(Inverse3WithAFault, IsFreeAndHasFailedInTheEnd) {
  VirtualInverse3 service;
  const auto device = opened(service);
  ASSERT_TRUE(device);
  const Vec3 force{0.5, 0.0, 0.0};
  ASSERT_TRUE(tick_until(**device, force, [&](const Reading&) { return service.force_N() == force; }));
  service.inject(GetParam());
  EXPECT_TRUE(tick_until(**device, force, [&](const Reading& reading) {
    EXPECT_TRUE(is_finite(reading.position));
    return reading.status != Status::ok && service.force_N() == Vec3{};
  }));
  // A busy machine makes a healthy reading stale, too: free is what it must be once it has failed, and stay.
  EXPECT_TRUE(tick_until(**device, force, [&](const Reading& reading) {
    return reading.status == Status::fault && service.force_N() == Vec3{};
  }));
  int ticks_after = 0;
  EXPECT_TRUE(tick_until(**device, force, [&](const Reading&) {
    EXPECT_EQ(service.force_N(), Vec3{});
    return ++ticks_after == 50;
  }));
}

INSTANTIATE_TEST_SUITE_P(Faults, Inverse3WithAFault,
                         testing::Values(InverseFault::silent, InverseFault::garbage,
                                         InverseFault::not_finite, InverseFault::nested, InverseFault::huge,
                                         InverseFault::far_away, InverseFault::no_device,
                                         InverseFault::closed));

TEST(Inverse3Device, IsNotThereWithoutAServiceOrADevice) {
  const auto nobody = open_device("inverse3:?port=1", {});
  EXPECT_EQ(nobody.error().code, ErrorCode::device);
  EXPECT_NE(nobody.error().message.find("does not run on port 1"), std::string::npos);
  VirtualInverse3::Options options;
  options.lists_a_device = false;
  VirtualInverse3 empty(options);
  EXPECT_EQ(opened(empty).error().message, "the service answers, but lists no Inverse3");
  VirtualInverse3 service;
  const auto other = open_device("inverse3:9999?port=" + std::to_string(service.port()), {});
  EXPECT_NE(other.error().message.find("9999"), std::string::npos);
  for (const auto* url : {"inverse3:?port=0", "inverse3:?form=json", "inverse3:?max-force=99"})
    EXPECT_EQ(open_device(url, {}).error().code, ErrorCode::usage) << url;
}

/// What the user is told of a service that has this fault from its first message on.
std::string told_at_first(InverseFault fault) {
  VirtualInverse3::Options options;
  options.at_first = fault;
  const VirtualInverse3 service(options);
  const auto device = opened(service);
  return device ? "opened" : device.error().message;
}

TEST(Inverse3Device, IsNotThereForTheReasonThatIsToldAtTheStart) {
  const auto holds = [](InverseFault fault, const char* part) {
    const std::string told = told_at_first(fault);
    EXPECT_NE(told.find(part), std::string::npos) << told;
  };
  holds(InverseFault::silent, "it sends no message within 2 s");
  holds(InverseFault::garbage, "it sends something else than a list of devices");
  holds(InverseFault::nested, "it sends something else than a list of devices");
  holds(InverseFault::huge, "it sends a message of more than a megabyte");
  holds(InverseFault::far_away, "more than 0.6 m away");
  holds(InverseFault::no_device, "lists no Inverse3");
  holds(InverseFault::closed, "it closed the connection");
}

TEST(Inverse3Device, HasFailedForTheReasonThatIsToldInATouch) {
  const std::map<InverseFault, std::string> kTold{
      {InverseFault::silent, "the service of the Inverse3 does not answer any more"},
      {InverseFault::garbage, "the service of the Inverse3 gives no valid position any more"},
      {InverseFault::not_finite, "the service of the Inverse3 gives no valid position any more"},
      {InverseFault::huge, "the service of the Inverse3 sends a message of more than a megabyte"},
      {InverseFault::far_away, "the service of the Inverse3 gives no valid position any more"},
      {InverseFault::no_device, "the service of the Inverse3 gives no valid position any more"},
      {InverseFault::closed, "the service of the Inverse3 closed the connection"}};
  for (const auto& [fault, told] : kTold) {
    VirtualInverse3 service;
    const auto device = opened(service);
    ASSERT_TRUE(device);
    service.inject(fault);
    EXPECT_TRUE(
        tick_until(**device, {}, [](const Reading& reading) { return reading.status == Status::fault; }));
    EXPECT_EQ((*device)->fault(), told);
  }
}

/// A program on a port that is no service: it sends this text to the first that connects, and hangs up.
class OtherProgram {
 public:
  explicit OtherProgram(std::string text)
      : text_(std::move(text)), listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(listener_.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_.number(), 1), 0);
    socklen_t size = sizeof address;
    ::getsockname(listener_.number(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] {
      const Descriptor link(::accept(listener_.number(), nullptr, nullptr));
      if (!text_.empty() && ::write(link.number(), text_.data(), text_.size()) < 0) return;
      // Until the other end has said what it wants, closing would take the text along.
      std::array<char, 1024> request{};
      if (::read(link.number(), request.data(), request.size()) < 0) return;
    });
  }
  ~OtherProgram() { thread_.join(); }
  OtherProgram(const OtherProgram&) = delete;
  OtherProgram& operator=(const OtherProgram&) = delete;
  int port() const { return port_; }

 private:
  std::string text_;
  Descriptor listener_;
  int port_ = 0;
  std::thread thread_;
};

TEST(Inverse3Device, IsNotThereBehindAnotherProgramsPort) {
  for (const std::string text :
       {"", "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n", "SSH-2.0-x\r\n\r\n"}) {
    const OtherProgram program(text);
    const auto device = open_device("inverse3:?port=" + std::to_string(program.port()), {});
    ASSERT_FALSE(device);
    EXPECT_NE(device.error().message.find("is no service of an Inverse3: it opens no WebSocket"),
              std::string::npos)
        << device.error().message;
  }
}

TEST(Inverse3Messages, NameNoDeviceOrFilterThatCannotBeShown) {
  const auto state = [](const std::string& id, const std::string& filter) {
    return parse_inverse3_state(
        R"({"inverse3":[{"device_id":")" + id + R"(","config":{")" + filter + R"(":true}}]})", "");
  };
  EXPECT_TRUE(state("0417", "gravity"));
  EXPECT_EQ(state("0417", "gravity")->filters.size(), 1U);
  EXPECT_EQ(state("0417", std::string(65, 'x'))->filters.size(), 0U);
  EXPECT_EQ(state("0417", R"(a\u001b[2J)")->filters.size(), 0U);
  EXPECT_FALSE(state(R"(a\nb)", "gravity"));
  EXPECT_FALSE(state(std::string(65, '1'), "gravity"));
  std::string many = R"({"inverse3":[{"device_id":"1","config":{)";
  for (int k = 0; k < 100; ++k) many += '"' + std::to_string(k) + "\":true,";
  EXPECT_EQ(parse_inverse3_state(many + R"("z":true}}]})", "")->filters.size(), 8U);
}

TEST(Inverse3Messages, AreNotParsedIfThatTakesLong) {
  const auto with = [](const std::string& more) {
    return parse_inverse3_state(R"({"inverse3":[{"device_id":"1","more":)" + more + "}]}", "");
  };
  EXPECT_TRUE(with('"' + std::string(60'000, ' ') + '"'));
  EXPECT_FALSE(with('"' + std::string(70'000, ' ') + '"'));
  EXPECT_TRUE(with("[[[1]]]"));
  EXPECT_FALSE(with(std::string(1000, '[') + std::string(1000, ']')));
}

TEST(Inverse3Messages, AreRefusedIfTheyAreNoState) {
  for (const auto* text : {"", "null", "[]", "{\"inverse3\":{}}", "{\"inverse3\":[1,{\"device_id\":4}]}"})
    EXPECT_FALSE(parse_inverse3_state(text, "")) << text;
  const auto odd = parse_inverse3_state(
      R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":"1","y":0,"z":0}},"status":[],"config":7}]})",
      "a");
  ASSERT_TRUE(odd);
  EXPECT_FALSE(odd->position_m);
  EXPECT_FALSE(odd->calibrated);
}

TEST(Inverse3Device, NeitherAllocatesNorWaitsInATick) {
  ASSERT_TRUE(allocations_are_counted());
  VirtualInverse3 service;
  const auto device = opened(service);
  ASSERT_TRUE(device);
  // Allocations are counted for each thread; the driver's own may allocate.
  const AllocationScope scope;
  for (int k = 0; k < 1000; ++k) {
    (*device)->read();
    (*device)->write({{0.1, 0.0, 0.0}});
  }
  (*device)->stop();
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::device
