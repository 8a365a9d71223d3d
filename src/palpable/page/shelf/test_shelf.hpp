// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// A home page's server from a browser's side, with programs that stand for `palpable make` and `export`.

#include "palpable/page/shelf/shelf.hpp"
#include "palpable/page/shelf/test_programs.hpp"
#include "palpable/page/test_page.hpp"

#include <functional>
#include <mutex>

namespace palpable::page::shelf {

class ServedShelf : public Served {
 public:
  explicit ServedShelf(const std::string& commands, ShelfOptions options = {}) : folder(new_folder("shelf")) {
    EXPECT_TRUE(formats::write_scene(folder / "scene.palp", test_scene()));
    options.program = program_of(folder, "scene='" + (folder / "scene.palp").string() + "'\n" + commands);
    options.state_folder = folder / "state";
    options.samples = {
        {"one", {"One", "a relief", "A sample."}, "/samples/one.png", {{"make", "sample:one"}, {}}}};
    options.begin_touch = [this](const TouchRequest& request) -> Result<std::shared_ptr<PageHost>> {
      EXPECT_EQ(touches, 0) << "the device is still in use";
      ++touches;
      ++begun;
      name = request.name;
      notes = request.notes;
      const std::lock_guard lock(mutex);
      keep = request.keep;
      touched = request.scene;
      return std::shared_ptr<PageHost>(new FakeHost, [this](PageHost* host) {
        delete host;
        --touches;
      });
    };
    shelf = Shelf::open(std::move(options)).value();
    start({}, [this](const ServeOptions& used, const std::atomic<bool>& end) {
      return serve_shelf(*shelf, used, end);
    });
    cookie = cookie_of(*this);
  }
  ~ServedShelf() {
    stop();
    shelf.reset();
  }

  Response post(const std::string& target, const std::string& body) const {
    return ask(*this, http::verb::post, target, body,
               {{http::field::cookie, cookie}, {http::field::origin, own_origin()}});
  }
  Response get(const std::string& target) const {
    return ask(*this, http::verb::get, target, {}, {{http::field::cookie, cookie}});
  }
  Json tell(const Json& message) const {
    return Json::parse(post("/shelf", message.dump()).body(), nullptr, false);
  }
  std::string upload(const std::string& bytes = "bytes") const {
    return Json::parse(post("/upload/photo.png", bytes).body())["file"];
  }
  Json make(const std::string& file, const std::string& what = "decide") const {
    return tell({{"type", "make"},
                 {"files", {file}},
                 {"what", what},
                 {"title", nullptr},
                 {"size_mm", nullptr},
                 {"exaggerate", nullptr},
                 {"ground", nullptr},
                 {"background", nullptr},
                 {"moved_mm", nullptr}});
  }
  Json end_of(Json job) const {
    while (job["state"] == "making" || job["state"] == "opening" || job["state"] == "saving") {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      job = tell({{"type", "follow"}, {"job", job["job"]}});
    }
    return job;
  }

  std::filesystem::path folder;
  std::unique_ptr<Shelf> shelf;
  std::string cookie;
  std::string name;
  std::vector<std::string> notes;
  std::mutex mutex;
  std::function<Result<void>(const models::Scene&)> keep;
  std::shared_ptr<const models::Scene> touched;
  std::atomic<int> touches = 0;
  std::atomic<int> begun = 0;
};

inline constexpr const char* kCopies = "cp \"$scene\" \"$out\"";

}  // namespace palpable::page::shelf
