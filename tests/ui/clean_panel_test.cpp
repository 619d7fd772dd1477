// The clean-up panel, driven as a person would.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/clean_panel.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>

#include "tests/support/qt_application.h"
#include "ui/clean_row.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 2000;

class CleanPanelTest : public testing::Test {
 protected:
  void SetUp() override {
    panel_.show();
    Bounds bounds;
    bounds.include({-30.0, -40.0, 0.5});
    bounds.include({30.0, 20.0, 79.5});
    panel_.showSurface(bounds, 40000);
  }
  QCheckBox* box(const QString& text) {
    for (auto* candidate : panel_.findChildren<QCheckBox*>()) {
      if (candidate->text() == text) return candidate;
    }
    ADD_FAILURE() << "no box " << text.toStdString();
    return nullptr;
  }
  QDoubleSpinBox* number(const QString& text) {
    return box(text)->parentWidget()->findChild<QDoubleSpinBox*>();
  }
  QPushButton* button(const QString& text) {
    for (auto* candidate : panel_.findChildren<QPushButton*>()) {
      if (candidate->text() == text) return candidate;
    }
    return nullptr;
  }
  QString text() const {
    QStringList texts;
    for (const auto* label : panel_.findChildren<QLabel*>()) texts.append(label->text());
    return texts.join('\n');
  }
  CleanPanel panel_;
};

TEST_F(CleanPanelTest, AsksForNothingUntilAStepIsTicked) {
  QSignalSpy wanted(&panel_, &CleanPanel::previewRequested);
  number("Smooth, times")->setValue(9);  // not ticked
  EXPECT_FALSE(wanted.wait(150));
  EXPECT_FALSE(button("Apply")->isEnabled());
  const CleanOptions options = panel_.options();
  EXPECT_EQ(options.smooth.iterations, 0);
  EXPECT_EQ(options.min_component_share, 0.0);
  EXPECT_EQ(options.crop.radius_mm, 0.0);
  EXPECT_FALSE(options.base_cap);
}

TEST_F(CleanPanelTest, AsksForWhatIsTicked) {
  QSignalSpy wanted(&panel_, &CleanPanel::previewRequested);
  for (const char* name :
       {"Crop around axis", "Crop below", "Crop above", "Specks below", "Close holes to",
        "Flat base on the table", "Smooth, times", "Triangles at most", "Even triangles"}) {
    QTest::mouseClick(box(name), Qt::LeftButton, Qt::NoModifier, QPoint(8, 10));
  }
  number("Crop around axis")->setValue(25.0);
  number("Crop below")->setValue(2.0);
  number("Crop above")->setValue(70.0);
  number("Specks below")->setValue(3.0);
  number("Close holes to")->setValue(6.0);
  number("Smooth, times")->setValue(7);
  number("Triangles at most")->setValue(12000);
  number("Even triangles")->setValue(1.5);
  ASSERT_TRUE(wanted.wait(kPatience_ms));
  ASSERT_EQ(wanted.count(), 1);  // one for all that came together
  const auto options = wanted.front().front().value<CleanOptions>();
  EXPECT_DOUBLE_EQ(options.crop.radius_mm, 25.0);
  EXPECT_DOUBLE_EQ(options.crop.z_min_mm, 2.0);
  EXPECT_DOUBLE_EQ(options.crop.z_max_mm, 70.0);
  EXPECT_DOUBLE_EQ(options.min_component_share, 0.03);
  EXPECT_DOUBLE_EQ(options.holes.max_width_mm, 6.0);
  EXPECT_TRUE(options.base_cap);
  EXPECT_EQ(options.smooth.iterations, 7);
  EXPECT_EQ(options.decimate.triangles, 12000);
  EXPECT_DOUBLE_EQ(options.remesh.edge_mm, 1.5);
  EXPECT_TRUE(options.validate().ok());
}

TEST_F(CleanPanelTest, BeginsACropWhereItCutsNothing) {
  QSignalSpy crops(&panel_, &CleanPanel::cropChanged);
  QTest::mouseClick(box("Crop around axis"), Qt::LeftButton, Qt::NoModifier, QPoint(8, 10));
  ASSERT_GE(crops.count(), 1);
  EXPECT_DOUBLE_EQ(crops.back().front().value<CropOptions>().radius_mm, 50.0);  // 30, 40
  EXPECT_DOUBLE_EQ(panel_.options().crop.z_min_mm, -kNoCrop_mm);
}

