// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/solid_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <Eigen/Geometry>

namespace gyre {
namespace {

constexpr int kMaxRounds = 40;

double volumeOf(const Tetrahedra& tetrahedra, std::uint32_t cell) {
  if (tetrahedra.isInfinite(cell)) return std::numeric_limits<double>::infinity();
  const auto& [a, b, c, d] = tetrahedra.corners[cell];
  const auto& points = tetrahedra.points;
  return std::abs(
             (points[b] - points[a]).cross(points[c] - points[a]).dot(points[d] - points[a])) /
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

// The cells around a point, of one kind, in pieces that hang together by sides at the point.
class Umbrella {
 public:
  Umbrella(const Tetrahedra& tetrahedra, std::span<const std::uint32_t> cells,
           std::uint32_t point, const SolidCells& solid)
      : tetrahedra_(tetrahedra), cells_(cells.begin(), cells.end()), point_(point) {
    std::sort(cells_.begin(), cells_.end());
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
        if (tetrahedra_.corners[cells_[at]][side] == point_) continue;  // leads away from it
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
  std::uint32_t point_;
  std::vector<int> piece_;      // of each cell
  std::vector<char> is_solid_;  // of each piece
  std::vector<double> volume_;  // of each piece
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
  const CellsAround around(tetrahedra);
  std::vector<std::uint32_t> suspects(tetrahedra.points.size());
  for (std::uint32_t point = 0; point < suspects.size(); ++point) suspects[point] = point;
  for (int round = 0; round < kMaxRounds && !suspects.empty(); ++round) {
    std::vector<std::uint32_t> touched;
    for (const std::uint32_t point : suspects) {
      const Umbrella umbrella(tetrahedra, around.of(point), point, solid);
      const int flip = umbrella.toFlip();
      if (flip < 0) continue;
      umbrella.forCellsOf(flip, [&](std::uint32_t cell) {
        solid[cell] = solid[cell] ? 0 : 1;
        for (const std::uint32_t corner : tetrahedra.corners[cell]) {
          if (corner != Tetrahedra::kInfinity) touched.push_back(corner);
        }
      });
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    suspects = std::move(touched);
  }
  return suspects.size();
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
