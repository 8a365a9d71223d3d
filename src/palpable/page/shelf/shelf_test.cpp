// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The home page's server from a browser's side, with programs that stand for `palpable make`.
#include "palpable/page/shelf/shelf.hpp"

#include "palpable/page/shelf/test_shelf.hpp"

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gmock/gmock.h>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

TEST(Shelf, MakesASceneOfAFileAndBeginsItsTouch) {
  ServedShelf served(kCopies);
  EXPECT_EQ(served.get("/touch").result_int(), 303U) << "nothing is touched yet";
  const Json end = served.end_of(served.make(served.upload()));
  EXPECT_EQ(end["state"], "touching") << end;
  EXPECT_EQ(served.name, "A level");
  EXPECT_EQ(served.get("/touch").result_int(), 200U);
  TestPage page(served, served.cookie);
  EXPECT_EQ(Json::parse(page.read())["type"], "hello");
  const Json shelf = served.tell({{"type", "look"}});
  EXPECT_EQ(shelf["touching"], "A level");
  EXPECT_EQ(shelf["samples"][0]["scene"], "sample:one");
  ASSERT_EQ(shelf["recent"].size(), 1U);
  EXPECT_EQ(shelf["recent"][0]["title"], "A level");
  const auto picture = served.get(shelf["recent"][0]["picture"]);
  EXPECT_EQ(picture["Content-Type"], "image/png");
  EXPECT_TRUE(picture.body().starts_with("\x89PNG"));
}

TEST(Shelf, RemovesASceneThatItCannotKeepWithItsJob) {
  ServedShelf served(kCopies);
  EXPECT_TRUE(served.shelf->keeps_scenes());
  fs::remove_all(served.folder / "state");
  std::ofstream(served.folder / "state") << "a file where the folder was";
  const Json end = served.end_of(served.make(served.upload()));
  EXPECT_EQ(end["state"], "touching") << "it can be touched all the same";
  EXPECT_TRUE(served.tell({{"type", "look"}})["recent"].empty());
  EXPECT_THAT(served.notes, testing::ElementsAre(testing::HasSubstr("could not keep")));
}

TEST(Shelf, OpensAnotherSceneAndTellsThePagesOfTheFirst) {
  ServedShelf served(kCopies);
  ASSERT_EQ(served.end_of(served.tell({{"type", "open"}, {"scene", "sample:one"}}))["state"], "touching");
  TestPage page(served, served.cookie);
  EXPECT_EQ(Json::parse(page.read())["type"], "hello");
  ASSERT_EQ(served.end_of(served.make(served.upload()))["state"], "touching");
  EXPECT_EQ(page.read_to_the_end().reason, "another scene was opened");
  EXPECT_EQ(served.begun, 2);
  EXPECT_EQ(served.touches, 1);
  const std::string recent = served.tell({{"type", "look"}})["recent"][0]["scene"];
  EXPECT_EQ(served.end_of(served.tell({{"type", "open"}, {"scene", recent}}))["state"], "touching");
  const Json forgotten = served.tell({{"type", "forget"}, {"scene", nullptr}});
  EXPECT_TRUE(forgotten["recent"].empty());
  EXPECT_EQ(served.post("/shelf", Json{{"type", "open"}, {"scene", recent}}.dump()).body(),
            "this scene is no longer on the shelf");
}

TEST(Shelf, SurvivesAFileThatEndsItsProcess) {
  ServedShelf served("kill -SEGV $$");
  const std::string file = served.upload();
  const Json end = served.end_of(served.make(file));
  EXPECT_EQ(end["state"], "failed");
  EXPECT_NE(end["sentence"].get<std::string>().find("ended with a fault (signal 11)"), std::string::npos);
  EXPECT_EQ(served.end_of(served.make(file, "drawing"))["state"], "failed") << "the file is still there";
  EXPECT_EQ(served.tell({{"type", "look"}})["type"], "shelf");
}

TEST(Shelf, DoesNotOpenASceneThatIsNone) {
  ServedShelf served("echo 'no scene' > \"$out\"");
  const Json end = served.end_of(served.make(served.upload()));
  EXPECT_EQ(end["state"], "failed");
  EXPECT_EQ(served.begun, 0);
}

TEST(Shelf, CancelsAtAnyTimeAndGivesUpWhatNobodyWaitsFor) {
  ShelfOptions options;
  options.patience = std::chrono::milliseconds(500);
  ServedShelf served("sleep 1000", std::move(options));
  Json job = served.make(served.upload());
  EXPECT_EQ(job["state"], "making");
  job = served.end_of(served.tell({{"type", "cancel"}, {"job", job["job"]}}));
  EXPECT_EQ(job["state"], "cancelled");
  EXPECT_EQ(served.tell({{"type", "cancel"}, {"job", job["job"]}})["state"], "cancelled");
  job = served.make(served.upload());
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_EQ(served.tell({{"type", "follow"}, {"job", job["job"]}})["state"], "cancelled");
}

TEST(Shelf, MakesScenesOfTwoPagesAtOnceAndRefusesAThird) {
  ServedShelf served("sleep 1000");
  const std::string file = served.upload();
  const Json one = served.make(file), two = served.make(file);
  EXPECT_NE(one["job"], two["job"]);
  const auto third = served.post("/shelf", Json{{"type", "open"}, {"scene", "sample:one"}}.dump());
  EXPECT_EQ(third.result_int(), 409U);
  EXPECT_EQ(third.body(), "2 scenes are being made already, in other pages: wait for one, or cancel it");
}

