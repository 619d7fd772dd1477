// The program with a window.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <QAction>
#include <QApplication>
#include <QFile>
#include <QTemporaryDir>
#include <QTimer>

#include "app/settings.h"
#include "app/workbench.h"
#include "core/sim/object_models.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_wizard/calibration_wizard.h"
#include "ui/clean_panel.h"
#include "ui/device_panel.h"
#include "ui/job_bar.h"
#include "ui/mesh_panel.h"
#include "ui/model_tools.h"
#include "ui/passes_card.h"
#include "ui/scene_canvas.h"
#include "ui/scene_view.h"
#include "ui/theme.h"
#include "ui/work_page.h"

namespace gyre {
namespace {

bool hasDisplay() {
  return qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY") ||
         qEnvironmentVariableIsSet("QT_QPA_PLATFORM");
}

int failWith(const std::string& sentence) {
  std::fprintf(stderr, "gyre: %s\n", sentence.c_str());
  return 1;
}

// The scan of a screenshot: a real one on the simulated rig, but with its clock run fast.
constexpr int kPictureViews = 72;
constexpr double kPictureShare = 0.6;
constexpr double kPictureSpeed = 20.0;
constexpr int kPatience_ms = 600000;

// The wizard's pages among the scenes.
std::optional<WizardStep> wizardStep(const std::string& scene) {
  constexpr std::array<std::pair<const char*, WizardStep>, 4> kPages = {
      {{"target", WizardStep::kTarget},
       {"calibrate", WizardStep::kPlace},
       {"turn", WizardStep::kTurn},
       {"verdict", WizardStep::kResult}}};
  for (const auto& [word, step] : kPages) {
    if (scene == word) return step;
  }
  return std::nullopt;
}

// Cuts the lowest and the highest tenth off, and smooths.
CleanOptions pictureCleaning(const Mesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  const double tenth_mm = 0.1 * (bounds.max.z() - bounds.min.z());
  CleanOptions options;
  options.min_component_share = 0.0;
  options.crop.radius_mm = std::max(bounds.max.x(), bounds.max.y());
  options.crop.z_max_mm = bounds.max.z() - tenth_mm;
  options.smooth.iterations = 5;
  return options;
}

// The two ends of the object along the table's y, as clicks.
std::array<ScenePick, 2> widestPicks(const Mesh& mesh) {
  std::array<ScenePick, 2> picks;
  const auto along = [&](const Triangle& triangle) {
    return mesh.vertices[triangle[0]].position.y();
  };
  const auto [low, high] = std::minmax_element(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const Triangle& a, const Triangle& b) { return along(a) < along(b); });
  const std::array ends = {low, high};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    picks[i].index = static_cast<std::size_t>(ends[i] - mesh.triangles.begin());
    picks[i].position = mesh.vertices[(*ends[i])[0]].position;
  }
  return picks;
}

// Draws the scene and ends the program's event loop with 0, or with 1 when it cannot.
class Photographer final : public QObject {
 public:
  Photographer(Workbench& bench, const GuiOptions& options)
      : bench_(bench),
        file_(QString::fromStdString(options.screenshot.string())),
        scene_(options.scene) {
    bench_.window().show();
    QTimer::singleShot(kPatience_ms, this, [] {
      QApplication::exit(failWith("The scene did not come about within ten minutes."));
    });
    connect(&bench_.controller(), &ScanController::failed, this,
            [](const Error& error) { QApplication::exit(failWith(error.sentence())); });
    if (options.scene == "start") {
      QTimer::singleShot(500, this, [this] { take(); });
      return;
    }
    if (const auto step = wizardStep(options.scene)) {
      showWizard(*step);
      return;
    }
    const QString object = QString::fromStdString(options.object);
    if (options.scene == "focus") {
      showFocus(object);
      return;
    }
    if (options.scene == "place") {
      showPlacing(object);
      return;
    }
    if (options.scene == "doctor") {
      showDoctor();
      return;
    }
    bench_.runDemo(object, kPictureViews, work_.filePath(object));
    if (options.scene == "scan") {
      connect(&bench_.controller(), &ScanController::factsChanged, this,
              [this](const ScanFacts& facts) {
                if (facts.views_done >= kPictureShare * kPictureViews) takeSoon();
              });
    } else {
      connect(&bench_.controller(), &ScanController::meshMade, this, [this] { showSurface(); });
    }
  }

