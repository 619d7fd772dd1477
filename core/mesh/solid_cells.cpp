// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/solid_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "core/mesh/edges.h"

namespace gyre {
namespace {

constexpr int kMaxRounds = 40;
// After so many rounds places undo each other's changes: from then on what is free is filled, which
// comes to an end.
constexpr int kGentleRounds = 8;

double volumeOf(const Tetrahedra& tetrahedra, std::uint32_t cell) {
  if (tetrahedra.isInfinite(cell)) return std::numeric_limits<double>::infinity();
  const auto& [a, b, c, d] = tetrahedra.corners[cell];
  const auto& points = tetrahedra.points;
  return std::abs((points[b] - points[a]).cross(points[c] - points[a]).dot(points[d] - points[a])) /
         6.0;
}

// Spreads from `cell` over the sides that join(cell, neighbour) lets pass; calls visit(cell).
template <class Join, class Visit>
void spread(const Tetrahedra& tetrahedra, std::uint32_t cell, const Join& join,
            const Visit& visit) {
  std::vector<std::uint32_t> open = {cell};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    visit(at);
    for (const std::uint32_t next : tetrahedra.neighbours[at]) {
      if (join(next)) open.push_back(next);
    }
  }
}

// The cells around a point or an edge, in pieces of one kind that hang together by sides there.
class Umbrella {
 public:
  // cells: ascending, all those with the corners `axis`.
  Umbrella(const Tetrahedra& tetrahedra, std::vector<std::uint32_t> cells,
           std::span<const std::uint32_t> axis, const SolidCells& solid)
      : tetrahedra_(tetrahedra), cells_(std::move(cells)), axis_(axis) {
    piece_.assign(cells_.size(), -1);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (piece_[i] >= 0) continue;
      is_solid_.push_back(solid[cells_[i]]);
      volume_.push_back(0.0);
      gather(i, solid);
    }
  }

  // The smallest piece of a kind that has several; -1 when the wall is a disc here.
  int toFlip() const {
    int flip = -1;
    for (const char kind : {char{0}, char{1}}) {
      int smallest = -1;
      int count = 0;
      for (int piece = 0; piece < static_cast<int>(volume_.size()); ++piece) {
        if (is_solid_[static_cast<std::size_t>(piece)] != kind) continue;
        ++count;
        if (smallest < 0 || volumeOfPiece(piece) < volumeOfPiece(smallest)) smallest = piece;
      }
      if (count < 2) continue;
      if (flip < 0 || volumeOfPiece(smallest) < volumeOfPiece(flip)) flip = smallest;
    }
    return flip;
  }

  // The smallest free piece that does not reach infinity; -1 when there is none.
  int toFill() const {
    int smallest = -1;
    for (int piece = 0; piece < static_cast<int>(volume_.size()); ++piece) {
      if (is_solid_[static_cast<std::size_t>(piece)] || std::isinf(volumeOfPiece(piece))) continue;
      if (smallest < 0 || volumeOfPiece(piece) < volumeOfPiece(smallest)) smallest = piece;
    }
    return smallest;
  }

  template <class Visit>
  void forCellsOf(int piece, const Visit& visit) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (piece_[i] == piece) visit(cells_[i]);
    }
  }

 private:
  double volumeOfPiece(int piece) const { return volume_[static_cast<std::size_t>(piece)]; }

  void gather(std::size_t first, const SolidCells& solid) {
    const int piece = static_cast<int>(volume_.size()) - 1;
    std::vector<std::size_t> open = {first};
    piece_[first] = piece;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      volume_.back() += volumeOf(tetrahedra_, cells_[at]);
      for (std::size_t side = 0; side < 4; ++side) {
        const std::uint32_t opposite = tetrahedra_.corners[cells_[at]][side];
        if (std::find(axis_.begin(), axis_.end(), opposite) != axis_.end()) continue;  // leads away
        const std::uint32_t next = tetrahedra_.neighbours[cells_[at]][side];
        const auto found = std::lower_bound(cells_.begin(), cells_.end(), next);
        const auto place = static_cast<std::size_t>(found - cells_.begin());
        if (piece_[place] >= 0 || solid[next] != is_solid_.back()) continue;
        piece_[place] = piece;
        open.push_back(place);
      }
    }
  }

  const Tetrahedra& tetrahedra_;
  std::vector<std::uint32_t> cells_;
  std::span<const std::uint32_t> axis_;
  std::vector<int> piece_;      // of each cell
  std::vector<char> is_solid_;  // of each piece
  std::vector<double> volume_;  // of each piece
};

class ManifoldMaker {
 public:
  ManifoldMaker(const Tetrahedra& tetrahedra, SolidCells& solid)
      : tetrahedra_(tetrahedra), around_(tetrahedra), solid_(solid) {
    touched_.resize(tetrahedra.points.size());
    std::iota(touched_.begin(), touched_.end(), 0U);
  }

