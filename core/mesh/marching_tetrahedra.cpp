// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/marching_tetrahedra.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gyre {
namespace {

// Of an edge, from either end. Nearer crossings would make needles of no area.
constexpr double kLeastShare = 0.02;

using Corner = Eigen::Array3i;

// The paths along the axes from a cube's first corner to its last; even permutations first, so that
// the tetrahedron (0, first, first + second, all) is right-handed for those.
constexpr std::array<std::array<int, 3>, 6> kPaths = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
constexpr std::size_t kEvenPaths = 3;

std::array<Corner, 4> tetrahedron(const Corner& cube, std::size_t path) {
  std::array<Corner, 4> corners;
  corners.fill(cube);
  for (std::size_t step = 0; step < 3; ++step) {
    for (std::size_t later = step + 1; later < 4; ++later) corners[later][kPaths[path][step]] += 1;
  }
  // All right-handed.
  if (path >= kEvenPaths) std::swap(corners[1], corners[2]);
  return corners;
}

class March {
 public:
  explicit March(const DistanceLattice& lattice) : lattice_(lattice) {}

  Mesh mesh() {
    const Corner last = lattice_.size - 1;
    for (int z = 0; z < last.z(); ++z) {
      for (int y = 0; y < last.y(); ++y) {
        for (int x = 0; x < last.x(); ++x) {
          if (crosses({x, y, z})) addCube({x, y, z});
        }
      }
    }
    computeNormals(mesh_);
    return std::move(mesh_);
  }

 private:
  bool crosses(const Corner& cube) const {
    const bool first = lattice_.inside(cube);
    for (int corner = 1; corner < 8; ++corner) {
      const Corner other = cube + Corner(corner & 1, corner >> 1 & 1, corner >> 2);
      if (lattice_.inside(other) != first) return true;
    }
    return false;
  }

  void addCube(const Corner& cube) {
    for (std::size_t path = 0; path < kPaths.size(); ++path) addCell(tetrahedron(cube, path));
  }

  // Corners inside come first, by an even permutation: then the faces below look outward.
  void addCell(std::array<Corner, 4> c) {
    std::array<bool, 4> in{};
    int inside = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      in[i] = lattice_.inside(c[i]);
      inside += in[i] ? 1 : 0;
    }
    if (inside == 0 || inside == 4) return;
    if (inside == 2) {
      addTwo(c, in);
      return;
    }
    // The one corner that is unlike the three others goes first.
    const bool lone = inside == 1;
    const auto at = static_cast<std::size_t>(std::find(in.begin(), in.end(), lone) - in.begin());
    if (at != 0) {
      std::swap(c[0], c[at]);
      std::swap(c[at == 1 ? 2 : 1], c[at == 3 ? 2 : 3]);
    }
    Triangle triangle = {vertex(c[0], c[1]), vertex(c[0], c[2]), vertex(c[0], c[3])};
    if (!lone) std::swap(triangle[1], triangle[2]);
    mesh_.triangles.push_back(triangle);
  }

  void addTwo(std::array<Corner, 4> c, std::array<bool, 4> in) {
    // Even permutations that bring the two corners inside to the front.
    for (std::size_t turn = 0; turn < 3 && !in[0]; ++turn) {
      std::rotate(c.begin(), c.begin() + 1, c.begin() + 3);
      std::rotate(in.begin(), in.begin() + 1, in.begin() + 3);
    }
    for (std::size_t turn = 0; turn < 3 && !in[1]; ++turn) {
      std::rotate(c.begin() + 1, c.begin() + 2, c.end());
      std::rotate(in.begin() + 1, in.begin() + 2, in.end());
    }
    const std::uint32_t p = vertex(c[0], c[2]);
    const std::uint32_t q = vertex(c[0], c[3]);
    const std::uint32_t r = vertex(c[1], c[3]);
    const std::uint32_t s = vertex(c[1], c[2]);
    mesh_.triangles.push_back({p, q, r});
    mesh_.triangles.push_back({p, r, s});
  }

  // Where the edge crosses zero; made when it is asked for first.
  std::uint32_t vertex(const Corner& a, const Corner& b) {
    const std::size_t low = std::min(lattice_.index(a), lattice_.index(b));
    const std::size_t high = std::max(lattice_.index(a), lattice_.index(b));
    const auto [found, fresh] =
        vertex_of_edge_.try_emplace(static_cast<std::uint64_t>(low) * lattice_.values.size() + high,
                                    static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (fresh) {
      const double at_a = lattice_.value(a);
      const double at_b = lattice_.value(b);
      const double share = std::clamp(at_a / (at_a - at_b), kLeastShare, 1.0 - kLeastShare);
      mesh_.vertices.emplace_back().position =
          lattice_.at(a) + share * (lattice_.at(b) - lattice_.at(a));
    }
    return found->second;
  }

  const DistanceLattice& lattice_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_edge_;
  Mesh mesh_;
};

}  // namespace

Mesh marchingTetrahedra(const DistanceLattice& lattice) { return March(lattice).mesh(); }

}  // namespace gyre