TEST(Shelf, AdmitsOnlyItsOwnBrowserAndPage) {
  ServedShelf served(kCopies);
  const std::string look = R"({"type":"look"})";
  const std::string own = served.own_origin();
  const auto status = [&](const std::string& target, const std::string& cookie, const std::string& origin,
                          const std::string& host = {}) {
    return ask(served, http::verb::post, target, look,
               {{http::field::cookie, cookie}, {http::field::origin, origin}, {http::field::host, host}})
        .result_int();
  };
  for (const std::string target : {"/shelf", "/upload/a.png"}) {
    EXPECT_EQ(status(target, served.cookie, own), 200U);
    EXPECT_EQ(status(target, {}, own), 401U);
    EXPECT_EQ(status(target, served.cookie + "0", own), 401U);
    EXPECT_EQ(status(target, served.cookie, {}), 403U) << "a browser always says where it comes from";
    EXPECT_EQ(status(target, served.cookie, "http://evil.example"), 403U);
    EXPECT_EQ(status(target, served.cookie, own, "rebound.example"), 403U);
    EXPECT_EQ(ask(served, http::verb::put, target, look,
                  {{http::field::cookie, served.cookie}, {http::field::origin, own}})
                  .result_int(),
              405U);
  }
  EXPECT_EQ(ask(served, http::verb::get, "/picture/" + std::string(32, 'a')).result_int(), 401U);
  EXPECT_EQ(served.get("/picture/" + std::string(32, 'a')).result_int(), 404U);
  EXPECT_EQ(served.get("/picture/../../../etc/passwd").result_int(), 404U);
  EXPECT_EQ(served.get("/socket").result_int(), 426U);
  EXPECT_EQ(upgrade_status(served, served.cookie, own), 503U) << "nothing is touched";
}

TEST(Shelf, RefusesHostileMessages) {
  ServedShelf served(kCopies);
  for (const std::string& message :
       {std::string("junk"), std::string(1000, '['), std::string(R"({"type":"pause","paused":true})"),
        std::string(R"({"type":"make","files":["../../x"],"what":"decide"})"),
        std::string(R"({"type":"follow","job":-1})"), std::string(R"({"type":"look","more":1})")})
    EXPECT_EQ(served.post("/shelf", message).result_int(), 400U) << message;
  EXPECT_EQ(served.post("/shelf", std::string(5000, ' ')).result_int(), 413U);
  EXPECT_EQ(served.post("/shelf", R"({"type":"follow","job":99})").result_int(), 409U);
  EXPECT_TRUE(served.make("../../../etc/passwd").is_discarded());
}

/// What the server answers to bytes that are sent as they are, after which nothing more comes.
std::string answer_to(const ServedShelf& served, const std::string& bytes) {
  boost::asio::io_context context;
  tcp::socket socket(context);
  socket.connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), served.port));
  boost::beast::error_code error;
  boost::asio::write(socket, boost::asio::buffer(bytes), error);
  socket.shutdown(tcp::socket::shutdown_send, error);
  std::string answer;
  boost::asio::read(socket, boost::asio::dynamic_buffer(answer), error);
  return answer;
}

TEST(Shelf, RefusesHostileUploads) {
  ServedShelf served(kCopies);
  const std::string head = "POST /upload/a.png HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port) +
                           "\r\nOrigin: " + served.own_origin() + "\r\nCookie: " + served.cookie + "\r\n";
  EXPECT_THAT(answer_to(served, head + "Content-Length: 500000000\r\n\r\n"),
              testing::HasSubstr("a.png: has 500 MB, and a page may open at most 300 MB"));
  EXPECT_THAT(answer_to(served, head + "Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n"),
              testing::HasSubstr("411"));
  EXPECT_THAT(answer_to(served, head + "Content-Length: 99999999999999999999999\r\n\r\n"),
              testing::Not(testing::HasSubstr("200")));
  // Its rest never comes: nothing of it stays.
  EXPECT_EQ(answer_to(served, head + "Content-Length: 100\r\n\r\nhalf"), "");
  EXPECT_EQ(served.post("/upload/" + std::string(7000, 'a'), "bytes").result_int(), 200U);
  EXPECT_EQ(served.post("/upload/empty.png", "").body(), "empty.png: is empty");
  EXPECT_EQ(served.tell({{"type", "look"}})["type"], "shelf");
}

TEST(Shelf, AnswersNoFlood) {
  ServedShelf served(kCopies);
  unsigned refused = 0;
  for (int k = 0; k < 200; ++k)
    refused += served.post("/shelf", R"({"type":"look"})").result_int() == 429U ? 1 : 0;
  EXPECT_GT(refused, 0U);
}

TEST(Shelf, RemovesWhatAKilledOneLeftAndNothingElse) {
  const auto parent = fs::temp_directory_path();
  const fs::path killed = parent / "palpable-home-killed", other = parent / "palpable-home-other",
                 link = parent / "palpable-home-link";
  for (const fs::path& folder : {killed, other}) {
    fs::create_directory(folder);
    std::ofstream(folder / "upload.png") << "a picture";
  }
  std::ofstream(killed / "owner") << "";
  fs::create_directory_symlink(killed, link);
  const auto first = Shelf::open({}).value();
  EXPECT_FALSE(fs::exists(killed));
  EXPECT_TRUE(fs::exists(other / "upload.png")) << "it may be that of a shelf that is just being opened";
  EXPECT_TRUE(fs::is_symlink(link));
  const auto homes = [&parent] {
    return std::count_if(fs::directory_iterator(parent), fs::directory_iterator(), [](const auto& entry) {
      return entry.path().filename().string().starts_with("palpable-home-");
    });
  };
  const auto before = homes();
  const auto second = Shelf::open({}).value();
  EXPECT_EQ(homes(), before + 1) << "the first is in use";
}

}  // namespace
}  // namespace palpable::page::shelf
