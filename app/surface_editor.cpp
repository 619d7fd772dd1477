// What is done to a surface once it is made: clean-up with a preview, undo and redo.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/surface_editor.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh/clean/self_intersections.h"

namespace gyre {
namespace {

constexpr int kCountPause_ms = 400;
// A count cannot be stopped in its middle: of more triangles it would hold up the window's end.
constexpr std::size_t kMostCounted = 500'000;

}  // namespace

SurfaceEditor::SurfaceEditor(QObject* parent)
    : QObject(parent), jobs_("gyre-clean"), counts_("gyre-count") {
  count_pause_.setSingleShot(true);
  count_pause_.setInterval(kCountPause_ms);
  connect(&count_pause_, &QTimer::timeout, this, &SurfaceEditor::countSelfIntersections);
  connect(&jobs_, &JobRunner::progressed, this, [this](double fraction, const QString& stage) {
    if (waits_) Q_EMIT previewProgressed(fraction, stage);
  });
  connect(&jobs_, &JobRunner::idle, this, &SurfaceEditor::idle);
}

const SurfaceState* SurfaceEditor::shownState() const {
  if (now() == nullptr) return nullptr;
  if (side_ == EditSide::kBefore) {
    return preview_ || history_.before() == nullptr ? now() : history_.before();
  }
  return preview_ ? &preview_->state : now();
}

MeshHealth SurfaceEditor::shownHealth() const {
  return shownState() != nullptr ? shownState()->health : MeshHealth{};
}

void SurfaceEditor::begin(SurfaceState first) {
  endPreview();
  history_.begin(std::move(first));
  tellState();
}

void SurfaceEditor::add(SurfaceState made) {
  endPreview();
  history_.add(std::move(made));
  tellState();
}

void SurfaceEditor::replace(SurfaceState made) {
  endPreview();
  history_.replace(std::move(made));
  tellState();
}

void SurfaceEditor::clear() {
  endPreview();
  history_.clear();
  tellState();
}

void SurfaceEditor::requestStop() { endPreview(); }

void SurfaceEditor::preview(const CleanOptions& options) {
  if (now() == nullptr) return;
  ++wish_number_;
  wish_ = options;
  waits_ = true;
  apply_when_made_ = false;
  Q_EMIT previewBegun();
  if (running_) {
    jobs_.requestStop();
  } else {
    startPreview();
  }
  Q_EMIT factsChanged(facts());
}

void SurfaceEditor::startPreview() {
  running_ = true;
  auto made = std::make_shared<std::optional<Preview>>();
  jobs_.start(
      [base = *now(), options = *std::exchange(wish_, std::nullopt), clean_up = clean_up_,
       made](const Task& task) -> Result<void> {
        auto cleaned = clean_up->run(base.mesh, options, task);
        if (!cleaned) return cleaned.error();
        Preview& preview = made->emplace();
        preview.state = {std::make_shared<const Mesh>(std::move(cleaned->mesh)),
                         cleaned->report.after, base.wish, stepsText(cleaned->report)};
        preview.report = std::move(cleaned->report);
        return {};
      },
      [this, made, number = wish_number_](const Result<void>& outcome) {
        running_ = false;
        if (wish_) {
          startPreview();
        } else if (number == wish_number_) {
          previewDone(outcome, std::move(*made));
        }
      });
}

void SurfaceEditor::previewDone(const Result<void>& outcome, std::optional<Preview> made) {
  waits_ = false;
  preview_ = std::move(made);
  if (!outcome) {
    apply_when_made_ = false;
    Q_EMIT previewRefused(outcome.error());
  } else if (apply_when_made_) {
    apply();
    return;
  } else {
    Q_EMIT previewMade(preview_->report);
  }
  Q_EMIT sceneChanged();
  Q_EMIT factsChanged(facts());
}

void SurfaceEditor::dropPreview() {
  if (!previewing()) return;
  endPreview();
  Q_EMIT sceneChanged();
  Q_EMIT factsChanged(facts());
}

void SurfaceEditor::endPreview() {
  ++wish_number_;
  wish_.reset();
  waits_ = false;
  apply_when_made_ = false;
  preview_.reset();
  if (running_) jobs_.requestStop();
  Q_EMIT previewEnded();
}

void SurfaceEditor::apply() {
  if (waits_) {
    apply_when_made_ = true;
    return;
  }
  if (!preview_) return;
  add(std::move(preview_->state));
}

void SurfaceEditor::noteMaking(const QString& what) {
  if (what == making_) return;
  making_ = what;
  Q_EMIT factsChanged(facts());
}

void SurfaceEditor::undo() {
  if (!making_.isEmpty()) {
    Q_EMIT stopRequested();
  } else if (previewing()) {
    dropPreview();
  } else if (history_.undo()) {
    tellState();
  }
}

void SurfaceEditor::redo() {
  if (!making_.isEmpty() || previewing() || !history_.redo()) return;
  tellState();
}

void SurfaceEditor::setSide(EditSide side) {
  if (side == side_) return;
  side_ = side;
  Q_EMIT sceneChanged();
}

void SurfaceEditor::tellState() {
  clean_up_ = std::make_shared<RepeatedCleanUp>();
  counts_.requestStop();
  count_pause_.stop();
  const bool counts = now() != nullptr && !now()->health.self_intersections &&
                      now()->mesh->triangles.size() <= kMostCounted;
  if (counts) count_pause_.start();
  Q_EMIT stateChanged();
  Q_EMIT sceneChanged();
  Q_EMIT factsChanged(facts());
}

void SurfaceEditor::countSelfIntersections() {
  auto found = std::make_shared<MeshHealth>();
  counts_.start(
      [mesh = now()->mesh, found](const Task& task) -> Result<void> {
        const auto health = wholeHealth(*mesh, task);
        if (!health) return health.error();
        *found = *health;
        return {};
      },
      [this, mesh = now()->mesh, found](const Result<void>& outcome) {
        if (!outcome || now() == nullptr || now()->mesh != mesh) return;
        history_.know(*found);
        Q_EMIT healthKnown(*found);
      });
}

EditFacts SurfaceEditor::facts() const {
  EditFacts facts;
  facts.previewing = previewing();
  facts.has_before = previewing() || history_.before() != nullptr;
  if (!making_.isEmpty() || previewing()) {
    facts.undo = making_.isEmpty() ? tr("the preview") : making_;
    return facts;
  }
  if (history_.before() != nullptr) {
    facts.undo = QString::fromStdString(now()->step);
    const bool jumps = history_.letGo() > 0 && history_.before() == history_.first();
    if (jumps) {
      facts.undo += tr(", and %n older step(s) that were let go to save memory", nullptr,
                       static_cast<int>(history_.letGo()));
    }
  }
  if (history_.next() != nullptr) facts.redo = QString::fromStdString(history_.next()->step);
  return facts;
}

std::string stepsText(const CleanReport& report) {
  // What every cleaning does by itself.
  constexpr std::array<std::string_view, 3> kAlways = {"Merge", "Separate", "Orient"};
  std::vector<std::string> names;
  for (const CleanStep& step : report.steps) {
    if (std::find(kAlways.begin(), kAlways.end(), step.name) != kAlways.end()) continue;
    if (std::find(names.begin(), names.end(), step.name) == names.end()) names.push_back(step.name);
  }
  std::string text;
  for (std::string& name : names) {
    if (name.empty()) continue;
    name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
    text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "clean-up" : text;
}

}  // namespace gyre
