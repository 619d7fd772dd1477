// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/surface_history.h"

#include <iterator>
#include <set>
#include <utility>

#include "core/base/check.h"

namespace gyre {
namespace {

std::size_t bytesOf(const Mesh& mesh) {
  return mesh.vertices.capacity() * sizeof(MeshVertex) +
         mesh.triangles.capacity() * sizeof(Triangle);
}

}  // namespace

void SurfaceHistory::begin(SurfaceState first) {
  clear();
  GYRE_CHECK(first.mesh != nullptr);
  states_.push_back(std::move(first));
}

void SurfaceHistory::clear() {
  states_.clear();
  present_ = 0;
  let_go_ = 0;
}

void SurfaceHistory::add(SurfaceState next) {
  if (states_.empty()) {
    begin(std::move(next));
    return;
  }
  GYRE_CHECK(next.mesh != nullptr);
  states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(present_) + 1, states_.end());
  states_.push_back(std::move(next));
  ++present_;
  keepWithinBound();
}

void SurfaceHistory::replace(SurfaceState next) {
  if (present_ > 0) --present_;
  add(std::move(next));
}

void SurfaceHistory::know(const MeshHealth& health) {
  GYRE_CHECK(present_ < states_.size());
  states_[present_].health = health;
}

bool SurfaceHistory::undo() {
  if (before() == nullptr) return false;
  --present_;
  return true;
}

bool SurfaceHistory::redo() {
  if (next() == nullptr) return false;
  ++present_;
  return true;
}

std::size_t SurfaceHistory::bytes() const {
  std::set<const Mesh*> counted;
  std::size_t sum = 0;
  for (const SurfaceState& state : states_) {
    if (counted.insert(state.mesh.get()).second) sum += bytesOf(*state.mesh);
  }
  return sum;
}

// Called when the present state is the last one.
void SurfaceHistory::keepWithinBound() {
  constexpr std::size_t kAlwaysKept = 3;
  while (states_.size() > kAlwaysKept && bytes() > most_bytes_) {
    states_.erase(std::next(states_.begin()));
    --present_;
    ++let_go_;
  }
}

}  // namespace gyre
