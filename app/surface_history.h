// The states through which a surface went, for undo and redo.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/surface_wish.h"
#include "core/scan/mesh.h"
#include "core/scan/mesh_health.h"

namespace gyre {

struct SurfaceState {
  MeshPtr mesh;  // never null
  MeshHealth health;
  SurfaceWish wish;  // the kind of surface beneath all cleaning
  std::string step;  // what led here, in words for the user: "crop, smooth"
};

// What the meshes of a history may take: some fifty states of a large scan. [bytes]
inline constexpr std::size_t kHistory_bytes = std::size_t{512} << 20U;

// A value. Meshes are shared, not copied: going back gives the very mesh that was there. When they
// take more than the bound, the oldest are let go, but never the first, the present one and the one
// before it, so the way back to the beginning stays open.
class SurfaceHistory {
 public:
  explicit SurfaceHistory(std::size_t most_bytes = kHistory_bytes) : most_bytes_(most_bytes) {}

  // Everything before is forgotten; there is nothing to undo.
  void begin(SurfaceState first);
  void clear();
  // What had been undone is forgotten.
  void add(SurfaceState next);
  // Puts the state in place of the present one, as add() after undo(): for a value that is still
  // being dragged. The first state is never replaced.
  void replace(SurfaceState next);

  // What was found out about the present state. There is one.
  void know(const MeshHealth& health);

  // False when there is nothing to go to.
  bool undo();
  bool redo();

  // Null when there is none.
  const SurfaceState* first() const { return at(0); }
  const SurfaceState* now() const { return at(present_); }
  const SurfaceState* before() const { return present_ == 0 ? nullptr : at(present_ - 1); }
  const SurfaceState* next() const { return at(present_ + 1); }

  // What the distinct meshes of all states take. [bytes]
  std::size_t bytes() const;
  // How many states between the first and the second were let go since begin().
  std::size_t letGo() const { return let_go_; }

 private:
  const SurfaceState* at(std::size_t index) const {
    return index < states_.size() ? &states_[index] : nullptr;
  }
  void keepWithinBound();

  std::size_t most_bytes_;
  std::vector<SurfaceState> states_;
  std::size_t present_ = 0;
  std::size_t let_go_ = 0;
};

}  // namespace gyre
