// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/mesh_actor.h"

#include <algorithm>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkSmartPointer.h>
#include <vtkUniforms.h>
#include <vtkUnsignedCharArray.h>

namespace gyre {
namespace {

// A dark stripe with a light edge shows on every ground. Between stripes the surface is seen.
constexpr const char* kStripes = R"(//VTK::Light::Impl
  float stripe = mod((gl_FragCoord.x + gl_FragCoord.y) / stripe_px, 1.0);
  if (stripe > 0.5) discard;
  vec3 ink = stripe < 0.33 ? vec3(0.08, 0.10, 0.14) : vec3(0.97);
  fragOutput0.rgb = mix(fragOutput0.rgb, ink, 0.85);
)";
// A trifle nearer to the eye than the surface that they lie on.
constexpr const char* kNearer = R"(//VTK::PositionVC::Impl
  gl_Position.z -= 4.0e-6 * gl_Position.w;
)";
constexpr double kStripe_px = 12.0;  // along x

vtkSmartPointer<vtkPolyData> shapeOf(const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkUnsignedCharArray> colours;
  normals->SetNumberOfComponents(3);
  colours->SetNumberOfComponents(3);
  const auto count = static_cast<vtkIdType>(mesh.vertices.size());
  points->SetNumberOfPoints(count);
  normals->SetNumberOfTuples(count);
  colours->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const MeshVertex& vertex = mesh.vertices[static_cast<std::size_t>(i)];
    points->SetPoint(i, vertex.position.data());
    normals->SetTuple(i, vertex.normal.data());
    colours->SetTypedTuple(i, vertex.rgb.data());
  }
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(mesh.triangles.size()),
                       3 * static_cast<vtkIdType>(mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetPolys(cells);
  shape->GetPointData()->SetNormals(normals);
  shape->GetPointData()->SetScalars(colours);
  return shape;
}

// The unseen triangles alone, on the very points of the shape: both are drawn at one depth.
vtkSmartPointer<vtkPolyData> unseenOf(const Mesh& mesh, vtkPolyData& shape) {
  vtkNew<vtkCellArray> cells;
  for (const Triangle& triangle : mesh.triangles) {
    if (std::all_of(triangle.begin(), triangle.end(),
                    [&](std::uint32_t corner) { return mesh.vertices[corner].seen != 0; })) {
      continue;
    }
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  auto unseen = vtkSmartPointer<vtkPolyData>::New();
  unseen->SetPoints(shape.GetPoints());
  unseen->SetPolys(cells);
  unseen->GetPointData()->SetNormals(shape.GetPointData()->GetNormals());
  unseen->GetPointData()->SetScalars(shape.GetPointData()->GetScalars());
  return unseen;
}

// A speck under the platter: it has the programs for meshes compiled with the first picture.
Mesh speckUnderPlatter() {
  Mesh speck;
  speck.vertices.resize(3);
  for (MeshVertex& vertex : speck.vertices) {
    vertex.position.z() = -0.6;
    vertex.normal.z() = 1.0;
    vertex.seen = 0;
  }
  speck.vertices[1].position.x() = 0.01;
  speck.vertices[2].position.y() = 0.01;
  speck.triangles.push_back({0, 1, 2});
  return speck;
}

}  // namespace

MeshActor::MeshActor(vtkRenderer& renderer) {
  for (vtkActor* actor : {surface_.Get(), hatch_.Get()}) {
    vtkNew<vtkPolyDataMapper> mapper;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetInterpolationToPhong();
    actor->GetProperty()->SetAmbient(0.35);
    actor->GetProperty()->SetDiffuse(0.75);
    renderer.AddActor(actor);
  }
  hatch_->PickableOff();
  hatch_->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, kStripes,
                                                            false);
  hatch_->GetShaderProperty()->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, kNearer,
                                                          false);
  setPixelRatio(1.0);
  fill(speckUnderPlatter());
}

MeshActor::~MeshActor() = default;

void MeshActor::fill(const Mesh& mesh) {
  const vtkSmartPointer<vtkPolyData> shape = shapeOf(mesh);
  const vtkSmartPointer<vtkPolyData> unseen = unseenOf(mesh, *shape);
  unseen_triangles_ = static_cast<std::size_t>(unseen->GetNumberOfPolys());
  vtkPolyDataMapper::SafeDownCast(surface_->GetMapper())->SetInputData(shape);
  vtkPolyDataMapper::SafeDownCast(hatch_->GetMapper())->SetInputData(unseen);
}

void MeshActor::show(const MeshPtr& mesh) {
  surface_->SetVisibility(mesh ? 1 : 0);
  bounds_ = mesh ? boundsOf(*mesh) : Bounds{};
  unseen_triangles_ = 0;
  if (mesh) fill(*mesh);
  showHatch();
}

void MeshActor::setHatching(Hatching hatching) {
  hatching_ = hatching;
  showHatch();
}

void MeshActor::showHatch() { hatch_->SetVisibility(shows() && hatches() ? 1 : 0); }

void MeshActor::setPixelRatio(double ratio) {
  hatch_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
      "stripe_px", static_cast<float>(kStripe_px * ratio));
}

}  // namespace gyre