  std::size_t run() {
    for (round_ = 0; round_ < kMaxRounds && !touched_.empty(); ++round_) {
      const std::vector<std::uint32_t> suspects = std::exchange(touched_, {});
      for (const std::uint32_t point : suspects) mend(cellsAround(point), std::array{point});
      if (touched_.empty()) mendEdges();
      std::sort(touched_.begin(), touched_.end());
      touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    }
    return touched_.size();
  }

 private:
  std::vector<std::uint32_t> cellsAround(std::uint32_t point) const {
    const auto cells = around_.of(point);
    return {cells.begin(), cells.end()};
  }

  void mend(std::vector<std::uint32_t> cells, std::span<const std::uint32_t> axis) {
    const Umbrella umbrella(tetrahedra_, std::move(cells), axis, solid_);
    int flip = umbrella.toFlip();
    if (flip < 0) return;
    if (round_ >= kGentleRounds && umbrella.toFill() >= 0) flip = umbrella.toFill();
    umbrella.forCellsOf(flip, [&](std::uint32_t cell) {
      solid_[cell] = solid_[cell] ? 0 : 1;
      for (const std::uint32_t corner : tetrahedra_.corners[cell]) {
        if (corner != Tetrahedra::kInfinity) touched_.push_back(corner);
      }
    });
  }

  // A handle pinched along an edge is a disc at both of its ends.
  void mendEdges() {
    forEachEdge(edgeUses(wallOf(tetrahedra_, solid_)), [&](auto begin, auto end) {
      if (end - begin <= 2) return;
      const std::array axis = {begin->low, begin->high};
      const auto low = around_.of(begin->low);
      const auto high = around_.of(begin->high);
      std::vector<std::uint32_t> cells;
      std::set_intersection(low.begin(), low.end(), high.begin(), high.end(),
                            std::back_inserter(cells));
      mend(std::move(cells), axis);
    });
  }

  const Tetrahedra& tetrahedra_;
  CellsAround around_;
  SolidCells& solid_;
  int round_ = 0;
  std::vector<std::uint32_t> touched_;  // points whose cells have changed
};

}  // namespace

void fillCavities(const Tetrahedra& tetrahedra, SolidCells& solid) {
  std::vector<char> reached(solid.size(), 0);
  for (std::uint32_t cell = 0; cell < solid.size(); ++cell) {
    if (!tetrahedra.isInfinite(cell) || reached[cell]) continue;
    reached[cell] = 1;
    spread(
        tetrahedra, cell,
        [&](std::uint32_t next) {
          if (reached[next] || solid[next]) return false;
          reached[next] = 1;
          return true;
        },
        [](std::uint32_t) {});
  }
  for (std::size_t cell = 0; cell < solid.size(); ++cell) solid[cell] = reached[cell] ? 0 : 1;
}

void freeCrumbs(const Tetrahedra& tetrahedra, double min_share, SolidCells& solid) {
  std::vector<std::uint32_t> piece_of(solid.size(), 0);
  std::vector<double> volume = {0.0};  // of each piece; piece 0 is what is free
  for (std::uint32_t cell = 0; cell < solid.size(); ++cell) {
    if (!solid[cell] || piece_of[cell] != 0) continue;
    const auto piece = static_cast<std::uint32_t>(volume.size());
    volume.push_back(0.0);
    piece_of[cell] = piece;
    spread(
        tetrahedra, cell,
        [&](std::uint32_t next) {
          if (!solid[next] || piece_of[next] != 0) return false;
          piece_of[next] = piece;
          return true;
        },
        [&](std::uint32_t at) { volume.back() += volumeOf(tetrahedra, at); });
  }
  const double least = min_share * *std::max_element(volume.begin(), volume.end());
  for (std::size_t cell = 0; cell < solid.size(); ++cell) {
    if (solid[cell] && volume[piece_of[cell]] < least) solid[cell] = 0;
  }
}

std::size_t makeManifold(const Tetrahedra& tetrahedra, SolidCells& solid) {
  return ManifoldMaker(tetrahedra, solid).run();
}

std::vector<Triangle> wallOf(const Tetrahedra& tetrahedra, const SolidCells& solid) {
  std::vector<Triangle> wall;
  for (std::uint32_t cell = 0; cell < solid.size(); ++cell) {
    if (!solid[cell]) continue;
    for (int side = 0; side < 4; ++side) {
      if (!solid[tetrahedra.neighbours[cell][static_cast<std::size_t>(side)]]) {
        wall.push_back(tetrahedra.side(cell, side));
      }
    }
  }
  return wall;
}

}  // namespace gyre
