// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/multipart_reader.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string head(const std::string& type = "multipart/x-mixed-replace; boundary=frame",
                 const std::string& more = {}) {
  return "HTTP/1.1 200 OK\r\nServer: a camera\r\nContent-Type: " + type + "\r\n" + more + "\r\n";
}

std::string counted(const std::string& picture, const std::string& marker = "--frame") {
  return "\r\n" + marker +
         "\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture.size()) + "\r\n\r\n" +
         picture;
}

std::string uncounted(const std::string& picture) {
  return "--frame\r\nContent-Type: image/jpeg\r\n\r\n" + picture + "\r\n";
}

/// All parts, with the bytes given in pieces of this size; the error at the end.
std::vector<std::string> parts_of(const std::string& bytes, std::size_t piece) {
  MultipartReader reader;
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    const auto added = reader.add(std::string_view(bytes).substr(at, piece));
    if (const auto part = reader.take()) parts.push_back(text_of(*part));
    if (!added) parts.push_back("error: " + added.error().message);
    if (!added) break;
  }
  return parts;
}

std::string in_pieces(const std::string& body, std::size_t piece) {
  std::string out;
  for (std::size_t at = 0; at < body.size(); at += piece) {
    const auto part = body.substr(at, piece);
    char length[32];
    std::snprintf(length, sizeof length, "%zX;of=a\r\n", part.size());
    out += length + part + "\r\n";
  }
  return out;
}

TEST(MultipartReader, ReadsPartsWithAndWithoutTheirLengthHoweverTheyAreCut) {
  const std::string tricky = "\xFF\xD8 --fram --\r\n--fr\n\r\n";
  const std::string plain = head() + "a preamble" + counted(tricky + "--frame in it") + "\r\n" +
                            uncounted(tricky) + counted("three").substr(2) + "\r\n--frame--\r\n";
  const std::vector<std::string> expected{tricky + "--frame in it", tricky, "three"};
  const std::string chunked =
      head("Multipart/X-Mixed-Replace;boundary=\"--frame\"; x=y", "transfer-encoding: Chunked\r\n") +
      in_pieces(plain.substr(head().size()), 7);
  for (const std::string& bytes : {plain, chunked})
    for (const std::size_t piece : {1U, 2U, 3U, 5U}) EXPECT_EQ(parts_of(bytes, piece), expected) << piece;
  MultipartReader reader;
  ASSERT_TRUE(reader.add(plain));
  EXPECT_EQ(reader.parts(), 3U);
  EXPECT_EQ(text_of(*reader.take()), "three");
  EXPECT_FALSE(reader.take());
}

TEST(MultipartReader, ReadsABoundaryThatIsStatedWithItsLines) {
  for (const char* marker : {"--frame", "----frame"})
    EXPECT_EQ(parts_of(head("multipart/x-mixed-replace;boundary=--frame") + counted("one", marker), 1),
              std::vector<std::string>{"one"});
  EXPECT_EQ(
      parts_of("HTTP/1.0 200 OK\nContent-Type:multipart/mixed;boundary=frame\n\n--frame\n\none\n--frame",
               1000),
      std::vector<std::string>{"one"});
}

TEST(MultipartReader, GoesOnBehindALengthThatIsTooShort) {
  const std::string cut = "\r\n--frame\r\nContent-Length: 2\r\n\r\nlonger" + counted("next");
  EXPECT_EQ(parts_of(head() + cut, 1), (std::vector<std::string>{"lo", "next"}));
}

TEST(MultipartReader, RefusesWhatIsNoStreamOfPictures) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"SSH-2.0-OpenSSH\r\n\r\n", "HTTP server"},
      {"HTTP/1.1 302 Found\r\nLocation: file:///etc/passwd\r\n\r\n", "not followed"},
      {"HTTP/1.1 401 Unauthorized\r\n\r\n", "passwords"},
      {"HTTP/1.1 404 Not Found\r\n\r\n", "404"},
      {head("image/jpeg"), "single picture"},
      {head("text/html"), "something else"},
      {head("multipart/x-mixed-replace"), "parted"},
      {head("multipart/x-mixed-replace; boundary=" + std::string(201, 'a')), "parted"},
      {head() + "--frame\r\nContent-Length: -1\r\n\r\n", "no number"},
      {head() + "--frame\r\nContent-Length: 99999999999999999999\r\n\r\n", "no number"},
      {head() + "--frame\r\nContent-Length: 50331649\r\n\r\n", "48 MiB"},
      {head() + "--frame\r\nX: " + std::string(kMostHeaderBytes, 'x'), "16 KiB"},
      {std::string(kMostHeaderBytes + 1, 'x'), "16 KiB"},
      {head("multipart/mixed;boundary=a", "Transfer-Encoding: chunked\r\n") + "zz\r\n", "pieces"},
      {head("multipart/mixed;boundary=a", "Transfer-Encoding: chunked\r\n") + "0\r\n", "ended"},
      {head("multipart/mixed;boundary=a", "Transfer-Encoding: chunked\r\n") + std::string(2000, '1'),
       "pieces"}};
  for (const auto& [bytes, word] : cases)
    for (const std::size_t piece : {std::size_t{1}, std::size_t{100000}}) {
      const auto parts = parts_of(bytes, piece);
      ASSERT_EQ(parts.size(), 1U) << bytes.substr(0, 100);
      EXPECT_NE(parts[0].find(word), std::string::npos) << parts[0];
    }
}

TEST(MultipartReader, BoundsAPictureWithoutAnEnd) {
  for (const std::string& begin : {head() + "--frame\r\n\r\n", head()}) {
    MultipartReader reader;
    ASSERT_TRUE(reader.add(begin));
    const std::string rubbish(std::size_t{1} << 20U, 'x');
    std::size_t taken = 0;
    while (reader.add(rubbish) && taken < 100) ++taken;
    EXPECT_EQ(taken, 48U);
    EXPECT_FALSE(reader.take());
  }
}

}  // namespace
}  // namespace palpable::sources
