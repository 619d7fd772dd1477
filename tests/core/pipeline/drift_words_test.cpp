// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/drift_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kNever = 99;

// Six views, moved by so much from one of them on.
std::vector<ViewDrift> views(int moved_from, double px = 2.0) {
  std::vector<ViewDrift> list;
  for (int view = 0; view < 6; ++view) {
    const bool moved = view >= moved_from;
    list.push_back({view, true, moved ? px : 0.05, 0.02, moved});
  }
  return list;
}

std::vector<ViewDrift> unjudged() {
  std::vector<ViewDrift> list;
  for (int view = 0; view < 6; ++view) list.push_back({view, false, 0.0, 0.0, false});
  return list;
}

DriftReport background(std::vector<ViewDrift> seen, const char* sentence) {
  DriftReport report;
  report.views = std::move(seen);
  report.sentence = sentence;
  return report;
}

TEST(DriftWords, APushedTableMovesThePlatterAlone) {
  DriftReport report = background(views(kNever), "The camera stood still.");
  addPlatter(report, views(3));
  EXPECT_THAT(report.sentence, AllOf(HasSubstr("turntable was pushed: from view 4"),
                                     HasSubstr("2.0 px"), HasSubstr("stands still")));
  ASSERT_NE(report.firstMoved(), nullptr);
  EXPECT_EQ(report.firstMoved()->view, 3);
}

TEST(DriftWords, AKnockedCameraIsToldByTheBackground) {
  DriftReport report = background(views(2), "The camera was bumped.");
  addPlatter(report, views(2));
  EXPECT_EQ(report.sentence, "The camera was bumped.");
  EXPECT_EQ(report.firstMoved()->view, 2);
}

TEST(DriftWords, WithoutABackgroundEitherMayHaveMoved) {
  DriftReport report = background(unjudged(), "It cannot be told.");
  addPlatter(report, views(1));
  EXPECT_THAT(report.sentence, AllOf(HasSubstr("pushed or the camera bumped: from view 2"),
                                     Not(HasSubstr("stands still"))));
}

TEST(DriftWords, WhatStoodStillIsToldOfBoth) {
  DriftReport report = background(views(kNever), "The camera stood still.");
  addPlatter(report, views(kNever));
  EXPECT_THAT(report.sentence, HasSubstr("So did the turntable"));
  DriftReport bare = background(unjudged(), "It cannot be told.");
  addPlatter(bare, views(kNever));
  EXPECT_THAT(bare.sentence, HasSubstr("6 of 6 views"));
  EXPECT_EQ(bare.firstMoved(), nullptr);
}

TEST(DriftWords, ARingThatWasNotSeenSaysNothing) {
  DriftReport report = background(views(kNever), "The camera stood still.");
  addPlatter(report, unjudged());
  EXPECT_EQ(report.sentence, "The camera stood still.");
}

}  // namespace
}  // namespace gyre
