// A person is told how to turn the table, and answers once for each time that is asked.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/hand_card.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QVBoxLayout>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

HandTurnFacts toMark(long long mark) {
  return {1, true, 5.0, mark, 5.0 * static_cast<double>(mark)};
}

// The card in a window where something else has the keyboard.
class HandCardTest : public testing::Test {
 protected:
  void SetUp() override {
    auto* layout = new QVBoxLayout(&window_);
    layout->addWidget(elsewhere_);
    layout->addWidget(card_);
    window_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window_));
    window_.activateWindow();
    elsewhere_->setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return elsewhere_->hasFocus(); }));
  }
  QPushButton* button(const QString& text) {
    for (auto* candidate : card_->findChildren<QPushButton*>()) {
      if (candidate->text() == text) return candidate;
    }
    return nullptr;
  }

  QWidget window_;
  QLineEdit* elsewhere_ = new QLineEdit;
  HandCard* card_ = new HandCard;
};

TEST_F(HandCardTest, AsksInDegreesAndMarks) {
  EXPECT_TRUE(card_->isHidden());
  card_->ask(toMark(3));
  EXPECT_FALSE(card_->isHidden());
  const QString text = card_->findChild<QLabel*>()->text();
  EXPECT_TRUE(
      text.startsWith("Turn the table counter-clockwise, seen from above, by 5° to mark 3 "
                      "(15°). Then press Done"))
      << text.toStdString();
  EXPECT_TRUE(handTurnText({2, false, 10.0, 35, 350.0})
                  .startsWith("Turn the table clockwise, seen from above, by 20° to mark 35"));
}

TEST_F(HandCardTest, TakesTheEnterKeyFromAnywhereAndOnlyOnce) {
  QSignalSpy done(card_, &HandCard::done);
  QTest::keyClick(elsewhere_, Qt::Key_Return);  // nothing was asked
  EXPECT_EQ(done.count(), 0);
  card_->ask(toMark(1));
  QTest::keyClick(elsewhere_, Qt::Key_Return);
  QTest::keyClick(elsewhere_, Qt::Key_Return);
  EXPECT_EQ(done.count(), 1);
  card_->settle();
  EXPECT_FALSE(card_->isHidden());  // the next question comes in its place
  card_->ask(toMark(2));
  QTest::keyClick(elsewhere_, Qt::Key_Enter, Qt::KeypadModifier);
  EXPECT_EQ(done.count(), 2);
}

TEST_F(HandCardTest, StopsAndGoesAway) {
  card_->ask(toMark(1));
  QSignalSpy stop(card_, &HandCard::stopRequested);
  button("Stop")->click();
  EXPECT_EQ(stop.count(), 1);
  card_->settle();
  EXPECT_TRUE(card_->isHidden());
}

}  // namespace
}  // namespace gyre
