// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/glb.h"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include <tiny_gltf.h>

#include "core/io/atomic_file.h"
#include "core/io/little_endian.h"
#include "core/io/standing_mesh.h"

namespace gyre {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{2} << 30U;
constexpr std::uint64_t kVertexBytes = 12 + 12 + 8;  // position, normal, colour
constexpr std::uint64_t kTriangleBytes = 12;

Eigen::Vector3f yUp(const Eigen::Vector3d& vector) {
  // Adding 0 makes 0 of -0, which the smallest and largest positions must not be told as.
  return Eigen::Vector3d(vector.x(), vector.z(), -vector.y() + 0.0).cast<float>();
}

Eigen::Vector3f positionOf(const MeshVertex& vertex) { return yUp(vertex.position / 1000.0); }

// IEC 61966-2-1, the light that a level of sRGB stands for, in 1/65535.
std::array<std::uint16_t, 256> linearLevels() {
  std::array<std::uint16_t, 256> levels{};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double level = static_cast<double>(i) / 255.0;
    const double light = level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
    levels[i] = static_cast<std::uint16_t>(std::lround(65535.0 * light));
  }
  return levels;
}

void appendVector(std::string& bytes, const Eigen::Vector3f& vector) {
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, vector[i]);
}

// What the accessors of one file are made of: one piece of the buffer each.
class Pieces {
 public:
  explicit Pieces(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  // Appends the bytes and returns the number of the accessor that tells what they are. The
  // accessor's count and types are the caller's to set.
  int add(const std::string& bytes, int target, tinygltf::Accessor accessor) {
    std::vector<unsigned char>& all = model_.buffers.front().data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = all.size();
    view.byteLength = bytes.size();
    view.target = target;
    all.insert(all.end(), bytes.begin(), bytes.end());
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

 private:
  tinygltf::Model& model_;
};

tinygltf::Accessor accessorOf(std::size_t count, int component, int type) {
  tinygltf::Accessor accessor;
  accessor.count = count;
  accessor.componentType = component;
  accessor.type = type;
  return accessor;
}

int addPositions(const Mesh& mesh, Pieces& pieces) {
  auto accessor =
      accessorOf(mesh.vertices.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  Eigen::Vector3f least = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f most = -least;
  std::string bytes;
  for (const MeshVertex& vertex : mesh.vertices) {
    const Eigen::Vector3f position = positionOf(vertex);
    least = least.cwiseMin(position);
    most = most.cwiseMax(position);
    appendVector(bytes, position);
  }
  accessor.minValues = {least.x(), least.y(), least.z()};
  accessor.maxValues = {most.x(), most.y(), most.z()};
  return pieces.add(bytes, TINYGLTF_TARGET_ARRAY_BUFFER, std::move(accessor));
}

int addNormals(const Mesh& mesh, Pieces& pieces) {
  std::string bytes;
  for (const MeshVertex& vertex : mesh.vertices) {
    appendVector(bytes, yUp(vertex.normal.normalized()));
  }
  return pieces.add(
      bytes, TINYGLTF_TARGET_ARRAY_BUFFER,
      accessorOf(mesh.vertices.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3));
}

int addColours(const Mesh& mesh, Pieces& pieces) {
  const auto linear = linearLevels();
  std::string bytes;
  for (const MeshVertex& vertex : mesh.vertices) {
    for (const std::uint8_t level : vertex.rgb) appendLittleEndian(bytes, linear[level]);
    appendLittleEndian(bytes, std::uint16_t{65535});
  }
  auto accessor =
      accessorOf(mesh.vertices.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4);
  accessor.normalized = true;
  return pieces.add(bytes, TINYGLTF_TARGET_ARRAY_BUFFER, std::move(accessor));
}

int addTriangles(const Mesh& mesh, Pieces& pieces) {
  std::string bytes;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) appendLittleEndian(bytes, corner);
  }
  return pieces.add(bytes, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                    accessorOf(3 * mesh.triangles.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                               TINYGLTF_TYPE_SCALAR));
}

// glTF's own default would be a mirror of metal.
tinygltf::Material plainMaterial() {
  tinygltf::Material material;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 1.0;
  material.doubleSided = true;
  return material;
}

tinygltf::Model modelOf(const Mesh& mesh, const ModelLabel& label) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Gyre";
  model.asset.copyright = label.rights;
  if (!label.inventory_number.empty()) {
    model.asset.extras = tinygltf::Value(
        tinygltf::Value::Object{{"inventory_number", tinygltf::Value(label.inventory_number)}});
  }
  Pieces pieces(model);
  tinygltf::Primitive surface;
  surface.mode = TINYGLTF_MODE_TRIANGLES;
  surface.attributes["POSITION"] = addPositions(mesh, pieces);
  surface.attributes["NORMAL"] = addNormals(mesh, pieces);
  surface.attributes["COLOR_0"] = addColours(mesh, pieces);
  surface.indices = addTriangles(mesh, pieces);
  surface.material = 0;
  model.materials.push_back(plainMaterial());
  tinygltf::Mesh& shape = model.meshes.emplace_back();
  shape.name = label.title;
  shape.primitives.push_back(std::move(surface));
  tinygltf::Node& node = model.nodes.emplace_back();
  node.name = label.title;
  node.mesh = 0;
  model.scenes.emplace_back().nodes = {0};
  model.defaultScene = 0;
  return model;
}

}  // namespace

Result<std::string> glbBytes(const Mesh& mesh, const ModelLabel& label) {
  const auto standing = standingMesh(mesh);
  if (!standing) return standing.error();
  const std::uint64_t bytes =
      kVertexBytes * standing->vertices.size() + kTriangleBytes * standing->triangles.size();
  if (bytes > kMostBytes) {
    return Error{Error::Code::kInvalidInput, "The surface has too many triangles for a GLB file.",
                 "Make the surface coarser, or export it as PLY."};
  }
  const tinygltf::Model model = modelOf(*standing, writableLabel(label));
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, stream, false, true) || !stream) {
    return Error{Error::Code::kInternal, "The surface could not be written as GLB.",
                 "Export it as OBJ or PLY."};
  }
  return std::move(stream).str();
}

Result<void> writeGlb(const std::filesystem::path& file, const Mesh& mesh,
                      const ModelLabel& label) {
  const auto bytes = glbBytes(mesh, label);
  if (!bytes) return bytes.error();
  return writeFileAtomically(file, *bytes);
}

}  // namespace gyre
