// Step 6: cleans the surface up, each change shown at once.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/clean_panel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTimer>

#include "core/base/option_list.h"
#include "ui/clean_row.h"
#include "ui/health_words.h"
#include "ui/parts.h"

namespace gyre {
namespace {

constexpr int kPause_ms = 30;
constexpr int kSlow_ms = 1000;
constexpr double kPercent = 0.01;
constexpr double kMostHole_mm = 50.0;
constexpr double kUsualHole_mm = 5.0;
constexpr double kUsualSpecks_percent = 2.0;
constexpr double kUsualSmoothing = 5.0;

// Sets the option of that name, whatever its type.
void setOption(const OptionList& list, const char* name, double value) {
  struct Setter {
    double value;
    void operator()(bool* field) const { *field = true; }
    void operator()(int* field) const { *field = static_cast<int>(std::lround(value)); }
    void operator()(double* field) const { *field = value; }
    void operator()(std::string*) const {}
  };
  if (const Option* option = list.find(name)) std::visit(Setter{value}, option->field);
}

double optionValue(const OptionList& list, const char* name) {
  struct Getter {
    double operator()(const bool* field) const { return *field ? 1.0 : 0.0; }
    double operator()(const int* field) const { return *field; }
    double operator()(const double* field) const { return *field; }
    double operator()(const std::string*) const { return 0.0; }
  };
  const Option* option = list.find(name);
  return option != nullptr ? std::visit(Getter{}, option->field) : 0.0;
}

// A round number of triangles: about half of those there are.
double halfInThousands(std::size_t triangles) {
  return 1000.0 * std::ceil(static_cast<double>(triangles) / 2000.0);
}

// The farthest corner of the box from the table's axis. [mm]
double reachOf(const Bounds& bounds) {
  const double x = std::max(std::abs(bounds.min.x()), std::abs(bounds.max.x()));
  const double y = std::max(std::abs(bounds.min.y()), std::abs(bounds.max.y()));
  return std::hypot(x, y);
}

}  // namespace

CleanPanel::CleanPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  QVBoxLayout* card = nullptr;
  layout->addWidget(makeCard(card));
  card->addWidget(makeLabel(tr("Clean up"), "heading"));
  card->addWidget(makeLabel(tr("Tick what shall be done; it is shown at once."), "muted"));
  auto* rows = new QVBoxLayout;
  rows->setSpacing(3);
  card->addLayout(rows);
  addRows(rows);
  progress_ = new QProgressBar;
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress of the clean-up"));
  progress_->hide();
  card->addWidget(progress_);
  outcome_ = makeLabel(QString(), "muted");
  card->addWidget(outcome_);
  auto* buttons = new QHBoxLayout;
  apply_ = makePrimaryButton(tr("Apply"), tr("Keep what is shown; it can be undone"));
  drop_ = makeButton(tr("Discard"), tr("Show the surface as it was, with nothing ticked"));
  buttons->addWidget(apply_, 1);
  buttons->addWidget(drop_);
  card->addLayout(buttons);
  pause_ = new QTimer(this);
  pause_->setSingleShot(true);
  pause_->setInterval(kPause_ms);
  slow_ = new QTimer(this);
  slow_->setSingleShot(true);
  slow_->setInterval(kSlow_ms);
  connect(pause_, &QTimer::timeout, this, &CleanPanel::request);
  connect(slow_, &QTimer::timeout, progress_, &QProgressBar::show);
  connect(apply_, &QPushButton::clicked, this, [this] {
    if (pause_->isActive()) request();
    Q_EMIT applyRequested();
  });
  connect(drop_, &QPushButton::clicked, this, [this] {
    reset();
    Q_EMIT previewDropped();
  });
  showSurface({}, 0);
  showFacts({});
}

void CleanPanel::addRow(QVBoxLayout* rows, CleanRow* row, const char* option, double per_unit) {
  rows->addWidget(row);
  rows_.push_back({row, option, per_unit});
  connect(row, &CleanRow::changed, this, &CleanPanel::change);
}

CleanRow* CleanPanel::addNumber(QVBoxLayout* rows, const char* option, const QString& name,
                                double per_unit) {
  CleanOptions described;
  const OptionList list = OptionList::of(described);
  const OptionInfo& info = list.find(option)->info;
  const bool crop = QString(option).startsWith("crop") || QString(option).startsWith("z-");
  const bool share = per_unit == kPercent;
  const bool count = std::holds_alternative<int*>(list.find(option)->field);
  CleanRowWords words;
  words.name = name;
  words.unit = share               ? tr(" %")
               : info.unit.empty() ? QString()
                                   : " " + QString::fromStdString(info.unit);
  words.tip = QString::fromStdString(info.text);
  words.decimals = count ? 0 : 1;
  auto* row =
      new CleanRow(crop ? CleanRow::Kind::kNumberAndSlider : CleanRow::Kind::kNumber, words);
  addRow(rows, row, option, per_unit);
  return row;
}

