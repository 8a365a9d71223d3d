// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/models/scene/second_view.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::page {

/// Columns and rows of a picture that a page is sent, at most.
inline constexpr int kLongestPictureSide = 1024;

/// The page's view of a scene. Immutable.
struct PageScene {
  /// Its field `scene` is the scene's number in the session: a new number means a new scene.
  protocol::Scene about;
  /// Heights above the base in metres at a height factor of 1, row-major, origin top-left, covering the
  /// scene's rectangle; at least 2 x 2, all finite.
  Raster<float> height_m;
  /// Covers the same rectangle; may be empty.
  Raster<Rgb8> picture;
  /// What the right eye sees of it, as the scene has it; null: the same picture.
  std::shared_ptr<const models::SecondView> second_view;
  /// The cells of a field at its surface, over the same rectangle; empty if `about.cells` is not set.
  Raster<Rgb8> cells;
};

/// The interface between the page's server and the running touch. All calls come from the thread that runs
/// serve(); none may block for longer than a frame (16 ms).
class PageHost {
 public:
  PageHost() = default;
  PageHost(const PageHost&) = delete;
  PageHost& operator=(const PageHost&) = delete;
  virtual ~PageHost() = default;

  virtual protocol::Hello hello() const = 0;
  virtual protocol::Laws laws() const = 0;
  /// The current scene; never null.
  virtual std::shared_ptr<const PageScene> scene() = 0;
  virtual protocol::Settings settings() = 0;
  /// The materials of the current scene.
  virtual protocol::Materials materials() = 0;
  /// The robot whose camera is touched; nullopt: there is none.
  virtual std::optional<protocol::Robot> robot() { return std::nullopt; }
  /// What it has seen of the floor; nullopt: nothing yet.
  virtual std::optional<protocol::RobotFloor> robot_floor() { return std::nullopt; }
  /// The viewer's head in a picture that is newer than at the last call; nullopt: there is none, or nobody
  /// follows it.
  virtual std::optional<protocol::Head> head() { return std::nullopt; }
  /// Whether a page follows the viewer's head.
  virtual void follow_head(const protocol::FollowHead& /*follow*/) {}
  /// The newest tick. The server fills in which page moved each probe.
  virtual protocol::State state() = 0;

  /// Called first in each period, about 60 times per second, while a page is connected.
  virtual void update() = 0;
  virtual void move(const protocol::Pointer& pointer) = 0;
  /// Removes an additional probe.
  virtual void lift(const protocol::Lift& probe) = 0;
  /// May be carried out later: then settings() holds the result, with the change's serial in `answers`. A
  /// failure is reported as a notice.
  virtual void change(const protocol::Change& change) = 0;
  /// The same for one material.
  virtual void edit(const protocol::Edit& edit) = 0;
  /// Writes the scene to a file later; a notice gives the path or the error.
  virtual void save() = 0;
  virtual void pause(bool paused) = 0;
  virtual void recentre() = 0;
  virtual void order(const protocol::RobotOrder& /*order*/) {}
  /// The page that moved the first probe last is closed or hidden: what that probe drives stops.
  virtual void let_go() {}
  /// Moves the explorer of the egocentric view.
  virtual void move_explorer(const protocol::MoveExplorer& pose) = 0;
  /// The answer in words to a question about the scene or a place (protocol.json, `ask`). A description of
  /// the whole scene may take several frames.
  virtual protocol::Words answer(const protocol::Ask& ask) = 0;
  /// The names around a place. May take several frames after a name or the scene has changed.
  virtual protocol::Around around(const protocol::LookAround& question) = 0;
  /// Changes of names; a notice says what was done, or why not.
  virtual void name(const protocol::Name& name) = 0;
  virtual void unname(const protocol::Unname& name) = 0;
  virtual void undo_name(const protocol::UndoName& undo) = 0;
  /// A probe is led to a place, or no longer.
  virtual void find(const protocol::Find& find) = 0;
  /// The next notice for the user (a fault, a finer scene, …), each once; nullopt if there is none.
  virtual std::optional<protocol::Notice> next_notice() = 0;
};

}  // namespace palpable::page