TEST_F(CleanPanelTest, DrawsTheCropWhileItsSliderMoves) {
  QSignalSpy crops(&panel_, &CleanPanel::cropChanged);
  QTest::mouseClick(box("Crop above"), Qt::LeftButton, Qt::NoModifier, QPoint(8, 10));
  auto* slider = box("Crop above")->parentWidget()->findChild<QSlider*>();
  ASSERT_TRUE(slider->isVisible());
  slider->setValue(slider->maximum() / 2);
  EXPECT_NEAR(crops.back().front().value<CropOptions>().z_max_mm, 40.0, 0.2);
  EXPECT_NEAR(number("Crop above")->value(), 40.0, 0.2);
  EXPECT_FALSE(box("Crop below")->parentWidget()->findChild<QSlider*>()->isVisible());
}

TEST_F(CleanPanelTest, DropsThePreviewWhenTheLastTickGoes) {
  QSignalSpy wanted(&panel_, &CleanPanel::previewRequested);
  QSignalSpy dropped(&panel_, &CleanPanel::previewDropped);
  box("Smooth, times")->click();
  ASSERT_TRUE(wanted.wait(kPatience_ms));
  box("Smooth, times")->click();
  EXPECT_TRUE(dropped.wait(kPatience_ms));
  EXPECT_EQ(wanted.count(), 1);
}

TEST_F(CleanPanelTest, AppliesWhatIsShownAndDiscardsIt) {
  EditFacts facts;
  facts.previewing = true;
  panel_.showFacts(facts);
  QSignalSpy applied(&panel_, &CleanPanel::applyRequested);
  button("Apply")->click();
  EXPECT_EQ(applied.count(), 1);
  box("Smooth, times")->click();
  QSignalSpy dropped(&panel_, &CleanPanel::previewDropped);
  QSignalSpy crops(&panel_, &CleanPanel::cropChanged);
  button("Discard")->click();
  EXPECT_EQ(dropped.count(), 1);
  EXPECT_FALSE(box("Smooth, times")->isChecked());
  EXPECT_DOUBLE_EQ(crops.back().front().value<CropOptions>().radius_mm, 0.0);
}

TEST_F(CleanPanelTest, ShowsProgressOnlyOfWhatTakesLong) {
  auto* progress = panel_.findChild<QProgressBar*>();
  panel_.showBegun();
  QTest::qWait(100);
  EXPECT_FALSE(progress->isVisible());
  ASSERT_TRUE(QTest::qWaitFor([&] { return progress->isVisible(); }, 5000));
  panel_.showProgress(0.4, "Reducing");
  EXPECT_EQ(progress->value(), 400);
  EXPECT_TRUE(text().contains("Reducing"));
  panel_.showReport({});
  EXPECT_FALSE(progress->isVisible());
}

TEST_F(CleanPanelTest, SaysWhyThereIsNoPreview) {
  panel_.showProblem({Error::Code::kTooFew, "The crop leaves nothing.", "Crop less."});
  EXPECT_TRUE(text().contains("The crop leaves nothing. Crop less."));
}

TEST_F(CleanPanelTest, OffersNothingWithoutASurface) {
  panel_.showSurface({}, 0);
  for (const auto* row : panel_.findChildren<CleanRow*>()) EXPECT_FALSE(row->isEnabled());
  EXPECT_FALSE(button("Apply")->isEnabled());
  EXPECT_FALSE(button("Discard")->isEnabled());
}

TEST_F(CleanPanelTest, KeepsTickedNumbersWhenTheSurfaceChanges) {
  box("Triangles at most")->click();
  number("Triangles at most")->setValue(5000);
  Bounds smaller;
  smaller.include({-10.0, -10.0, 0.0});
  smaller.include({10.0, 10.0, 20.0});
  panel_.showSurface(smaller, 20000);
  EXPECT_DOUBLE_EQ(number("Triangles at most")->value(), 5000.0);
  EXPECT_DOUBLE_EQ(number("Crop above")->value(), 20.0);
}

TEST_F(CleanPanelTest, TicksWhatGivenOptionsAskFor) {
  CleanOptions options;
  options.min_component_share = 0.05;
  options.crop.z_max_mm = 60.0;
  options.smooth.iterations = 3;
  panel_.choose(options);
  EXPECT_TRUE(box("Specks below")->isChecked());
  EXPECT_FALSE(box("Crop below")->isChecked());
  EXPECT_DOUBLE_EQ(panel_.options().min_component_share, 0.05);
  EXPECT_DOUBLE_EQ(panel_.options().crop.z_max_mm, 60.0);
  EXPECT_EQ(panel_.options().smooth.iterations, 3);
}

}  // namespace
}  // namespace gyre
