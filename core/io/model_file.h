// Reads a mesh or a cloud of points from whatever file holds it.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/result.h"
#include "core/scan/mesh.h"
#include "core/scan/point_cloud.h"

namespace gyre {

using Model = std::variant<Mesh, PointCloud>;

// A mesh when the file has faces, else a cloud; by the ending: .ply, .obj or .stl. Positions are
// taken as table frame, mm. Fails on other endings, files without points, and malformed files:
// counts and indices are checked before anything is made of them. What the file does not tell is
// zero, but for the colour, which is then kUncoloured. Of STL equal corners become one vertex,
// with the mean normal of its triangles.
Result<Model> readMeshOrCloud(const std::filesystem::path& file);

// Whether readMeshOrCloud() knows the name's ending.
bool isReadableModel(const std::filesystem::path& file);

// Fails when the file holds points only.
Result<Mesh> readMesh(const std::filesystem::path& file);

// The points, or a mesh's vertices without its faces.
Result<PointCloud> readPointCloud(const std::filesystem::path& file);

// The same from a file's bytes. file: what the sentences call it.
Result<Model> parsePly(std::string_view bytes, const std::string& file);
Result<Model> parseObj(std::string_view bytes, const std::string& file);
Result<Model> parseStl(std::string_view bytes, const std::string& file);

inline constexpr Rgb kUncoloured = {200, 200, 200};

}  // namespace gyre
