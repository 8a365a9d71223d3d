// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::page {

/// What the page shows of a scene. Immutable once handed out.
struct PageScene {
  /// `scene` in it numbers the scenes of a session: another number means that another scene is touched.
  protocol::Scene about;
  /// Heights above the base in metres at exaggeration 1, row-major, origin top-left, covering the scene's
  /// rectangle; at least 2 x 2, all finite.
  Raster<float> height_m;
  /// Covers the same rectangle; may be empty.
  Raster<Rgb8> picture;
  /// The cells of a field at its surface, over the same rectangle; empty where `about.cells` is not set.
  Raster<Rgb8> cells;
};

/// What the page's server asks of the touch that it shows. All calls come from the one thread that runs
/// serve(), none of them may block for longer than a frame (16 ms).
class PageHost {
 public:
  PageHost() = default;
  PageHost(const PageHost&) = delete;
  PageHost& operator=(const PageHost&) = delete;
  virtual ~PageHost() = default;

  virtual protocol::Hello hello() const = 0;
  virtual protocol::Laws laws() const = 0;
  /// The scene touched now; never null.
  virtual std::shared_ptr<const PageScene> scene() = 0;
  virtual protocol::Settings settings() = 0;
  /// Those of the scene touched now.
  virtual protocol::Materials materials() = 0;
  /// The newest tick; which page moved a probe is left to the server.
  virtual protocol::State state() = 0;

  /// Called first, about 60 times a second, while a page is connected.
  virtual void update() = 0;
  virtual void move(const protocol::Pointer& pointer) = 0;
  /// Takes a further probe away.
  virtual void lift(const protocol::Lift& probe) = 0;
  /// May be carried out later. Then settings() shows what holds and has its serial in `answers`; what could
  /// not be done comes as a notice.
  virtual void change(const protocol::Change& change) = 0;
  /// Likewise, for one material.
  virtual void edit(const protocol::Edit& edit) = 0;
  /// Writes the scene into a file, later; a notice says where, or why not.
  virtual void save() = 0;
  virtual void pause(bool paused) = 0;
  virtual void recentre() = 0;
  /// The explorer of the egocentric view goes there.
  virtual void stand(const protocol::Stand& stand) = 0;
  /// Words on the scene or a place of it (protocol.json, `ask`). A description of the whole scene takes some
  /// frames.
  virtual std::string answer(const protocol::Ask& ask) = 0;
  /// The next sentence for the person (a fault, a better scene, …), each once; nullopt when there is none.
  virtual std::optional<protocol::Notice> next_notice() = 0;
};

}  // namespace palpable::page
