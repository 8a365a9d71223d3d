// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/host_changes.hpp"

#include "palpable/page/protocol.hpp"

#include <algorithm>
#include <utility>

namespace palpable::page {
namespace {

// Enough for the page's mesh and sound; the state carries the exact height.
constexpr int kLongestHeightSide = 320;

Raster<float> shares_of(const Raster<std::uint16_t>& shift) {
  Raster<float> shares(shift.width(), shift.height());
  std::transform(shift.values().begin(), shift.values().end(), shares.values().begin(), models::shift_share);
  return shares;
}

}  // namespace

template <class Message>
SharedFrame text_frame(const Message& message) {
  return std::make_shared<const Frame>(Frame{protocol::write_message(message), false});
}
template SharedFrame text_frame(const protocol::RobotFloor&);
template SharedFrame text_frame(const protocol::Head&);
template SharedFrame text_frame(const protocol::State&);
template SharedFrame text_frame(const protocol::Words&);
template SharedFrame text_frame(const protocol::Around&);
template SharedFrame text_frame(const protocol::Notice&);
template SharedFrame text_frame(const protocol::Sharing&);

std::vector<SharedFrame> HostChanges::everything(std::int64_t page,
                                                 const std::optional<protocol::Guest>& guest) {
  auto hello = host_.hello();
  hello.page = page;
  if (guest) {
    hello.guest = guest;
    hello.device = "the person who shares the scene";
    hello.pointer_moves = hello.egocentric = hello.home = hello.finds_head = false;
  }
  std::vector<SharedFrame> frames{text_frame(hello), text_frame(host_.laws())};
  if (const auto scene = host_.scene(); scene != shown_) show(scene);
  frames.insert(frames.end(), scene_frames_.begin(), scene_frames_.end());
  sent_settings_ = host_.settings();
  frames.push_back(text_frame(sent_settings_));
  sent_materials_ = host_.materials();
  frames.push_back(text_frame(sent_materials_));
  sent_robot_ = host_.robot();
  if (sent_robot_) frames.push_back(text_frame(*sent_robot_));
  return frames;
}

std::vector<protocol::Notice> HostChanges::notices() {
  std::vector<protocol::Notice> all;
  while (auto notice = host_.next_notice()) all.push_back(*std::move(notice));
  return all;
}

std::vector<SharedFrame> HostChanges::changes() {
  std::vector<SharedFrame> frames;
  if (const auto scene = host_.scene(); scene != shown_) {
    show(scene);
    frames.push_back(text_frame(host_.laws()));
    frames.insert(frames.end(), scene_frames_.begin(), scene_frames_.end());
  }
  if (const auto settings = host_.settings(); settings != sent_settings_) {
    sent_settings_ = settings;
    frames.push_back(text_frame(settings));
  }
  if (auto materials = host_.materials(); materials != sent_materials_) {
    sent_materials_ = std::move(materials);
    frames.push_back(text_frame(sent_materials_));
  }
  if (auto robot = host_.robot(); robot && robot != sent_robot_) {
    sent_robot_ = std::move(robot);
    frames.push_back(text_frame(*sent_robot_));
  }
  return frames;
}

void HostChanges::show(const std::shared_ptr<const PageScene>& scene) {
  shown_ = scene;
  const auto number = static_cast<std::uint32_t>(scene->about.scene);
  const auto binary = [](std::string bytes) {
    return std::make_shared<const Frame>(Frame{std::move(bytes), true});
  };
  scene_frames_ = {text_frame(scene->about),
                   binary(protocol::write_floats(protocol::RasterKind::heights, number,
                                                 protocol::thinned(scene->height_m, kLongestHeightSide)))};
  const auto push = [&](protocol::RasterKind kind, const Raster<Rgb8>& picture) {
    scene_frames_.push_back(
        binary(protocol::write_picture(kind, number, protocol::thinned(picture, kLongestPictureSide))));
  };
  if (scene->about.has_picture) push(protocol::RasterKind::picture, scene->picture);
  if (scene->second_view != nullptr) {
    push(protocol::RasterKind::second, scene->second_view->picture);
    scene_frames_.push_back(binary(
        protocol::write_floats(protocol::RasterKind::shift, number,
                               protocol::thinned(shares_of(scene->second_view->shift), kLongestHeightSide))));
  }
  if (scene->about.cells) push(protocol::RasterKind::cells, scene->cells);
}

}  // namespace palpable::page
