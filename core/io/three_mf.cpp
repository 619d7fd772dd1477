// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/three_mf.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <Model/COM/NMR_DLLInterfaces.h>

#include "core/io/atomic_file.h"
#include "core/io/standing_mesh.h"
#include "core/io/xml_text.h"

namespace gyre {
namespace {

// An object of lib3mf, released at its end.
class Held {
 public:
  Held() = default;
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    if (object_ != nullptr) NMR::lib3mf_release(object_);
  }

  NMR::PLib3MFBase* get() const { return object_; }
  NMR::PLib3MFBase** out() { return &object_; }

 private:
  NMR::PLib3MFBase* object_ = nullptr;
};

// Where lib3mf writes to: it comes back to places that it wrote before.
struct Bytes {
  std::string written;
  std::size_t at = 0;
};

std::uint32_t writeBytes(const unsigned char* source, std::uint32_t count, void* target) {
  auto& [written, at] = *static_cast<Bytes*>(target);
  if (written.size() < at + count) written.resize(at + count);
  std::copy_n(source, count, written.begin() + static_cast<std::ptrdiff_t>(at));
  at += count;
  return 0;
}

std::uint32_t seekBytes(unsigned long long position, void* target) {
  static_cast<Bytes*>(target)->at = static_cast<std::size_t>(position);
  return 0;
}

NMR::MODELMESHCOLOR_SRGB colourOf(const MeshVertex& vertex) {
  return {vertex.rgb[0], vertex.rgb[1], vertex.rgb[2], 255};
}

// Each of these hands a part over to lib3mf and returns false when it was refused.

bool addGeometry(const Mesh& mesh, NMR::PLib3MFBase* object) {
  std::vector<NMR::MODELMESHVERTEX> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const MeshVertex& vertex : mesh.vertices) {
    const Eigen::Vector3f position = vertex.position.cast<float>();
    vertices.push_back({{position.x(), position.y(), position.z()}});
  }
  std::vector<NMR::MODELMESHTRIANGLE> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) triangles.push_back({{a, b, c}});
  return NMR::lib3mf_meshobject_setgeometry(
             object, vertices.data(), static_cast<std::uint32_t>(vertices.size()), triangles.data(),
             static_cast<std::uint32_t>(triangles.size())) == 0;
}

bool addColours(const Mesh& mesh, NMR::PLib3MFBase* object) {
  std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> colours;
  colours.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    colours.push_back({{colourOf(mesh.vertices[a]), colourOf(mesh.vertices[b]),  //
                        colourOf(mesh.vertices[c])}});
  }
  Held of_triangles;
  Held of_object;  // an object whose triangles have colours must have one itself
  return NMR::lib3mf_meshobject_createpropertyhandler(object, of_triangles.out()) == 0 &&
         NMR::lib3mf_propertyhandler_setgradientcolorarray(of_triangles.get(), colours.data()) ==
             0 &&
         NMR::lib3mf_object_createdefaultpropertyhandler(object, of_object.out()) == 0 &&
         NMR::lib3mf_defaultpropertyhandler_setcolor(of_object.get(),
                                                     &colours.front().m_Colors[0]) == 0;
}

bool addPlace(const Mesh& mesh, NMR::PLib3MFBase* model, NMR::PLib3MFBase* object) {
  // Whole millimetres: lib3mf writes six digits in all, and nothing may come to lie below 0.
  const Eigen::Vector3f shift = (-boundsOf(mesh).min).array().ceil().cast<float>();
  NMR::MODELTRANSFORM place = {{{1, 0, 0, shift.x()}, {0, 1, 0, shift.y()}, {0, 0, 1, 0}}};
  Held item;
  return NMR::lib3mf_model_addbuilditem(model, object, &place, item.out()) == 0;
}

bool addText(NMR::PLib3MFBase* model, const char* name, const std::string& text) {
  // lib3mf 1.8 puts the text into its XML as it stands, and reads it so too.
  return text.empty() || NMR::lib3mf_model_addmetadatautf8(model, name, xmlText(text).c_str()) == 0;
}

bool addLabel(const ModelLabel& label, NMR::PLib3MFBase* model) {
  const std::string number =
      label.inventory_number.empty() ? "" : "Inventory number: " + label.inventory_number;
  return addText(model, "Application", "Gyre") && addText(model, "Title", label.title) &&
         addText(model, "Copyright", label.rights) && addText(model, "Description", number);
}

bool writeAll(NMR::PLib3MFBase* model, Bytes& bytes) {
  // lib3mf takes callbacks as plain pointers.
  auto* const write = reinterpret_cast<void*>(&writeBytes);
  auto* const seek = reinterpret_cast<void*>(&seekBytes);
  Held writer;
  return NMR::lib3mf_model_querywriter(model, "3mf", writer.out()) == 0 &&
         NMR::lib3mf_writer_writetocallback(writer.get(), write, seek, &bytes) == 0;
}

}  // namespace

Result<std::string> threeMfBytes(const Mesh& mesh, const ModelLabel& label) {
  const auto standing = standingMesh(mesh);
  if (!standing) return standing.error();
  Bytes bytes;
  Held model;
  Held object;
  const bool done = NMR::lib3mf_createmodel(model.out()) == 0 &&
                    NMR::lib3mf_model_setunit(model.get(), NMR::MODELUNIT_MILLIMETER) == 0 &&
                    NMR::lib3mf_model_addmeshobject(model.get(), object.out()) == 0 &&
                    addGeometry(*standing, object.get()) && addColours(*standing, object.get()) &&
                    addPlace(*standing, model.get(), object.get()) &&
                    addLabel(writableLabel(label), model.get()) && writeAll(model.get(), bytes);
  if (!done) {
    return Error{Error::Code::kInternal, "The surface could not be written as 3MF.",
                 "Export it as STL or PLY."};
  }
  return std::move(bytes.written);
}

Result<void> writeThreeMf(const std::filesystem::path& file, const Mesh& mesh,
                          const ModelLabel& label) {
  const auto bytes = threeMfBytes(mesh, label);
  if (!bytes) return bytes.error();
  return writeFileAtomically(file, *bytes);
}

}  // namespace gyre
