// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/print_target.h"

#include <cmath>
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/aruco.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/io/target_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

constexpr double kDotsPerMm = 600.0 / 25.4;

// The page as another program (poppler) paints it, grey, 600 dots an inch; empty without it.
cv::Mat rasterised(const std::filesystem::path& pdf) {
  const std::filesystem::path stem = std::filesystem::path(pdf).replace_extension();
  const std::string command =
      "pdftoppm -r 600 -gray -singlefile -png '" + pdf.string() + "' '" + stem.string() + "'";
  if (std::system(command.c_str()) != 0) return {};
  return cv::imread(stem.string() + ".png", cv::IMREAD_GRAYSCALE);
}

// How dark the page is there, [0, 1]; a dot covers [i, i + 1) of the page.
double darkAt(const cv::Mat& page, double x_mm, double y_mm) {
  return 1.0 - page.at<std::uint8_t>(static_cast<int>(y_mm * kDotsPerMm),
                                     static_cast<int>(x_mm * kDotsPerMm)) /
                   255.0;
}

// Where, within 1 mm of the place, the middle of a thin line is. along: the direction across it.
double lineNear(const cv::Mat& page, const Eigen::Vector2d& place, const Eigen::Vector2d& along) {
  double sum = 0.0;
  double moment = 0.0;
  for (double s = -1.0; s <= 1.0; s += 0.01) {
    const Eigen::Vector2d at = place + s * along;
    const double dark = darkAt(page, at.x(), at.y());
    sum += dark;
    moment += dark * s;
  }
  return moment / sum;
}

// The length of the dark run through the place. [mm]
double darkRun(const cv::Mat& page, const Eigen::Vector2d& place, const Eigen::Vector2d& along) {
  double length = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    for (double s = 0.0025; s < 30.0; s += 0.005) {
      const Eigen::Vector2d at = place + sign * s * along;
      const double dark = darkAt(page, at.x(), at.y());
      length += 0.005 * dark;
      if (dark < 0.01) break;
    }
  }
  return length;
}

void expectTrueRulers(const cv::Mat& page, const PrintDrawing& sheet, const std::string& name) {
  for (const PrintRuler& ruler : sheet.rulers) {
    const Eigen::Vector2d along = (ruler.to - ruler.from).normalized();
    const Eigen::Vector2d aside = 3.5 * Eigen::Vector2d(-along.y(), along.x());  // beyond the ticks
    const double length = (ruler.to - ruler.from).norm() + lineNear(page, ruler.to + aside, along) -
                          lineNear(page, ruler.from + aside, along);
    EXPECT_NEAR(length, 100.0, 0.05) << name;
  }
}

int squaresOfTrueSize(const cv::Mat& page, const PrintDrawing& sheet, const Target& target) {
  if (target.faces.empty()) return 0;
  const double side_mm =
      (target.corners[1].position_in_target - target.corners[0].position_in_target).norm();
  int squares = 0;
  for (const PrintPolygon& polygon : sheet.polygons) {
    if (polygon.outline.size() != 4 || polygon.ink != PrintPolygon::Ink::kBlack) continue;
    if (std::abs((polygon.outline[1] - polygon.outline[0]).norm() - side_mm) > 1e-6) continue;
    const Eigen::Vector2d middle = 0.5 * (polygon.outline[0] + polygon.outline[2]);
    EXPECT_NEAR(darkRun(page, middle, Eigen::Vector2d::UnitX()), side_mm, 0.1);
    EXPECT_NEAR(darkRun(page, middle, Eigen::Vector2d::UnitY()), side_mm, 0.1);
    ++squares;
  }
  return squares;
}

void expectReadableCodes(const cv::Mat& page, const Target& target) {
  // OpenCV's thresholding windows are made for bits of a few pixels: 120 dots an inch.
  cv::Mat small;
  cv::resize(page, small, {}, 0.2, 0.2, cv::INTER_AREA);
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(small, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_250),
                           corners, ids);
  std::set<int> known;
  for (const TargetMarker& marker : target.markers) known.insert(marker.id);
  EXPECT_EQ(std::set<int>(ids.begin(), ids.end()), known) << target.name;
}

class PrintedPage : public testing::TestWithParam<PageSize> {};

TEST_P(PrintedPage, IsOfTrueSizeWithCodesThatOthersRead) {
  const TempDir dir;
  for (const char* name : {"cube", "wedge", "ring"}) {
    const StandardTarget target = standardTarget(name).value();
    const auto done = printTarget(target, GetParam(), dir.path());
    ASSERT_TRUE(done) << done.error().sentence();
    const cv::Mat page = rasterised(dir / (std::string(name) + ".pdf"));
    if (page.empty()) GTEST_SKIP() << "pdftoppm (poppler-utils) is not installed.";
    EXPECT_NEAR(page.cols / kDotsPerMm, GetParam().width_mm, 0.1);
    EXPECT_NEAR(page.rows / kDotsPerMm, GetParam().height_mm, 0.1);
    const PrintDrawing sheet = sheetOf(target, GetParam());
    expectTrueRulers(page, sheet, name);
    EXPECT_EQ(squaresOfTrueSize(page, sheet, target.target) > 40, !target.target.faces.empty());
    expectReadableCodes(page, target.target);
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, PrintedPage, testing::Values(kA4, kLetter),
                         [](const auto& page) { return std::string(page.param.name); });

TEST(PrintTarget, LeavesItsDescriptionBeside) {
  const TempDir dir;
  const StandardTarget target = standardTarget("coded-cube").value();
  ASSERT_TRUE(printTarget(target, kA4, dir / "new"));
  const auto back = readTarget((dir / "new") / "coded-cube.target.json");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->markers.size(), 60U);
}

TEST(PrintTarget, TellsWhenItMayNotWriteThere) {
  EXPECT_FALSE(printTarget(standardTarget("flat").value(), kA4, "/proc/nowhere"));
}

}  // namespace
}  // namespace gyre
