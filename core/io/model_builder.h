// Collects vertices and faces while a file is read, and checks them at its end.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/io/model_file.h"

namespace gyre {

// What a file may tell of one vertex.
struct ModelVertex {
  MeshVertex vertex;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // mm^2
};

class ModelBuilder {
 public:
  std::vector<ModelVertex> vertices;

  // Adds a polygon as a fan of triangles; corners may be checked later than they are added. Faces
  // with fewer than three corners have no surface and are passed over.
  void addFace(std::span<const std::uint32_t> corners);

  bool hasFaces() const { return !triangles_.empty(); }

  // The finished model, or what is wrong with it: "has no points", ... The builder is then empty.
  struct Outcome {
    Model model;
    std::optional<std::string> problem;
  };
  Outcome finish();

 private:
  std::vector<Triangle> triangles_;
};

}  // namespace gyre
