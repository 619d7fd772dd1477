// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scan_ending.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/io/report.h"

namespace gyre {

void tellResults(Console& console, const Reconstruction& reconstruction,
                 const WrittenResults& written) {
  std::ostringstream text;
  text << reconstruction.cloud.points.size() << " points from " << reconstruction.observations
       << " sightings";
  if (const auto sigma = sigmaPercentiles(reconstruction.cloud)) {
    text << std::fixed << std::setprecision(3) << ", \u00b1 " << sigma->p50_mm << " mm (median)";
  }
  if (reconstruction.turn_gap) {
    text << std::fixed << std::setprecision(2) << ", gap after a full turn "
         << reconstruction.turn_gap->px << " px";
  }
  console.say(text.str() + ".");
  if (reconstruction.drift.firstMoved() != nullptr) {
    console.warn(reconstruction.drift.sentence);
  } else {
    console.note(reconstruction.drift.sentence);
  }
  if (const auto& turning = reconstruction.turning) {
    turning->lostSteps() ? console.warn(turning->sentence) : console.note(turning->sentence);
  }
  if (written.mesh_problem) {
    console.warn("There is no mesh: " + written.mesh_problem->sentence());
  } else if (written.method == MeshMethod::kSilhouette) {
    console.warn(
        "There are too few points for a surface: the mesh is the body that the object's outlines "
        "leave, with its hollows filled.");
  }
  if (!written.mesh.triangles.empty()) {
    console.say("The mesh has " + std::to_string(written.mesh.triangles.size()) + " triangles.");
  }
  for (const auto& [stage, seconds] : reconstruction.seconds) {
    console.note(stage + ": " + secondsText(seconds));
  }
}

void tellDevices(Console& console, Rig& rig) {
  const TurntableInfo turntable = rig.turntable->info();
  console.note("Turntable: " + turntable.firmware);
  for (const std::string& hindrance : turntable.hindrances) console.warn(hindrance);
  const auto camera = rig.camera->lockControls();
  if (!camera) return;  // its first picture will tell
  console.note("Camera: " + camera->description);
  for (const ControlState& control : camera->controls) {
    if (!control.locked) {
      console.warn("The camera's " + control.name + " is not locked. " + control.remark);
    }
  }
}

int endScan(Console& console, const ScanStore& store, const Result<Reconstruction>& reconstruction,
            const Task& task) {
  if (!reconstruction) return failScan(console, store, reconstruction.error());
  const auto written = writeScanResults(store, *reconstruction, task);
  if (!written) return failScan(console, store, written.error());
  tellResults(console, *reconstruction, *written);
  console.say("All files are in " + store.folder().string() + ".");
  const auto enough = enoughPoints(reconstruction->cloud, store.views().size());
  return enough ? static_cast<int>(kDone) : console.fail(enough.error());
}

int failScan(Console& console, const ScanStore& store, const Error& error) {
  const int code = console.fail(error);
  const std::string folder = store.folder().string();
  if (store.complete()) {
    console.warn("All views are kept; `gyre resume " + folder + "` makes the points of them.");
  } else {
    console.warn(std::to_string(store.views().size()) + " of " +
                 std::to_string(store.settings().views) + " views are kept; `gyre resume " +
                 folder + "` goes on.");
    const bool by_hand = store.settings().turntable.starts_with("hand");
    if (error.code == Error::Code::kCancelled && !by_hand) {
      console.warn("The motor was not let go of, so that the table stays where it is.");
    }
  }
  return code;
}

ScanObserver remarksTo(Console& console) {
  ScanObserver observer;
  observer.on_remark = [&console](const std::string& remark) { console.warn(remark); };
  return observer;
}

std::string secondsText(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 120) return std::to_string(whole) + " s";
  return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

}  // namespace gyre