 private:
  // The step in which the object is framed and focused, with the camera locked.
  void showFocus(const QString& object) {
    DeviceSession* devices = &bench_.controller().devices();
    bench_.window().showWork(Step::kFocus);
    connect(devices, &DeviceSession::opened, devices, &DeviceSession::lockCamera);
    connect(devices, &DeviceSession::cameraTold, this, [this] {
      connect(&bench_.calibrations(), &CalibrationController::focusSeen, this,
              [this] { takeSoon(); });
    });
    devices->open("sim:" + object, "sim");
  }
  // The step in which the object is placed, after a quick look at it.
  void showPlacing(const QString& object) {
    ScanController* scans = &bench_.controller();
    bench_.window().showWork(Step::kPlace);
    connect(&scans->devices(), &DeviceSession::opened, scans, &ScanController::takeEmptyTable);
    connect(scans, &ScanController::emptyTableTaken, scans, &ScanController::quickLook);
    connect(scans, &ScanController::quickLookTaken, this, [this](const QuickLookPtr& look) {
      if (look) takeSoon();
    });
    scans->devices().open("sim:" + object, "sim");
  }
  // What is the matter with a port at which there is nothing, and with all others.
  void showDoctor() {
    DevicePanel* panel = bench_.window().work_page->device_panel;
    bench_.window().showWork(Step::kConnect);
    panel->choose("/dev/ttyUSB0", "sim");
    connect(&bench_.doctor(), &Doctor::checked, this, [this] { takeSoon(); });
    Q_EMIT panel->checkRequested(panel->turntable());
  }
  // Called after each pass, and with the merged model.
  void goOnMerging(WorkPage& page) {
    PassesCard* card = page.mesh_panel->passes;
    if (surfaces_ == 1) {
      Q_EMIT card->turnOverRequested();
      Q_EMIT page.job_bar->startRequested();
    } else if (surfaces_ == 2) {
      Q_EMIT card->mergeRequested();
    } else {
      takeSoon();
    }
  }
  void showSurface() {
    WorkPage* page = bench_.window().work_page;
    page->scene_view->fit();
    ++surfaces_;
    if (scene_ == "merge") {
      goOnMerging(*page);
    } else if (scene_ == "clean") {
      connect(&bench_.controller().editor(), &SurfaceEditor::previewMade, this,
              [this] { takeSoon(); });
      connect(&bench_.controller().editor(), &SurfaceEditor::previewRefused, this,
              [](const Error& error) { QApplication::exit(failWith(error.sentence())); });
      page->clean_panel->choose(pictureCleaning(*bench_.controller().mesh()));
    } else if (scene_ == "measure") {
      connect(&bench_.measures(), &MeasureController::changed, this,
              [this](const std::vector<Measurement>& measured) {
                if (!measured.empty()) takeSoon();
              });
      page->model_tools->measure->setChecked(true);
      for (const ScenePick& pick : widestPicks(*bench_.controller().mesh())) {
        bench_.measures().pick(pick, bench_.controller().mesh());
      }
    } else {
      takeSoon();
    }
  }
  // A page of the calibration wizard, when it shows what it is there for.
  void showWizard(WizardStep step) {
    CalibrationPanel* panel = bench_.window().work_page->calibration_panel;
    bench_.window().showWork(Step::kCalibrate);
    connect(&bench_.controller().devices(), &DeviceSession::opened, panel, [this, panel, step] {
      panel->showWizard();
      bench_.calibrations().chooseTarget({"wedge", {}, {}});
      panel->wizard->showStep(std::min(step, WizardStep::kPlace));
      if (step == WizardStep::kTarget) takeSoon();
    });
    CalibrationController* calibrations = &bench_.calibrations();
    connect(calibrations, &CalibrationController::sightSeen, this,
            [this, panel, calibrations, step](const TargetSight& sight) {
              if (!sight.passes) return;
              if (step == WizardStep::kPlace) takeSoon();
              if (step <= WizardStep::kPlace) return;
              bench_.controller().devices().confirmTurntable();
              panel->wizard->showStep(WizardStep::kTurn);
              calibrations->turn();
            });
    connect(calibrations, &CalibrationController::pictureTaken, this, [this, step] {
      if (step == WizardStep::kTurn) takeSoon();
    });
    connect(calibrations, &CalibrationController::measured, this, [this] { takeSoon(); });
    bench_.controller().devices().open("sim:target", "sim");
  }
  // After what the same news has changed elsewhere was painted.
  void takeSoon() {
    if (std::exchange(asked_, true)) return;
    QTimer::singleShot(100, this, [this] { take(); });
  }
  void take() {
    // On a busy machine the timer may come before the panels are laid out anew.
    QCoreApplication::sendPostedEvents();
    bench_.window().work_page->scene_view->picture();
    constexpr int kSmallest = 0;  // for PNG: the same picture in the fewest bytes
    const int quality = file_.endsWith(".png") ? kSmallest : -1;
    saved_ = bench_.window().grab().save(file_, nullptr, quality);
    connect(&bench_.controller(), &ScanController::quiet, this, [this] {
      QApplication::exit(
          saved_ ? 0 : failWith("The picture could not be written. Is its folder writable?"));
    });
    bench_.controller().shutDown();
  }

