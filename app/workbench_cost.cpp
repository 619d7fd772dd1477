// What the scan that is set up in the window will take: time and room on the disk.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>

#include "app/workbench.h"
#include "core/io/free_space.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

// Beside the turning itself each view costs a ramp up and down and a picture of the standing table.
constexpr double kSecondsPerView = 0.45;
constexpr double kSecondsByHand = 8.0;  // a person reads, turns and answers
constexpr double kMegabyte = 1e6;

double megabytes(std::uintmax_t bytes) { return static_cast<double>(bytes) / kMegabyte; }

}  // namespace

void Workbench::showCost() {
  const DeviceSession& devices = controller_.devices();
  if (!devices.isOpen()) return;
  const bool by_hand = devices.turnedByHand();
  ScanCost cost;
  cost.turn_s = by_hand ? 0.0 : 360.0 / devices.options().turntable.speed_deg_per_s;
  cost.view_s = by_hand ? kSecondsByHand : kSecondsPerView;
  cost.results_mb = megabytes(bytesForScan(0, picture_size_));
  cost.view_mb = megabytes(bytesForScan(1, picture_size_)) - cost.results_mb;
  // A disk on a network may take its time to answer.
  auto available = std::make_shared<std::optional<std::uintmax_t>>();
  small_jobs_.start(
      [available, folder = window_.work_page->scan_panel->folder().toStdString()](
          const Task&) -> Result<void> {
        *available = freeBytesAt(folder);
        return {};
      },
      [this, available, cost](const Result<void>&) mutable {
        if (*available) cost.free_mb = megabytes(**available);
        window_.work_page->scan_panel->showCost(cost);
      });
}

}  // namespace gyre
