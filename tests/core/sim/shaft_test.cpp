// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/shaft.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(Shaft, TableFollowsAtOnceWithoutPlay) {
  Shaft shaft;
  for (const std::int64_t steps : {5, 100, 40, -7}) {
    shaft.setSteps(steps);
    EXPECT_EQ(shaft.steps(), steps);
    EXPECT_EQ(shaft.tableSteps(), steps);
  }
}

TEST(Shaft, TableHangsBehindByThePlayWhenTheMotorTurnsBack) {
  Shaft shaft(10);
  shaft.setSteps(100);
  EXPECT_EQ(shaft.tableSteps(), 100);
  shaft.setSteps(95);
  EXPECT_EQ(shaft.tableSteps(), 100);  // half of the play is taken up
  shaft.setSteps(60);
  EXPECT_EQ(shaft.tableSteps(), 70);
  shaft.setSteps(65);
  EXPECT_EQ(shaft.tableSteps(), 70);
  shaft.setSteps(80);
  EXPECT_EQ(shaft.tableSteps(), 80);
  EXPECT_EQ(shaft.steps(), 80);
}

}  // namespace
}  // namespace gyre
