// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/isolated/isolated.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/calibration/calibration.hpp"
#include "palpable/sources/calibration/calibration_reply.hpp"
#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/picture/picture_reply.hpp"
#include "palpable/sources/solid/mesh_file.hpp"
#include "palpable/sources/solid/mesh_reply.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace palpable::sources::isolated {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// During its lifetime, this program replaces the decoder.
class WithDecoder {
 public:
  explicit WithDecoder(const std::string& script) {
    file_ = fs::path(testing::TempDir()) / (std::string("palpable-decoder-") +
                                            testing::UnitTest::GetInstance()->current_test_info()->name());
    std::ofstream(file_) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(file_, fs::perms::owner_all);
    ::setenv("PALPABLE_MESH_DECODER", file_.c_str(), 1);
  }
  ~WithDecoder() {
    ::unsetenv("PALPABLE_MESH_DECODER");
    fs::remove(file_);
  }
  WithDecoder(const WithDecoder&) = delete;
  WithDecoder& operator=(const WithDecoder&) = delete;

 private:
  fs::path file_;
};

/// What a decoder reports before it reads the file.
const std::string kBegin = "printf b >&5; ";

/// Of processor time; more of wall time, since a busy machine may start a program late.
constexpr Limits kOneSecond{std::uint64_t{1} << 30U, std::uint64_t{1} << 20U, std::chrono::seconds(1),
                            std::chrono::seconds(3)};

std::string message_of(const Result<Mesh>& mesh) { return mesh ? "a mesh" : mesh.error().message; }

TEST(Isolated, GivesEveryTriangleOfAMesh) {
  const auto mesh = decode_mesh(as_bytes(kTetrahedron), "obj");
  ASSERT_TRUE(mesh) << message_of(mesh);
  ASSERT_EQ(mesh->triangles.size(), 4U);
  double area_m2 = 0.0;
  Vec3 twice_the_areas{};
  for (const auto& [a, b, c] : mesh->triangles) {
    const Vec3 normal =
        cross(mesh->vertices_m[b] - mesh->vertices_m[a], mesh->vertices_m[c] - mesh->vertices_m[a]);
    area_m2 += 0.5 * norm(normal);
    twice_the_areas += normal;
  }
  EXPECT_NEAR(area_m2, 1.5 + 0.5 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(norm(twice_the_areas), 0.0, 1e-6) << "a closed surface";
}

TEST(Isolated, ServesManyThreadsAtOnce) {
  std::vector<std::thread> threads;
  std::atomic<int> good{0};
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&good] { good += decode_mesh(as_bytes(kTetrahedron), "obj") ? 1 : 0; });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 8);
}

TEST(Isolated, SaysWhatTheDecoderRefused) {
  EXPECT_THAT(message_of(decode_mesh(as_bytes("v 0 0 0\n"), "obj")), HasSubstr("mesh"));
  EXPECT_FALSE(decode_mesh(std::span<const std::byte>(), "obj"));
}

TEST(Isolated, ACrashIsDamage) {
  const WithDecoder crashing(kBegin + "kill -SEGV $$");
  const auto mesh = decode_mesh(as_bytes(kTetrahedron), "obj");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(mesh.error().message, HasSubstr("crashed"));
}

TEST(Isolated, DeepNestingDoesNotEndThisProcess) {
  for (const std::string& text :
       {"%YAML:1.0\n---\na: " + std::string(60000, '['), "<?xml version=\"1.0\"?><opencv_storage>" + [] {
          std::string deep;
          for (int k = 0; k < 60000; ++k) deep += "<a>";
          return deep;
        }()}) {
    const auto calibration = decode_calibration(as_bytes(text));
    ASSERT_FALSE(calibration);
    EXPECT_EQ(calibration.error().code, ErrorCode::invalid_input);
  }
}

