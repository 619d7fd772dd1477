// Step 7: files for other programs.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

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
  void meshExportRequested(const QString& path);    // .ply, .obj, .stl, .3mf or .glb
  void openRequested(const QString& path);          // in the program that the system has for it

 private:
  enum class Content { kPoints, kSurface };

  QPushButton* addFormat(Content content, const QString& format, const QString& tip);
  void ask(Content content, const QString& format);

  QPushButton* points_;
  std::vector<QPushButton*> surface_;  // one a format
  QLabel* written_;
  QPushButton* open_;
  QString folder_;
  QString written_path_;
};

}  // namespace gyre
