// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/clean/draw_in.h"

#include <algorithm>
#include <cstdint>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/mesh/clean/self_intersections.h"

namespace gyre {
namespace {

constexpr double kShortestWay = 0.1;  // what would go less far does not go at all
constexpr double kLeastArea = 1e-3;   // of what a triangle had
constexpr int kMaxRounds = 24;        // then all go back: no skin has been seen to need it
constexpr int kWideRound = 8;         // from here on neighbours go back with them

Eigen::Vector3d twiceArea(const Mesh& mesh, const Triangle& triangle) {
  const Eigen::Vector3d& a = mesh.vertices[triangle[0]].position;
  return (mesh.vertices[triangle[1]].position - a).cross(mesh.vertices[triangle[2]].position - a);
}

class Drawing {
 public:
  Drawing(Mesh& skin, const std::vector<Eigen::Vector3d>& targets)
      : skin_(skin), start_(skin), targets_(targets), share_(skin.vertices.size(), 1.0) {}

  Result<std::vector<double>> run(const Task& task) {
    for (int round = 0; round < kMaxRounds; ++round) {
      task.report(static_cast<double>(round) / kMaxRounds, "Drawing the skin in");
      place();
      std::vector<bool> go_back(skin_.vertices.size(), false);
      markFolds(go_back);
      const auto crossings = findSelfIntersections(skin_, task);
      if (!crossings) return crossings.error();
      for (const auto& [a, b] : *crossings) {
        for (const std::uint32_t t : {a, b}) mark(t, go_back);
      }
      if (round >= kWideRound) markNeighbours(go_back);
      if (!shorten(go_back)) return share_;
    }
    std::fill(share_.begin(), share_.end(), 0.0);
    place();
    return share_;
  }

 private:
  void place() {
    for (std::size_t v = 0; v < share_.size(); ++v) {
      const Eigen::Vector3d& from = start_.vertices[v].position;
      skin_.vertices[v].position = from + share_[v] * (targets_[v] - from);
    }
  }

  void mark(std::uint32_t triangle, std::vector<bool>& go_back) const {
    for (const std::uint32_t corner : skin_.triangles[triangle]) go_back[corner] = true;
  }

  // Triangles that turned over or vanished.
  void markFolds(std::vector<bool>& go_back) const {
    for (std::uint32_t t = 0; t < skin_.triangles.size(); ++t) {
      const Eigen::Vector3d before = twiceArea(start_, skin_.triangles[t]);
      const Eigen::Vector3d now = twiceArea(skin_, skin_.triangles[t]);
      if (now.dot(before) <= 0.0 || now.norm() < kLeastArea * before.norm()) mark(t, go_back);
    }
  }

  void markNeighbours(std::vector<bool>& go_back) const {
    const std::vector<bool> marked = go_back;
    for (std::uint32_t t = 0; t < skin_.triangles.size(); ++t) {
      const auto& [a, b, c] = skin_.triangles[t];
      if (marked[a] || marked[b] || marked[c]) mark(t, go_back);
    }
  }

  // Tells whether any vertex was shortened.
  bool shorten(const std::vector<bool>& go_back) {
    bool any = false;
    for (std::size_t v = 0; v < share_.size(); ++v) {
      if (!go_back[v] || share_[v] == 0.0) continue;
      share_[v] *= 0.5;
      if (share_[v] < kShortestWay) share_[v] = 0.0;
      any = true;
    }
    return any;
  }

  Mesh& skin_;
  const Mesh start_;
  const std::vector<Eigen::Vector3d>& targets_;
  std::vector<double> share_;
};

}  // namespace

Result<std::vector<double>> drawIn(Mesh& skin, const std::vector<Eigen::Vector3d>& targets,
                                   const Task& task) {
  GYRE_CHECK(targets.size() == skin.vertices.size());
  return Drawing(skin, targets).run(task);
}

}  // namespace gyre