TEST(Isolated, EndlessWorkIsEnded) {
  const WithDecoder endless(kBegin + "while :; do :; done");
  const auto reply = decode(Job::obj, as_bytes(kTetrahedron), kOneSecond);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(reply.error().message, HasSubstr("was not read within 1 s"));
}

TEST(Isolated, AProgramThatHangsIsEndedWhateverItDoesWithItsDescriptors) {
  const fs::path left = fs::path(testing::TempDir()) / "palpable-isolated-left";
  for (const std::string& script : {std::string("sleep 60"), std::string("exec 5>&-; sleep 60"),
                                    "(sleep 5; touch " + left.string() + ") & sleep 60"}) {
    const WithDecoder hanging(kBegin + script);
    const auto begin = std::chrono::steady_clock::now();
    const auto reply = decode(Job::obj, as_bytes(kTetrahedron), kOneSecond);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30)) << script;
    ASSERT_FALSE(reply) << script;
    EXPECT_THAT(reply.error().message, HasSubstr("was not read within 1 s")) << script;
  }
  // What it has started ends with it.
  std::this_thread::sleep_for(std::chrono::seconds(4));
  EXPECT_FALSE(fs::exists(left));
}

TEST(Isolated, AProgramThatRestsIsEndedBeforeItsTime) {
  const WithDecoder hanging(kBegin + "exec sleep 300");
  Limits patient = kOneSecond;
  patient.time = std::chrono::seconds(300);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(decode(Job::obj, as_bytes(kTetrahedron), patient));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(100));
}

TEST(Isolated, AProgramThatDoesNotBeginIsNoFaultOfTheFile) {
  for (const char* script : {"exit 127", "kill -SEGV $$", "exit 0", "exit 3", "while :; do :; done"}) {
    const WithDecoder broken(script);
    const auto reply = decode(Job::obj, as_bytes(kTetrahedron), kOneSecond);
    ASSERT_FALSE(reply) << script;
    EXPECT_EQ(reply.error().code, ErrorCode::failed) << script;
    EXPECT_THAT(reply.error().message, HasSubstr("palpable-decoder-AProgram")) << script;
    EXPECT_THAT(reply.error().message, HasSubstr("the installation of Palpable is incomplete")) << script;
  }
}

TEST(Isolated, AProgramThatGetsNoThreadIsNoFaultOfTheFile) {
  const WithDecoder starved(kBegin + "exit 14");
  const auto reply = decode(Job::obj, as_bytes(kTetrahedron), kOneSecond);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, ErrorCode::failed);
  EXPECT_THAT(reply.error().message, HasSubstr("thread"));
}

TEST(Isolated, AMissingOrDifferentDecoderIsReported) {
  ::setenv("PALPABLE_MESH_DECODER", "/nowhere/palpable-mesh-decoder", 1);
  const auto missing = decode_mesh(as_bytes(kTetrahedron), "obj");
  ::unsetenv("PALPABLE_MESH_DECODER");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::failed);
  EXPECT_THAT(missing.error().message, HasSubstr("/nowhere/palpable-mesh-decoder"));
  const WithDecoder older("exit 10");
  const auto other = decode_mesh(as_bytes(kTetrahedron), "obj");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("another version"));
}

TEST(Isolated, OpensNoFileNamedInAMesh) {
  const fs::path pipe = fs::path(testing::TempDir()) / "palpable-isolated.mtl";
  fs::remove(pipe);
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // Opening a pipe without a writer would block for ever.
  const auto mesh = decode_mesh(as_bytes("mtllib " + pipe.string() + "\nusemtl a\n" + kTetrahedron), "obj");
  fs::remove(pipe);
  EXPECT_TRUE(mesh) << message_of(mesh);
}