void CleanPanel::addRows(QVBoxLayout* rows) {
  radius_ = addNumber(rows, "crop-radius", tr("Crop around axis"), 1.0);
  lowest_ = addNumber(rows, "z-min", tr("Crop below"), 1.0);
  highest_ = addNumber(rows, "z-max", tr("Crop above"), 1.0);
  specks_ = addNumber(rows, "min-component", tr("Specks below"), kPercent);
  holes_ = addNumber(rows, "fill-holes", tr("Close holes to"), 1.0);
  base_ = new CleanRow(
      CleanRow::Kind::kTick,
      {tr("Flat base on the table"), QString(),
       tr("Closes the open bottom by a flat lid at height 0; what lies below is cut off."), 0});
  addRow(rows, base_, "base-cap", 1.0);
  smooth_ = addNumber(rows, "smooth", tr("Smooth, times"), 1.0);
  triangles_ = addNumber(rows, "triangles", tr("Triangles at most"), 1.0);
  even_ = addNumber(rows, "remesh", tr("Even triangles"), 1.0);
  specks_->setRange(0.1, 50.0, 0.5);
  specks_->setValue(kUsualSpecks_percent);
  holes_->setRange(0.1, kMostHole_mm, 0.5);
  holes_->setValue(kUsualHole_mm);
  smooth_->setRange(1, 100, 1);
  smooth_->setValue(kUsualSmoothing);
}

void CleanPanel::showSurface(const Bounds& bounds, std::size_t triangles) {
  const bool any = !bounds.empty() && triangles > 0;
  for (const Row& row : rows_) row.row->setEnabled(any);
  if (!any) {
    reset();
    outcome_->setText(tr("There is no surface yet."));
    return;
  }
  const double reach_mm = std::ceil(reachOf(bounds));
  const double low_mm = std::floor(bounds.min.z());
  const double high_mm = std::ceil(bounds.max.z());
  radius_->setRange(1.0, reach_mm, 0.5);
  lowest_->setRange(low_mm, high_mm, 0.5);
  highest_->setRange(low_mm, high_mm, 0.5);
  triangles_->setRange(100, std::max<double>(static_cast<double>(triangles), 100.0), 1000);
  const double edge_mm = std::max(bounds.diagonal() / 100.0, 0.1);
  even_->setRange(std::max(edge_mm / 5.0, 0.1), 10.0 * edge_mm, 0.1);
  if (!radius_->isOn()) radius_->setValue(reach_mm);
  if (!lowest_->isOn()) lowest_->setValue(low_mm);
  if (!highest_->isOn()) highest_->setValue(high_mm);
  if (!triangles_->isOn()) triangles_->setValue(halfInThousands(triangles));
  if (!even_->isOn()) even_->setValue(edge_mm);
}

CleanOptions CleanPanel::options() const {
  CleanOptions options;
  options.min_component_share = 0.0;
  const OptionList list = OptionList::of(options);
  for (const Row& row : rows_) {
    if (row.row->isOn()) setOption(list, row.option, row.per_unit * row.row->value());
  }
  return options;
}

void CleanPanel::choose(const CleanOptions& options) {
  CleanOptions wanted = options;
  CleanOptions nothing;
  nothing.min_component_share = 0.0;
  const OptionList wanted_list = OptionList::of(wanted);
  const OptionList nothing_list = OptionList::of(nothing);
  for (const Row& row : rows_) {
    const double value = optionValue(wanted_list, row.option);
    if (value == optionValue(nothing_list, row.option)) continue;
    row.row->turnOn(value / row.per_unit);
  }
  change();
}

bool CleanPanel::anyOn() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.row->isOn(); });
}

void CleanPanel::change() {
  Q_EMIT cropChanged(options().crop);
  pause_->start();
}

void CleanPanel::request() {
  pause_->stop();
  if (anyOn()) {
    Q_EMIT previewRequested(options());
  } else {
    reset();
    Q_EMIT previewDropped();
  }
}

void CleanPanel::showBegun() {
  if (!slow_->isActive() && !progress_->isVisible()) slow_->start();
  progress_->setRange(0, 0);  // busy, until it tells how far it is
}

void CleanPanel::showProgress(double fraction, const QString& stage) {
  constexpr int kParts = 1000;
  progress_->setRange(0, kParts);
  progress_->setValue(static_cast<int>(kParts * fraction));
  if (progress_->isVisible()) outcome_->setText(stage + "…");
}

void CleanPanel::showReport(const CleanReport& report) {
  slow_->stop();
  progress_->hide();
  outcome_->setText(cleanText(report));
}

void CleanPanel::showProblem(const Error& error) {
  slow_->stop();
  progress_->hide();
  outcome_->setText("⚠ " + QString::fromStdString(error.sentence()));
}

void CleanPanel::showFacts(const EditFacts& facts) {
  apply_->setEnabled(facts.previewing);
  drop_->setEnabled(facts.previewing || anyOn());
}

void CleanPanel::reset() {
  pause_->stop();
  slow_->stop();
  progress_->hide();
  for (const Row& row : rows_) row.row->turnOff();
  outcome_->clear();
  drop_->setEnabled(false);
  Q_EMIT cropChanged({});
}

}  // namespace gyre