  Workbench& bench_;
  QString file_;
  std::string scene_;
  QTemporaryDir work_;
  int surfaces_ = 0;  // that were made so far
  bool asked_ = false;
  bool saved_ = false;
};

// What is wrong with the words of a screenshot; empty when nothing is.
std::string wrongWord(const GuiOptions& options) {
  constexpr std::array kScenes = {"start", "doctor", "focus", "place",  "scan",
                                  "mesh",  "clean",  "merge", "measure"};
  const bool known = wizardStep(options.scene) ||
                     std::find(kScenes.begin(), kScenes.end(), options.scene) != kScenes.end();
  if (!known) {
    return "There is no such scene. Give --scene start, doctor, focus, target, calibrate, turn, "
           "verdict, place, scan, mesh, clean, merge or measure.";
  }
  const std::vector<std::string>& objects = objectNames();
  if (std::find(objects.begin(), objects.end(), options.object) == objects.end()) {
    return "There is no such object. Give --object duck, mouse, cube, vase, bowl, plate or plain.";
  }
  if (options.theme != "light" && options.theme != "dark") {
    return "There is no such theme. Give --theme light or dark.";
  }
  return {};
}

int takeScreenshot(const GuiOptions& options) {
  RigOptions rig;
  rig.sim_speed = kPictureSpeed;
  applyTheme(*qApp, options.theme == "dark" ? ThemeChoice::kDark : ThemeChoice::kLight);
  Workbench bench(rig);
  const Photographer photographer(bench, options);
  return QApplication::exec();
}

}  // namespace

int runGui(int argc, char** argv, const GuiOptions& options) {
  const bool pictures = !options.screenshot.empty();
  if (pictures) {
    if (const std::string problem = wrongWord(options); !problem.empty()) {
      failWith(problem);
      return 2;
    }
  }
  if (pictures && !hasDisplay()) qputenv("QT_QPA_PLATFORM", "offscreen");
  if (!hasDisplay()) {
    return failWith(
        "There is no display to open a window on. `gyre demo --out DIR` and the other commands "
        "work without one; see `gyre --help`.");
  }
  setDefaultSurfaceFormat();
  QApplication application(argc, argv);
  QApplication::setApplicationName("gyre");
  QApplication::setApplicationDisplayName("Gyre");
  QApplication::setDesktopFileName("gyre");
  if (pictures) return takeScreenshot(options);

  applyTheme(application, Settings().theme());
  RigOptions rig;
  rig.sim_speed = 1.0;
  Workbench bench(rig);
  bench.window().show();
  const std::stop_callback close_window(options.stop, [&bench] {
    QMetaObject::invokeMethod(&bench.window(), &QWidget::close, Qt::QueuedConnection);
  });
  if (!options.open.empty()) bench.open(QString::fromStdString(options.open.string()));
  return QApplication::exec();
}

}  // namespace gyre
