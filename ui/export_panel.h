// Step 6: files for other programs.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include <QWidget>

class QLabel;
class QPushButton;

namespace gyre {

class ExportPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit ExportPanel(QWidget* parent = nullptr);

 public Q_SLOTS:
  void showAvailable(std::size_t points, std::size_t triangles);
  void showWritten(const QString& path);
  void setFolder(const QString& folder);

 Q_SIGNALS:
  void pointsExportRequested(const QString& path);  // .ply
  void meshExportRequested(const QString& path);    // .ply or .obj by its ending

 private:
  void ask(const char* kind, const QString& filter);

  QPushButton* points_;
  QPushButton* ply_;
  QPushButton* obj_;
  QLabel* written_;
  QString folder_;
};

}  // namespace gyre
