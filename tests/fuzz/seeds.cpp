// Writes the files from which fuzzing starts, by the program's own writers: seeds FOLDER
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/atomic_file.h"
#include "core/io/calibration_file.h"
#include "core/io/calibration_record_file.h"
#include "core/io/measurements_file.h"
#include "core/io/obj.h"
#include "core/io/passes_file.h"
#include "core/io/ply.h"
#include "core/io/result_folder.h"
#include "core/io/stl.h"
#include "tests/support/model_samples.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

// What other programs write and ours does not.
constexpr std::string_view kTextPly =
    "ply\nformat ascii 1.0\nobj_info a\nelement vertex 3\nproperty double x\nproperty float y\n"
    "property int z\nproperty uchar diffuse_red\nproperty list uchar short more\n"
    "element face 1\nproperty list uint8 uint32 vertex_index\nelement edge 1\nproperty char a\n"
    "end_header\n0 0 0 255 1 7\n+1.5 0 0 0 0\n0 1e-3 -2 9 2 1 1\n3 0 1 2\n5\n";
constexpr std::string_view kTextObj =
    "mtllib a.mtl\r\no Cube\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 1 0 0\nv 0 1 0 1.0 0 1 0\nvt 0 0\n"
    "vn 0 0 2\ns off\nf 1/1/1 2/1/1 3/1/1 \\\n 4/1/1\nf -4//-1 -3//1 -2//1\nf 1/1 2/1 4/1 # a\n";
constexpr std::string_view kTextStl =
    "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.5e0 0 0\nvertex +1 1 -0\n"
    "endloop\nendfacet\nendsolid a b\nsolid\nfacet normal nan 0 0 outer loop vertex 0 0 5 "
    "vertex 1 0 5 vertex 1 1 5 vertex 0 1 5 endloop endfacet\nendsolid";
constexpr std::string_view kTextAngles =
    "\xEF\xBB\xBFimage,angle_deg\r\n\r\n\"b,\"\"2.png\",-7.2\r\n a1.png , +3.6 \r\na10.png,1.8e2";

std::string bigEndian(std::string ply) {
  const std::string_view little = "little";
  return ply.replace(ply.find(little), little.size(), "big");
}

Result<void> writeModels(const fs::path& folder) {
  auto done = writePly(folder / "ply/cloud", sampleCloud());
  if (done) done = writePly(folder / "ply/mesh", sampleMesh());
  if (done) done = writePly(folder / "ply/truth", sampleMesh(), MeshKind::kTruth);
  if (done) done = writeFileAtomically(folder / "ply/big", bigEndian(plyBytes(sampleMesh())));
  if (done) done = writeFileAtomically(folder / "ply/text", kTextPly);
  if (done) done = writeObj(folder / "obj/mesh", sampleMesh());
  if (done) done = writeFileAtomically(folder / "obj/text", kTextObj);
  if (done) done = writeStl(folder / "stl/mesh", sampleMesh());
  if (done) done = writeFileAtomically(folder / "stl/text", kTextStl);
  return done;
}

CalibrationRecord sampleRecord() {
  CalibrationRecord record;
  CameraModel& camera = record.calibration.camera;
  camera.width_px = 1280;
  camera.height_px = 960;
  camera.fx = camera.fy = 1500.0;
  camera.cx = 639.5;
  camera.cy = 479.5;
  camera.k1 = -0.08;
  record.calibration.cam_from_table = Rigid3{};
  record.date = "2026-01-01T12:00:00Z";
  record.target = "wedge";
  CalibrationReport report;
  report.sentence = "Acceptable.";
  report.remarks = {"one", "two \\ three"};
  report.once_per_turn = {0.1, -2.0};
  report.angles_rad = {0.0, 1.0 / 3.0};
  report.faces = {{0.5, 0.01, 0.2, 36}};
  report.residuals = {{3, 17, {1.5, 2.25}, {0.1, -0.05}, false}};
  record.report = report;
  record.covariance = NamedCovariance{{"fx_px", "k1"}, Eigen::Matrix2d::Identity()};
  record.table_from_target = Rigid3{};
  record.points_in_target = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.5}};
  record.turntable = CalibratedTurntable{"usb-1", "X", 360.0, -1};
  record.camera = CalibratedCamera{"cam", "1920x1080@MJPG", {{"focus", 12.0}}};
  return record;
}

std::vector<Measurement> sampleMeasurements() {
  Measurement known;
  known.to_in_table = {3.0, -4.0, 12.0};
  known.length_mm = 13.0;
  known.points_sigma_mm = 0.01;
  known.scale_sigma_mm = 1.0 / 3.0;
  known.size = SizeTrust::kVerified;
  known.caliper_mm = 13.05;
  known.note = "lid \"to\" base, 2 \\ 3";
  known.date = "2026-01-01T12:00:00Z";
  Measurement unknown;
  unknown.from_in_table = {1.0, 0.0, 0.0};
  unknown.length_mm = 1.0;
  return {known, unknown};
}

std::vector<ScanPass> samplePasses() {
  ScanPass first;
  first.name = "pass-1";
  first.folder = "up";
  first.views = 72;
  ScanPass second = first;
  second.name = "pass-2";
  second.folder = "../over";
  second.merged_from_pass.translation = {1.0, 2.0, -1.0 / 3.0};
  second.fit = PassFit{40, 0.1, 0.6, 0.013};
  return {first, second};
}

// Nobody but people writes these.
constexpr const char* kTurntable = R"({"format": "gyre-turntable", "version": 1, "name": "Mine",
  "baud": 9600, "line_end": "\r\n", "answer_ends": ";", "greeting": "hello",
  "ask": {"send": "WHO", "answer": "Mine"}, "unit": "degrees", "units_per_turn": 360, "decimals": 2,
  "direction": -1, "motor_on": {"send": "ON", "answer": "OK"},
  "motor_off": {"send": "OFF", "answer": "OK"},
  "move": {"send": "TURN {by} {speed}", "done": "DONE", "refused": "ERR", "busy": "WAIT"},
  "stop": {"send": "STOP", "answer": "STOPPED"}})";

Result<void> writeOthers(const fs::path& folder) {
  const CalibrationRecord record = sampleRecord();
  Calibration handheld = record.calibration;
  handheld.cam_from_table.reset();
  auto done = writeCalibrationRecord(folder / "calibration/record", record);
  if (done) done = writeCalibration(folder / "calibration/rig", record.calibration);
  if (done) done = writeCalibration(folder / "calibration/handheld", handheld);
  const AngleTable angles = {{"v1.png", 0.0}, {"v2.png", kPi}, {"a, \"b\".png", -0.1}};
  if (done) done = writeAngles(folder / "angles/angles", angles);
  if (done) done = writeFileAtomically(folder / "angles/text", kTextAngles);
  if (done) done = writeFileAtomically(folder / "turntable/whole", kTurntable);
  if (done) done = writeMeasurements(folder / "measurements/two", sampleMeasurements());
  if (done) done = writePasses(folder / "passes/two", samplePasses());
  return done;
}

Result<void> writeSeeds(const fs::path& folder) {
  for (const char* name :
       {"ply", "obj", "stl", "calibration", "angles", "turntable", "measurements", "passes"}) {
    if (auto made = makeResultFolder(folder / name); !made) return made;
  }
  if (auto done = writeModels(folder); !done) return done;
  return writeOthers(folder);
}

}  // namespace
}  // namespace gyre

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: seeds FOLDER\n", stderr);
    return 2;
  }
  const auto done = gyre::writeSeeds(words[1]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().sentence().c_str());
  return done ? 0 : 1;
}
