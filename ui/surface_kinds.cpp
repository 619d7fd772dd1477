// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/surface_kinds.h"

#include <QCoreApplication>

namespace gyre {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("SurfaceKind", text); }

}  // namespace

SurfaceKind surfaceKind(MeshMethod method) {
  const std::string_view word = wordOf(method);
  if (word == "auto") {
    return {tr("The program's choice"),
            tr("A closed body where it is known from where the points were seen, as after every "
               "scan; else an open surface.")};
  }
  if (word == "closed") {
    return {tr("Closed body"),
            tr("Follows every line of sight: solid where no camera saw through, ready to print.")};
  }
  if (word == "alpha") {
    return {tr("Open where nobody looked"),
            tr("Wraps the points; gaps wider than the gap size stay open.")};
  }
  if (word == "adaptive") {
    return {tr("Open, gaps by density"),
            tr("Likewise, with a gap size that follows the points: small where they are dense, "
               "wide where they are sparse.")};
  }
  if (word == "watertight") {
    return {tr("Closed skin, coarser"),
            tr("Lays a skin around the closed body: always free of crossings, for printers that "
               "refuse the other.")};
  }
  if (word == "poisson") {
    return {tr("Smooth closed body"),
            tr("A smooth skin that follows the points' normals: rounds off edges and bridges what "
               "was not seen.")};
  }
  if (word == "silhouette") {
    return {tr("Body of the outlines"),
            tr("What all outlines of the object leave: for objects too plain for points. Hollows "
               "are filled.")};
  }
  return {QString::fromUtf8(word.data(), static_cast<qsizetype>(word.size())), QString()};
}

std::vector<MeshMethod> offeredSurfaceKinds() {
  std::vector<MeshMethod> kinds;
  kinds.reserve(kMeshMethodWords.size());
  for (const auto& [method, word] : kMeshMethodWords) kinds.push_back(method);
  return kinds;
}

}  // namespace gyre
