// Step 6: cleans the surface up, each change shown at once.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <QWidget>

#include "core/base/result.h"
#include "core/mesh/clean/options.h"
#include "core/scan/clean_report.h"
#include "core/scan/point_cloud.h"
#include "ui/facts.h"

class QLabel;
class QProgressBar;
class QPushButton;
class QTimer;
class QVBoxLayout;

namespace gyre {

class CleanRow;

// Nothing is done until a step is ticked. Then every change asks for a preview of all that is
// ticked, and Apply makes it a step that can be undone.
class CleanPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit CleanPanel(QWidget* parent = nullptr);

  // What is ticked.
  CleanOptions options() const;
  // Ticks what the options ask for, as a person would; a number outside a row's range becomes its
  // nearest.
  void choose(const CleanOptions& options);

 public Q_SLOTS:
  // Offers what fits a surface: empty bounds, no surface. Numbers that nobody changed follow it.
  void showSurface(const gyre::Bounds& bounds, std::size_t triangles);
  void showBegun();                                          // a preview is being made
  void showProgress(double fraction, const QString& stage);  // shown after a second
  void showReport(const gyre::CleanReport& report);          // of the preview that is shown
  void showProblem(const gyre::Error& error);                // why there is no preview
  void showFacts(const gyre::EditFacts& facts);
  void reset();  // nothing is ticked

 Q_SIGNALS:
  void previewRequested(const gyre::CleanOptions& options);
  void previewDropped();
  void applyRequested();
  void cropChanged(const gyre::CropOptions& crop);  // to be drawn; at its limits: nothing

 private:
  struct Row {
    CleanRow* row;
    const char* option;  // its name in CleanOptions; a flag for a mere tick
    double per_unit;     // what the option counts for one of the row's numbers
  };

  void addRows(QVBoxLayout* rows);
  CleanRow* addNumber(QVBoxLayout* rows, const char* option, const QString& name, double per_unit);
  void addRow(QVBoxLayout* rows, CleanRow* row, const char* option, double per_unit);
  void change();
  void request();
  bool anyOn() const;

  std::vector<Row> rows_;
  CleanRow* radius_;
  CleanRow* lowest_;
  CleanRow* highest_;
  CleanRow* specks_;
  CleanRow* holes_;
  CleanRow* base_;
  CleanRow* smooth_;
  CleanRow* triangles_;
  CleanRow* even_;
  QTimer* pause_;  // between the last change and the preview
  QTimer* slow_;   // until the progress is shown
  QProgressBar* progress_;
  QLabel* outcome_;
  QPushButton* apply_;
  QPushButton* drop_;
};

}  // namespace gyre
