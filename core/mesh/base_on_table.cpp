// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/base_on_table.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "core/base/check.h"
#include "core/base/median.h"
#include "core/mesh/base_facets.h"
#include "core/mesh/unseen_facets.h"
#include "core/mesh/vertex_fans.h"

namespace gyre {
namespace {

// Of the object's size: nothing is seen of a base so near to the table.
constexpr double kBlindShare = 0.025;
constexpr double kLowestQuantile = 0.002;
// Of the way to the middle of a fan, where two fans meet in a vertex.
constexpr double kIntoFan = 0.1;
constexpr double kBelowSpacings = 0.25;  // what reaches farther below is no noise: no table there

double lowestOf(const Mesh& mesh) {
  std::vector<double> heights;
  heights.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) heights.push_back(vertex.position.z());
  const auto at = heights.begin() + static_cast<std::ptrdiff_t>(
                                        kLowestQuantile * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

// Puts the corners of base triangles on feet in the table and walls between both.
class BaseLowering {
 public:
  BaseLowering(Mesh& mesh, std::vector<double>& spacing_mm, const std::vector<std::uint32_t>& base)
      : mesh_(mesh),
        spacing_mm_(spacing_mm),
        base_(base),
        corners_(cornersOf(mesh, base)),
        rim_(rimOf(mesh, base)),
        fans_(findFans(corners_)) {}

  void lower() {
    placeFeet();
    for (std::size_t i = 0; i < base_.size(); ++i) {
      for (std::size_t place = 0; place < 3; ++place) {
        mesh_.triangles[base_[i]][place] = foot_[fans_.of_corner[3 * i + place]];
      }
    }
    for (const DirectedEdge& edge : rim_) {
      const std::uint32_t from_foot = foot_[fans_.at(corners_, edge.of, edge.from)];
      const std::uint32_t to_foot = foot_[fans_.at(corners_, edge.of, edge.to)];
      if (to_foot != edge.to) mesh_.triangles.push_back({edge.from, edge.to, to_foot});
      if (from_foot != edge.from) mesh_.triangles.push_back({edge.from, to_foot, from_foot});
    }
  }

 private:
  // One for each fan: where the base meets itself in a vertex its parts stand on feet of their own,
  // each a little into its part, or the walls would touch. A vertex in the table is its own foot.
  void placeFeet() {
    std::unordered_map<std::uint32_t, int> fans_at;
    for (const std::uint32_t vertex : fans_.vertex) ++fans_at[vertex];
    const std::vector<Eigen::Vector2d> inward = inwardOfFans();
    for (std::size_t fan = 0; fan < fans_.vertex.size(); ++fan) {
      const std::uint32_t vertex = fans_.vertex[fan];
      const bool alone = fans_at[vertex] == 1;
      if (alone && mesh_.vertices[vertex].position.z() == 0.0) {
        foot_.push_back(vertex);
        continue;
      }
      MeshVertex foot = mesh_.vertices[vertex];
      foot.position.z() = 0.0;
      if (!alone) foot.position.head<2>() += kIntoFan * inward[fan];
      foot.views = 0;
      foot.seen = 0;
      foot_.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
      mesh_.vertices.push_back(foot);
      spacing_mm_.push_back(spacing_mm_[vertex]);
    }
  }

  // From each fan's vertex to the middle of its triangles' middles, seen from above. [mm]
  std::vector<Eigen::Vector2d> inwardOfFans() const {
    std::vector<Eigen::Vector2d> inward(fans_.vertex.size(), Eigen::Vector2d::Zero());
    std::vector<double> count(fans_.vertex.size(), 0.0);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const std::uint32_t corner : corners_[i]) middle += flat(corner) / 3.0;
      for (std::size_t place = 0; place < 3; ++place) {
        const std::uint32_t fan = fans_.of_corner[3 * i + place];
        inward[fan] += middle - flat(corners_[i][place]);
        count[fan] += 1.0;
      }
    }
    for (std::size_t fan = 0; fan < inward.size(); ++fan) inward[fan] /= count[fan];
    return inward;
  }
  Eigen::Vector2d flat(std::uint32_t vertex) const {
    return mesh_.vertices[vertex].position.head<2>();
  }

  Mesh& mesh_;
  std::vector<double>& spacing_mm_;
  const std::vector<std::uint32_t>& base_;
  const std::vector<Triangle> corners_;  // of the base, as they were
  const std::vector<DirectedEdge> rim_;
  const VertexFans fans_;
  std::vector<std::uint32_t> foot_;  // the vertex each fan stands on
};

}  // namespace

void restOnTable(Mesh& mesh, std::vector<double>& spacing_mm) {
  GYRE_CHECK(spacing_mm.size() == mesh.vertices.size());
  const double blind_mm = kBlindShare * boundsOf(mesh).diagonal();
  if (mesh.vertices.empty()) return;
  const double lowest_mm = lowestOf(mesh);
  if (lowest_mm > blind_mm || lowest_mm < -kBelowSpacings * median(spacing_mm)) return;
  for (MeshVertex& vertex : mesh.vertices) {
    vertex.position.z() = std::max(vertex.position.z(), 0.0);
  }
  const auto is_wide = [&](const Triangle& triangle) {
    return isWideFacet(mesh, spacing_mm, triangle);
  };
  const std::vector<std::uint32_t> base = baseFacets(mesh, is_wide, blind_mm);
  BaseLowering(mesh, spacing_mm, base).lower();
}

}  // namespace gyre
