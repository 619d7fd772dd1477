// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/support/mutate.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

CapturedView viewNumber(int view) {
  CapturedView captured;
  captured.view = view;
  captured.file = "view_" + std::to_string(view) + ".png";
  captured.table_angle_rad = 0.1 * view + 1e-17;
  captured.steps = std::int64_t{-5'000'000'000} * view;
  captured.sharpness = 1.0 / 3.0;
  captured.time_utc = "2026-01-01T12:00:00.000Z";
  return captured;
}

std::vector<int> numbersOf(const ScanJournal& journal) {
  std::vector<int> numbers;
  for (const CapturedView& view : journal.views()) numbers.push_back(view.view);
  return numbers;
}

TEST(ScanJournal, KeepsEveryBitOfAView) {
  const TempDir dir;
  const CapturedView view = viewNumber(3);
  ASSERT_TRUE(ScanJournal::open(dir / "j")->append(view));
  const auto journal = ScanJournal::open(dir / "j");
  ASSERT_TRUE(journal) << journal.error().sentence();
  ASSERT_EQ(journal->views().size(), 1U);
  const CapturedView& back = journal->views().front();
  EXPECT_EQ(back.view, view.view);
  EXPECT_EQ(back.file, view.file);
  EXPECT_EQ(back.table_angle_rad, view.table_angle_rad);
  EXPECT_EQ(back.steps, view.steps);
  EXPECT_EQ(back.sharpness, view.sharpness);
  EXPECT_EQ(back.time_utc, view.time_utc);
}

TEST(ScanJournal, KeepsRemarksBesideTheViews) {
  const TempDir dir;
  {
    auto journal = ScanJournal::open(dir / "j");
    ASSERT_TRUE(journal->append(viewNumber(0)));
    ASSERT_TRUE(journal->append(
        ScanRemark{3, "The camera's \"focus\" 猫\nchanged.", "2026-01-01T12:00:00.000Z"}));
    ASSERT_TRUE(journal->append(viewNumber(1)));
  }
  const auto journal = ScanJournal::open(dir / "j");
  ASSERT_TRUE(journal) << journal.error().sentence();
  EXPECT_THAT(numbersOf(*journal), testing::ElementsAre(0, 1));
  ASSERT_EQ(journal->remarks().size(), 1U);
  EXPECT_EQ(journal->remarks().front().view, 3);
  EXPECT_EQ(journal->remarks().front().text, "The camera's \"focus\" 猫\nchanged.");
  EXPECT_EQ(journal->remarks().front().time_utc, "2026-01-01T12:00:00.000Z");
}

TEST(ScanJournal, CutAnywhereLosesAtMostTheLastView) {
  const TempDir dir;
  std::string whole;
  std::vector<std::size_t> ends;  // of each line
  for (int view = 0; view < 4; ++view) {
    whole += journalLine(viewNumber(view));
    ends.push_back(whole.size());
  }
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    putFile(dir / "j", whole.substr(0, length));
    const auto whole_lines =
        std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end <= length; });
    {
      auto journal = ScanJournal::open(dir / "j");
      ASSERT_TRUE(journal) << journal.error().sentence();
      ASSERT_EQ(static_cast<std::ptrdiff_t>(journal->views().size()), whole_lines);
      if (length % 41 != 0) continue;
      ASSERT_TRUE(journal->append(viewNumber(9)));  // waits for the disk
    }
    EXPECT_EQ(static_cast<std::ptrdiff_t>(ScanJournal::open(dir / "j")->views().size()),
              whole_lines + 1);
  }
}

TEST(ScanJournal, TakesTheLastLineOfAViewAndPassesOverWhatIsNone) {
  const TempDir dir;
  CapturedView again = viewNumber(1);
  again.steps = 42;
  CapturedView outside = viewNumber(2);
  outside.file = "../calibration.json";
  CapturedView negative = viewNumber(-1);
  putFile(dir / "j", journalLine(viewNumber(5)) + "not json\n\n[]\n{\"view\":7}\n" +
                         journalLine(viewNumber(1)) + std::string(20, '\0') + "\n" +
                         journalLine(again) + journalLine(outside) + journalLine(negative));
  const auto journal = ScanJournal::open(dir / "j");
  EXPECT_THAT(numbersOf(*journal), testing::ElementsAre(1, 5));
  EXPECT_EQ(journal->views().front().steps, 42);
}

TEST(ScanJournal, IsHeldByOneProgramAtATime) {
  const TempDir dir;
  {
    const auto first = ScanJournal::open(dir / "j");
    ASSERT_TRUE(first);
    const auto second = ScanJournal::open(dir / "j");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, Error::Code::kBusy);
  }
  EXPECT_TRUE(ScanJournal::open(dir / "j"));
}

TEST(ScanJournal, LeavesNoHalfLineWhenTheDiskTakesNoMore) {
  const TempDir dir;
  auto journal = ScanJournal::open(dir / "j");
  ASSERT_TRUE(journal->append(viewNumber(0)));
  const std::string before_failure = fileText(dir / "j");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{before_failure.size() + 20, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto appended = journal->append(viewNumber(1));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_FALSE(appended);
  EXPECT_EQ(fileText(dir / "j"), before_failure);
  EXPECT_TRUE(journal->append(viewNumber(2)));
}

TEST(ScanJournal, SaysThatTheFolderIsMissing) {
  EXPECT_EQ(ScanJournal::open("/nowhere/journal.jsonl").error().code, Error::Code::kNotFound);
}

TEST(ScanJournal, SurvivesDamage) {
  const TempDir dir;
  std::string whole;
  for (int view = 0; view < 3; ++view) whole += journalLine(viewNumber(view));
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    putFile(dir / "j", mutated(whole, seed));
    const auto journal = ScanJournal::open(dir / "j");
    ASSERT_TRUE(journal) << journal.error().sentence();
  }
}

}  // namespace
}  // namespace gyre
