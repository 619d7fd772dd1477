// Jobs run in turn elsewhere, and their ends are told here.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/job_runner.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include <QSignalSpy>
#include <QTest>
#include <QThread>

#include "tests/support/qt_application.h"

namespace gyre {
namespace {

constexpr int kPatience_ms = 5000;

TEST(JobRunner, RunsJobsInTurnInAnotherThreadAndTellsInThisOne) {
  JobRunner runner("test");
  std::vector<int> ended;
  const QThread* const here = QThread::currentThread();
  for (int i = 0; i < 3; ++i) {
    runner.start(
        [here](const Task&) -> Result<void> {
          EXPECT_NE(QThread::currentThread(), here);
          return {};
        },
        [&ended, i, here](const Result<void>& outcome) {
          EXPECT_TRUE(outcome.ok());
          EXPECT_EQ(QThread::currentThread(), here);
          ended.push_back(i);
        });
  }
  EXPECT_TRUE(runner.busy());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience_ms));
  EXPECT_EQ(ended, (std::vector<int>{0, 1, 2}));
}

TEST(JobRunner, MakesAnErrorOfAnException) {
  JobRunner runner("test");
  std::string sentence;
  runner.start([](const Task&) -> Result<void> { throw std::runtime_error("broken"); },
               [&](const Result<void>& outcome) { sentence = outcome.error().what; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience_ms));
  EXPECT_NE(sentence.find("broken"), std::string::npos);
}

TEST(JobRunner, StopsTheRunningJobAndDropsThoseThatWait) {
  JobRunner runner("test");
  std::vector<Error::Code> ends;
  const auto note = [&](const Result<void>& outcome) { ends.push_back(outcome.error().code); };
  std::atomic<bool> running = false;
  std::atomic<bool> second_ran = false;
  runner.start(
      [&](const Task& task) -> Result<void> {
        running = true;
        return task.sleepFor(60.0) ? Result<void>() : cancelled();
      },
      note);
  runner.start(
      [&](const Task&) -> Result<void> {
        second_ran = true;
        return {};
      },
      note);
  ASSERT_TRUE(QTest::qWaitFor([&] { return running.load(); }, kPatience_ms));
  runner.requestStop();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience_ms));
  EXPECT_EQ(ends, std::vector<Error::Code>(2, Error::Code::kCancelled));
  EXPECT_FALSE(second_ran);
}

TEST(JobRunner, IsIdleOnlyWhenTheLastEndIsTold) {
  JobRunner runner("test");
  QSignalSpy idle(&runner, &JobRunner::idle);
  bool second_ended = false;
  runner.start([](const Task&) { return Result<void>(); },
               [&](const Result<void>&) {
                 runner.start([](const Task&) { return Result<void>(); },
                              [&](const Result<void>&) { second_ended = true; });
               });
  ASSERT_TRUE(idle.wait(kPatience_ms));
  EXPECT_TRUE(second_ended);
  EXPECT_EQ(idle.count(), 1);
}

TEST(JobRunner, ReportsProgressAtMostTenTimesASecond) {
  JobRunner runner("test");
  QSignalSpy progress(&runner, &JobRunner::progressed);
  runner.start(
      [](const Task& task) -> Result<void> {
        for (int i = 0; i < 1000; ++i) task.report(i / 1000.0, "counting");
        return {};
      },
      [](const Result<void>&) {});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, kPatience_ms));
  EXPECT_GE(progress.count(), 1);
  EXPECT_LE(progress.count(), 5);
  EXPECT_EQ(progress.front().at(1).toString(), "counting");
}

TEST(JobRunner, EndsWithAJobRunning) {
  std::atomic<bool> stopped = false;
  {
    JobRunner runner("test");
    std::atomic<bool> running = false;
    runner.start(
        [&](const Task& task) -> Result<void> {
          running = true;
          stopped = !task.sleepFor(60.0);
          return {};
        },
        [](const Result<void>&) {});
    ASSERT_TRUE(QTest::qWaitFor([&] { return running.load(); }, kPatience_ms));
  }
  EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace gyre
