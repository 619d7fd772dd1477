// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/task.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

TEST(Task, SilentTaskTakesReportsAndNeverStops) {
  const Task task;
  task.report(0.5, "half");
  EXPECT_FALSE(task.stopRequested());
}

TEST(Task, PartsOfPartsMapIntoTheWhole) {
  std::vector<double> seen;
  const Task task({}, [&](double fraction, std::string_view) { seen.push_back(fraction); });
  task.part(0.5, 1.0).part(0.0, 0.5).report(1.0, "");
  task.report(7.0, "");
  EXPECT_EQ(seen, (std::vector<double>{0.75, 1.0}));
}

TEST(Task, StopReachesParts) {
  std::stop_source source;
  const Task part = Task(source.get_token()).part(0.0, 0.1);
  source.request_stop();
  EXPECT_TRUE(part.stopRequested());
}

TEST(Task, StopWakesASleeper) {
  std::stop_source source;
  const Task task(source.get_token());
  std::jthread stopper([&] { source.request_stop(); });
  const double start_s = steadySeconds();
  EXPECT_FALSE(task.sleepFor(30.0));
  EXPECT_LT(steadySeconds() - start_s, 10.0);
}

TEST(Task, SleepEndsByItself) { EXPECT_TRUE(Task().sleepFor(0.001)); }

}  // namespace
}  // namespace gyre
