// Scans in a row over a wire on which one exchange in fifty goes wrong: none hangs, none loses a
// view, none grows the program.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/base/clock.h"
#include "core/base/units.h"
#include "core/device/protocol_turntable.h"
#include "core/device/streaming_camera.h"
#include "core/io/scan_store.h"
#include "core/pipeline/acquire.h"
#include "core/sim/renderer.h"
#include "core/sim/sim_camera.h"
#include "core/sim/turntable_firmware.h"
#include "tests/support/faulty_port.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr int kViews = 12;
constexpr double kSpeed = 100.0;
// An exchange is a question of one byte and an answer of some sixty: a fault in one byte of 3000
// spoils one exchange in fifty.
constexpr double kFault = 1.0 / 6000.0;  // lost, and as many corrupted
constexpr double kLongest_s = 60.0;      // of one scan, its interruptions included
constexpr int kInterruptions = 5;        // of one scan; each is explained and gone on after
// After the first scans, what the program keeps is kept.
constexpr int kWarmUp = 3;
constexpr double kGrowth_mb = 12.0;

double residentMb() {
  std::ifstream statm("/proc/self/statm");
  long pages = 0;
  long resident = 0;
  statm >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

// A rig whose table is at the far end of a bad wire.
class Room {
 public:
  explicit Room(const std::shared_ptr<const Renderer>& renderer)
      : renderer_(renderer),
        shaft_(std::make_shared<Shaft>()),
        firmware_({}, shaft_, SimClock(kSpeed)) {
    auto source = std::make_unique<SimCamera>(renderer_, shaft_, SimClock(kSpeed));
    source->setTable(TableLoad::kObject);
    StreamingCameraOptions patient;
    patient.silence_s = 30.0;
    patient.patience_s = 60.0;
    camera_ = std::make_unique<StreamingCamera>(std::move(source), patient);
  }

  // The turntable as a program finds it that opens the port anew.
  Result<std::unique_ptr<ProtocolTurntable>> connect(std::uint64_t seed) {
    Faults faults;
    faults.seed = seed;
    faults.drop = kFault;
    faults.corrupt = kFault;
    return ProtocolTurntable::open(std::make_unique<FaultyPort>(firmware_.openPort(), faults), {},
                                   {});
  }

  Camera& camera() { return *camera_; }
  std::int64_t steps() const { return shaft_->steps(); }

 private:
  std::shared_ptr<const Renderer> renderer_;
  std::shared_ptr<Shaft> shaft_;
  TurntableFirmware firmware_;
  std::unique_ptr<StreamingCamera> camera_;
};

struct Tally {
  int interruptions = 0;
  std::string sentences;
};

// Captures all views, however often that is interrupted; the truth tells where the table stands.
void scanOnce(const std::shared_ptr<const Renderer>& renderer, const std::filesystem::path& folder,
              std::uint64_t seed, Tally& tally) {
  Room room(renderer);
  ScanSettings settings;
  settings.views = kViews;
  ASSERT_TRUE(ScanStore::create(folder, settings, trueCalibration(renderer->rig())));
  for (int attempt = 0; attempt <= kInterruptions; ++attempt) {
    auto store = ScanStore::open(folder);
    ASSERT_TRUE(store) << store.error().sentence();
    if (store->complete()) return;
    auto turntable = room.connect(seed * 100 + static_cast<std::uint64_t>(attempt));
    Result<void> done = turntable ? (*turntable)
                                        ->setAngle(kTurn_rad * static_cast<double>(room.steps()) /
                                                   renderer->rig().steps_per_turn)
                                  : Result<void>(turntable.error());
    if (done) done = acquire(**turntable, room.camera(), *store, [](const FramePtr&) {}, {});
    if (done) continue;
    ++tally.interruptions;
    tally.sentences += done.error().sentence() + "\n";
    EXPECT_FALSE(done.error().what.empty());
    EXPECT_FALSE(done.error().advice.empty()) << done.error().what;
  }
  FAIL() << "interrupted more than " << kInterruptions << " times:\n" << tally.sentences;
}

TEST(FaultyScans, LoseNoViewAndNoMemory) {
  const char* asked = std::getenv("GYRE_SCANS");
  const int scans = asked != nullptr ? std::atoi(asked) : 6;
  RigSettings small = atImageWidth(RigSettings{}, 160);
  const auto renderer = std::make_shared<const Renderer>(small);
  Tally tally;
  double settled_mb = 0.0;
  double slowest_s = 0.0;
  for (int scan = 0; scan < scans; ++scan) {
    SCOPED_TRACE("scan " + std::to_string(scan));
    const TempDir dir;
    const double start_s = steadySeconds();
    scanOnce(renderer, dir / "scan", static_cast<std::uint64_t>(scan) + 1, tally);
    if (HasFatalFailure()) return;
    slowest_s = std::max(slowest_s, steadySeconds() - start_s);
    const auto store = ScanStore::open(dir / "scan");
    ASSERT_TRUE(store && store->complete());
    for (const CapturedView& view : store->views()) {
      const Frame truth = renderer->render(
          std::lround(static_cast<double>(small.steps_per_turn) * view.view / kViews),
          TableLoad::kObject);
      const auto kept = store->readView(view);
      ASSERT_TRUE(kept);
      EXPECT_TRUE(std::equal(truth.image_bgr.datastart, truth.image_bgr.dataend,
                             (*kept)->image_bgr.datastart))
          << "view " << view.view << " shows the table elsewhere";
    }
    if (scan == kWarmUp) settled_mb = residentMb();
  }
  EXPECT_LT(slowest_s, kLongest_s);
  if (scans > kWarmUp + 1) {
    EXPECT_LT(residentMb() - settled_mb, kGrowth_mb);
  }
  RecordProperty("interruptions", tally.interruptions);
  RecordProperty("slowest_scan_ms", static_cast<int>(slowest_s * 1000));
  RecordProperty("growth_kb", static_cast<int>((residentMb() - settled_mb) * 1000));
  std::printf("%d scans, %d interruptions, slowest %.1f s, memory %+.1f MB\n%s", scans,
              tally.interruptions, slowest_s, residentMb() - settled_mb, tally.sentences.c_str());
}

}  // namespace
}  // namespace gyre
