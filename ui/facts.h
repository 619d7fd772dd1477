// What the window is told of a scan: plain facts, shown as they are.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <QDateTime>
#include <QString>

namespace gyre {

// Where a scan stands. The window offers only what is possible there.
enum class ScanPhase {
  kIdle,        // nothing is connected
  kConnecting,  // table and camera are being opened
  kReady,       // both answer; a scan can start
  kEmptyTable,  // the picture of the bare table is being taken
  kQuickLook,   // the table turns once, for a few pictures around the object
  kScanning,
  kPaused,
  kStopping,   // the table slows down; the last view is being written
  kFinishing,  // all views are captured; the points are refined
  kMeshing,
  kMerging,  // passes are laid on each other
  kDone,
  kFailed,  // what was captured is on the disk
};

constexpr bool isCapturing(ScanPhase phase) {
  return phase == ScanPhase::kScanning || phase == ScanPhase::kPaused ||
         phase == ScanPhase::kStopping;
}

struct ScanFacts {
  int views_done = 0;
  int views = 0;
  double elapsed_s = 0.0;
  std::optional<double> left_s;
  std::size_t points = 0;
  std::optional<double> median_sigma_mm;
};

// What a scan takes, before it is begun.
struct ScanCost {
  double turn_s = 0.0;            // of turning, however many views there are
  double view_s = 0.0;            // more for each view
  double view_mb = 0.0;           // on the disk, at most
  double results_mb = 0.0;        // once
  std::optional<double> free_mb;  // on that disk; nothing when it is not told
};

enum class Step { kConnect, kFocus, kCalibrate, kPlace, kScan, kMesh, kExport };
inline constexpr std::size_t kStepCount = 7;

enum class StepState { kTodo, kNow, kDone, kAttention };
using StepStates = std::array<StepState, kStepCount>;

// A scan of before, for the start page.
struct RecentScan {
  QString folder;
  QString title;
  QDateTime when;
  double size_mm = 0.0;  // diagonal of the points' bounding box, 0 when unknown
  QString thumbnail;     // file, may be missing
};

// What can be done to the surface's history now.
struct EditFacts {
  QString undo;  // what would be undone, in words; empty: nothing
  QString redo;
  bool previewing = false;  // a clean-up is shown, or is coming, that is not applied
  bool has_before = false;  // there is something to compare with
};

// What can be done with the passes of an object that is turned over between its scans.
struct PassOffer {
  bool finished = false;  // the model shown is a finished scan, or merged from such
  QString with;           // the pass before this one, by name; empty: there is none
};

// How a table without a motor is to be turned. Marks are counted counter-clockwise, from 0.
struct HandTurnFacts {
  long long marks = 0;  // by so many
  bool counter_clockwise = true;
  double mark_deg = 0.0;  // between two marks
  long long to_mark = 0;
  double to_deg = 0.0;
};

// Which side of the preview, or of the last step, the 3D view shows.
enum class EditSide { kBefore, kAfter };

// "1:05", "2:01:05".
QString clockText(double seconds);

}  // namespace gyre
