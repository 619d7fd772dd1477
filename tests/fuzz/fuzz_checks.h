// What a reader must keep to, whatever bytes it is given: a whole model, or a sentence.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/check.h"
#include "core/base/result.h"
#include "core/io/model_file.h"

namespace gyre::fuzz {

inline std::string_view textOf(const std::uint8_t* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

template <class Value>
void checkSentence(const Result<Value>& result) {
  if (result) return;
  GYRE_CHECK(result.error().code == Error::Code::kInvalidInput);
  GYRE_CHECK(result.error().what.ends_with('.'));
  GYRE_CHECK(!result.error().advice.empty());
}

inline void checkModel(const Result<Model>& model) {
  checkSentence(model);
  if (!model) return;
  if (const auto* cloud = std::get_if<PointCloud>(&*model)) {
    GYRE_CHECK(!cloud->points.empty());
    for (const Point& point : cloud->points) {
      GYRE_CHECK(point.position.allFinite() && point.normal.allFinite());
      GYRE_CHECK(point.covariance.allFinite());
    }
    return;
  }
  const Mesh& mesh = std::get<Mesh>(*model);
  GYRE_CHECK(!mesh.triangles.empty());
  for (const MeshVertex& vertex : mesh.vertices) {
    GYRE_CHECK(vertex.position.allFinite() && vertex.normal.allFinite());
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) GYRE_CHECK(corner < mesh.vertices.size());
  }
}

}  // namespace gyre::fuzz
