// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/passes_wiring.h"

#include <filesystem>
#include <memory>
#include <vector>

#include "app/merge_job.h"
#include "app/scan_controller.h"
#include "ui/banner.h"
#include "ui/main_window.h"
#include "ui/mesh_panel.h"
#include "ui/passes_card.h"
#include "ui/place_panel.h"
#include "ui/scan_panel.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

// The passes before the one that is scanned next, or is shown; merged ones count for all of theirs.
struct Chain {
  std::vector<fs::path> before;
  fs::path scan;       // empty until it has begun
  bool waits = false;  // for the next scan
};

bool shows(const ScanController& scans, const Chain& chain) {
  return !chain.scan.empty() && chain.scan == scans.folder();
}

PassOffer offerOf(const ScanController& scans, const Chain& chain) {
  PassOffer offer;
  offer.finished = !scans.folder().empty() && scans.mesh() != nullptr;
  if (!shows(scans, chain)) return offer;
  const std::vector<fs::path> passes = passesOf(chain.before);
  offer.with = passes.size() == 1 ? QString::fromStdString(passes.front().filename().string())
                                  : PassesCard::tr("the %n passes before", nullptr,
                                                   static_cast<int>(passes.size()));
  return offer;
}

void beginNextPass(MainWindow& window, ScanController& scans, Chain& chain) {
  WorkPage& page = *window.work_page;
  if (!shows(scans, chain)) chain.before.clear();
  chain.before.push_back(scans.folder());
  chain.scan.clear();
  chain.waits = true;
  const QString next = QString::fromStdString(nextPassFolder(passesOf(chain.before)).string());
  page.scan_panel->setFolder(next);
  page.place_panel->reset();  // the motor was let go of: its angle is not known any more
  scans.turnOver();
  const bool open = scans.devices().isOpen();
  window.showWork(open ? Step::kPlace : Step::kConnect);
  page.banner->showNotice(
      PassesCard::tr("Turn the object over, or lay it on its side."),
      open ? PassesCard::tr("Camera, lamps and calibration stay as they are. While it is off the "
                            "table, take the picture of the empty table again. The new pass is "
                            "kept in %1.")
                 .arg(next)
           : PassesCard::tr("Connect the turntable and the camera of before, with the same "
                            "calibration, and scan it: the new pass is kept in %1.")
                 .arg(next));
}

}  // namespace

void wirePasses(MainWindow& window, ScanController& scans) {
  PassesCard* card = window.work_page->mesh_panel->passes;
  auto chain = std::make_shared<Chain>();
  const auto offer = [card, chain, &scans] { card->showOffer(offerOf(scans, *chain)); };
  QObject::connect(card, &PassesCard::turnOverRequested, &scans,
                   [chain, &window, &scans] { beginNextPass(window, scans, *chain); });
  QObject::connect(card, &PassesCard::mergeRequested, &scans, [chain, &scans] {
    std::vector<fs::path> results = chain->before;
    results.push_back(scans.folder());
    scans.merge(results);
  });
  QObject::connect(card, &PassesCard::mergeWithRequested, &scans, [&scans](const QString& other) {
    scans.merge({scans.folder(), other.toStdString()});
  });
  QObject::connect(card, &PassesCard::stopRequested, &scans, &ScanController::stop);
  QObject::connect(&scans, &ScanController::phaseChanged, card,
                   [chain, offer, banner = window.work_page->banner, &scans](ScanPhase now) {
                     if (now == ScanPhase::kMerging) banner->dismiss();  // it tells of a scan
                     if (now == ScanPhase::kScanning && chain->waits) {
                       chain->scan = scans.folder();
                       chain->waits = false;
                     }
                     offer();
                   });
  QObject::connect(&scans, &ScanController::modelChanged, card, offer);
  QObject::connect(&scans, &ScanController::meshMade, card, offer);
  QObject::connect(&scans, &ScanController::passesKnown, card, &PassesCard::showPasses);
  QObject::connect(&scans, &ScanController::mergeRefused, card, &PassesCard::showRefusal);
}

}  // namespace gyre