TEST(Isolated, TakesNoMoreMemoryThanItIsAllowed) {
  Limits limits = limits_of(Job::obj, kTetrahedron.size());
  limits.memory_bytes = std::uint64_t{8} << 20U;
  const auto reply = decode(Job::obj, as_bytes(kTetrahedron), limits);
#ifdef PALPABLE_SANITIZED
  GTEST_SKIP() << "a sanitizer's memory is not limited";
#endif
  if (!reply) {
    EXPECT_EQ(reply.error().code, ErrorCode::invalid_input);
    return;
  }
  FlatReader flat(reply->bytes());
  EXPECT_FALSE(open_reply(flat));
}

// Replies of a compromised decoder.

std::vector<std::byte> reply_to(const StoredImage& image) {
  std::vector<std::byte> reply = reply_head(image);
  reply.insert(reply.end(), image.samples.begin(), image.samples.end());
  return reply;
}

TEST(IsolatedReply, OfAMeshMustNameItsOwnVertices) {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  EXPECT_TRUE(mesh_in(reply_of(mesh)));
  mesh.triangles[0][1] = 3;
  EXPECT_FALSE(mesh_in(reply_of(mesh)));
  mesh.triangles[0][1] = 1;
  mesh.vertices_m[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(mesh_in(reply_of(mesh)));
}

TEST(IsolatedReply, IsRefusedAtEveryLengthButItsOwn) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
  const StoredImage image{2, 2, 3, 8, std::vector<std::byte>(12)};
  const auto check = [](const std::vector<std::byte>& whole, const auto& read) {
    EXPECT_TRUE(read(whole));
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_FALSE(read(std::span(whole).first(size))) << size;
    std::vector<std::byte> longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(read(longer));
  };
  check(reply_of(mesh), [](std::span<const std::byte> bytes) { return mesh_in(bytes).has_value(); });
  check(reply_to(image), [](std::span<const std::byte> bytes) { return image_in(bytes).has_value(); });
  check(reply_of(Calibration{}),
        [](std::span<const std::byte> bytes) { return calibration_in(bytes).has_value(); });
}

TEST(IsolatedReply, ScalesIntegersAndKeepsFloats) {
  const auto samples_in = [](int bits, const auto& values) {
    const auto bytes = std::as_bytes(std::span(values));
    const StoredImage image{3, 1, 1, bits, {bytes.begin(), bytes.end()}};
    const auto back = image_in(reply_to(image));
    EXPECT_TRUE(back && back->bits == bits);
    return back ? back->samples : std::vector<float>();
  };
  using testing::ElementsAre;
  EXPECT_THAT(samples_in(8, std::array<std::uint8_t, 3>{0, 100, 255}), ElementsAre(0, 100.0F / 255.0F, 1));
  EXPECT_THAT(samples_in(16, std::array<std::uint16_t, 3>{0, 1000, 65535}),
              ElementsAre(0, 1000.0F / 65535.0F, 1));
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(samples_in(32, std::array<float, 3>{-2.5F, kInfinity, 7}), ElementsAre(-2.5F, kInfinity, 7));
}

TEST(IsolatedReply, OfAPictureWithAnUnknownLayoutIsRefused) {
  const std::vector<std::byte> samples(12);
  EXPECT_TRUE(image_in(reply_to({2, 2, 3, 8, samples})));
  EXPECT_FALSE(image_in(reply_to({2, 2, 3, 4, samples})));
  EXPECT_FALSE(image_in(reply_to({2, 2, 0, 8, samples})));
  EXPECT_FALSE(image_in(reply_to({-2, -2, 3, 8, samples})));
  EXPECT_FALSE(image_in(reply_to({2, 2, 3, 16, samples})));
}

TEST(IsolatedReply, OfAnErrorIsPlainTextOfOneLine) {
  const auto reply = error_reply(invalid_input("is \x1b[31mred\nand " + std::string(5000, 'x')));
  FlatReader flat(reply);
  const auto opened = open_reply(flat);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message.find('\x1b'), std::string::npos);
  EXPECT_EQ(opened.error().message.find('\n'), std::string::npos);
  EXPECT_LE(opened.error().message.size(), 400U);
}

}  // namespace
}  // namespace palpable::sources::isolated
