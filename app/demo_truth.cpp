// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/demo_truth.h"

#include <filesystem>
#include <iomanip>
#include <sstream>
#include <vector>

#include "core/base/units.h"
#include "core/io/atomic_file.h"
#include "core/io/calibration_file.h"
#include "core/io/json_text.h"
#include "core/io/ply.h"
#include "core/mesh/compare.h"
#include "core/sim/rig_json.h"
#include "core/sim/truth.h"

namespace gyre {
namespace {

// The share of the size within which seen surface counts as covered by a point.
constexpr double kCoverShare = 0.02;

// {calibration, angles_deg {picture: deg}, size_mm, seed, rig}
std::string truthJson(const RigSettings& rig, const ScanStore& store, double size_mm) {
  std::ostringstream text;
  text << "{\n\"calibration\": " << calibrationText(trueCalibration(rig)) << ",\n\"angles_deg\": {";
  const char* comma = "";
  for (const CapturedView& view : store.views()) {
    text << comma << "\n  " << jsonString(std::filesystem::path(view.file).filename().string())
         << ": " << jsonNumber(degFromRad(trueAngleRad(rig, view.steps)));
    comma = ",";
  }
  text << "\n},\n\"size_mm\": " << jsonNumber(size_mm) << ",\n\"seed\": " << rig.seed
       << ",\n\"rig\": " << rigToJson(rig) << "\n}\n";
  return text.str();
}

std::vector<std::int64_t> stepsOf(const std::vector<CapturedView>& views) {
  std::vector<std::int64_t> steps;
  steps.reserve(views.size());
  for (const CapturedView& view : views) steps.push_back(view.steps);
  return steps;
}

}  // namespace

Result<Judgement> judgeDemo(const Renderer& renderer, const ScanStore& store,
                            const Reconstruction& reconstruction, const Task& task) {
  task.report(0.0, "Working out the truth");
  const auto truth = truthOf(renderer, stepsOf(store.views()), task.part(0.0, 0.6));
  if (!truth) return truth.error();
  const std::filesystem::path& folder = store.folder();
  if (const auto done = writePly(folder / "truth.ply", truth->mesh, MeshKind::kTruth); !done) {
    return done.error();
  }
  const std::string json = truthJson(renderer.rig(), store, truth->size_mm);
  if (const auto done = writeFileAtomically(folder / "truth.json", json); !done) {
    return done.error();
  }
  Judgement judgement;
  judgement.size_mm = truth->size_mm;
  if (reconstruction.cloud.points.empty()) return judgement;
  CompareOptions options = judgingOptions(truth->mesh);
  options.at_mm = {kCoverShare * truth->size_mm};
  task.report(0.6, "Measuring against the truth");
  const auto measured = compareSurfaces(meshOfPoints(reconstruction.cloud), truth->mesh, options,
                                        task.part(0.6, 1.0));
  // Points that all lie where nothing can be judged are not a failure of the scan.
  if (!measured && measured.error().code == Error::Code::kCancelled) return measured.error();
  if (measured) judgement.points = *measured;
  return judgement;
}

std::string judgementText(const Judgement& judgement) {
  if (judgement.points.samples == 0) return "No point could be measured against the truth.";
  const auto share = [&](double mm) { return 100.0 * mm / judgement.size_mm; };
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "Against the truth: median "
       << judgement.points.median_mm << " mm (" << share(judgement.points.median_mm)
       << " % of the size of " << std::setprecision(1) << judgement.size_mm << " mm), 95 % within "
       << std::setprecision(3) << judgement.points.p95_mm << " mm ("
       << share(judgement.points.p95_mm) << " %); " << std::setprecision(1)
       << 100.0 * judgement.points.at.at(0).completeness
       << " % of the seen surface has a point within " << judgement.points.at.at(0).d_mm << " mm.";
  return text.str();
}

}  // namespace gyre
