// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The functions that web/src/onefile/touch_module.ts calls. Memory that the page fills is taken by
// palpable_allocate(); what a function answers stays valid until the next call of any function.
#include "palpable/onefile/browser_touch.hpp"
#include "palpable/onefile/page_talk.hpp"
#include "palpable/onefile/probe_rows.hpp"
#include "palpable/onefile/scene_bytes.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#define PALPABLE_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace palpable::onefile {
namespace {

/// The page's touch: one, since a page has one scene.
struct OpenPage {
  std::shared_ptr<const models::Scene> scene;
  std::unique_ptr<BrowserTouch> touch;
  std::unique_ptr<PageTalk> talk;
  page::SharedFrame frame;
  std::vector<ForceRow> forces;
  /// An error, one sentence.
  std::string sentence;
};

OpenPage& open_page() {
  static OpenPage page;
  return page;
}

Result<void> open(std::span<const std::byte> bytes, Raster<Rgb8> picture, Raster<Rgb8> second) {
  auto scene = decode_scene_bytes(bytes);
  if (!scene) return scene.error();
  scene->texture = std::move(picture);
  if (scene->second_view != nullptr)
    scene->second_view = std::make_shared<const models::SecondView>(
        models::SecondView{std::move(second), scene->second_view->shift});
  OpenPage& page = open_page();
  page.scene = std::make_shared<const models::Scene>(*std::move(scene));
  auto touch = BrowserTouch::open(page.scene);
  if (!touch) return touch.error();
  page.touch = *std::move(touch);
  page.talk = std::make_unique<PageTalk>(*page.touch);
  return {};
}

/// Pixels of four bytes: red, green, blue, unused.
Raster<Rgb8> picture_of(const std::uint8_t* rgbx, int width, int height) {
  Raster<Rgb8> picture(width, height);
  for (Rgb8& pixel : picture.values()) {
    pixel = {rgbx[0], rgbx[1], rgbx[2]};
    rgbx += 4;
  }
  return picture;
}

}  // namespace
}  // namespace palpable::onefile

namespace {

using palpable::onefile::open_page;

constexpr int kNoFrame = 0, kTextFrame = 1, kBinaryFrame = 2;

}  // namespace

PALPABLE_EXPORT(palpable_allocate) void* palpable_allocate(std::size_t bytes) { return std::malloc(bytes); }
PALPABLE_EXPORT(palpable_release) void palpable_release(void* memory) { std::free(memory); }

/// The sentence of the last error.
PALPABLE_EXPORT(palpable_sentence) const char* palpable_sentence() { return open_page().sentence.c_str(); }

/// Opens the scene of these bytes with its picture, and that for the right eye: `width` x `height` pixels of
/// four bytes (red, green, blue, unused), or none (0 x 0). 1, or 0 and a sentence.
PALPABLE_EXPORT(palpable_open)
int palpable_open(const std::byte* bytes, std::size_t size, const std::uint8_t* rgbx, int width, int height,
                  const std::uint8_t* right_rgbx, int right_width, int right_height) {
  using palpable::onefile::picture_of;
  const auto opened = palpable::onefile::open({bytes, size}, picture_of(rgbx, width, height),
                                              picture_of(right_rgbx, right_width, right_height));
  if (!opened) open_page().sentence = opened.error().sentence();
  return opened ? 1 : 0;
}

/// A text frame of the page.
PALPABLE_EXPORT(palpable_receive) void palpable_receive(const char* text, std::size_t size) {
  open_page().talk->receive({text, size});
}

/// Runs the touch for this time; 0 at rest.
PALPABLE_EXPORT(palpable_advance) int palpable_advance(double seconds) {
  return open_page().talk->advance(seconds) ? 1 : 0;
}

/// Takes the next frame for the page: its kind, its bytes and their number.
PALPABLE_EXPORT(palpable_take_frame) int palpable_take_frame() {
  auto& page = open_page();
  page.frame = page.talk->take();
  if (page.frame == nullptr) return kNoFrame;
  return page.frame->binary ? kBinaryFrame : kTextFrame;
}
PALPABLE_EXPORT(palpable_frame) const char* palpable_frame() { return open_page().frame->bytes.data(); }
PALPABLE_EXPORT(palpable_frame_size) std::size_t palpable_frame_size() {
  return open_page().frame->bytes.size();
}

/// probe_rows() for `count` rows of four numbers: as many rows of four numbers, or null and a sentence.
PALPABLE_EXPORT(palpable_probe)
const double* palpable_probe(const char* options, std::size_t size, const double* rows, std::size_t count) {
  std::vector<palpable::onefile::ProbeRow> path(count);
  if (count > 0) std::memcpy(path.data(), rows, count * sizeof(path.front()));
  auto& page = open_page();
  auto forces = palpable::onefile::probe_rows(*page.scene, {options, size}, path);
  if (!forces) {
    page.sentence = forces.error().sentence();
    return nullptr;
  }
  page.forces = *std::move(forces);
  return page.forces.front().data();
}
