// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/find_table.h"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sim/firmware_boards.h"
#include "tests/support/stepped_wire.h"

namespace gyre {
namespace {

using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::Not;
using Code = Error::Code;

// A port at the wrong speed: what passes through it is as good as random.
class GarblingPort final : public BytePort {
 public:
  explicit GarblingPort(std::unique_ptr<BytePort> port) : port_(std::move(port)) {}
  Result<std::size_t> read(std::span<std::byte> buffer, double timeout_s) override {
    const Result<std::size_t> count = port_->read(buffer, timeout_s);
    for (std::size_t i = 0; count && i < *count; ++i) buffer[i] = garbled(buffer[i]);
    return count;
  }
  Result<void> write(std::span<const std::byte> bytes, double timeout_s) override {
    std::string sent;
    for (const std::byte byte : bytes) sent += static_cast<char>(garbled(byte));
    return port_->write(std::as_bytes(std::span(sent)), timeout_s);
  }
  double seconds() const override { return port_->seconds(); }
  std::string name() const override { return port_->name(); }

 private:
  static std::byte garbled(std::byte byte) { return (byte ^ std::byte{0xe5}) | std::byte{0x80}; }
  std::unique_ptr<BytePort> port_;
};

// Something that repeats one sentence, or nothing at all.
class ParrotBoard final : public FirmwareBoard {
 public:
  explicit ParrotBoard(std::string sentence) : sentence_(std::move(sentence)) {}
  void reset(double) override {}
  void receive(std::span<const std::byte>, double) override { output_ += sentence_; }
  void advanceTo(double) override {}
  void pressLimitSwitch(double) override {}
  std::string takeOutput() override { return std::exchange(output_, {}); }
  bool busy() const override { return false; }

 private:
  std::string sentence_;
  std::string output_;
};

// A board that does not restart when its port is opened: one without the DTR line.
class StaysOn final : public FirmwareBoard {
 public:
  explicit StaysOn(std::unique_ptr<FirmwareBoard> board) : board_(std::move(board)) {
    board_->reset(0.0);
  }
  void reset(double) override {}
  void receive(std::span<const std::byte> bytes, double time_s) override {
    board_->receive(bytes, time_s);
  }
  void advanceTo(double time_s) override { board_->advanceTo(time_s); }
  void pressLimitSwitch(double time_s) override { board_->pressLimitSwitch(time_s); }
  std::string takeOutput() override { return board_->takeOutput(); }
  bool busy() const override { return board_->busy(); }

 private:
  std::unique_ptr<FirmwareBoard> board_;
};

// A GRBL board that stays on, to which somebody has said something before.
class RunningGrbl {
 public:
  explicit RunningGrbl(std::string_view said)
      : room_(std::make_unique<StaysOn>(
            makeFirmwareBoard("grbl", TurntableFirmwareOptions{}, shaft_))) {
    room_.pass(1.0);
    room_.board().receive(std::as_bytes(std::span(said)), room_.seconds());
    room_.pass(0.1);
  }
  test::SteppedRoom& room() { return room_; }

 private:
  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  test::SteppedRoom room_;
};

PortOpener openerOf(test::SteppedRoom& room, int true_baud) {
  return [&room, true_baud](int baud) -> Result<std::unique_ptr<BytePort>> {
    auto port = room.openPort("the wire");
    if (baud == true_baud) return port;
    return std::unique_ptr<BytePort>(std::make_unique<GarblingPort>(std::move(port)));
  };
}

class FindTableTest : public testing::TestWithParam<std::string> {};

TEST_P(FindTableTest, NamesTheFirmwareAtItsOwnSpeedAndMovesNothing) {
  for (const int baud : usualBauds("")) {
    const auto shaft = std::make_shared<Shaft>();
    test::SteppedRoom room(makeFirmwareBoard(GetParam(), TurntableFirmwareOptions{}, shaft));
    const TableSearch search = findTable(openerOf(room, baud), usualBauds(""), 2.0, Task());
    ASSERT_FALSE(search.error) << search.error->sentence();
    ASSERT_TRUE(search.driver);
    EXPECT_EQ(search.firmware, GetParam());
    EXPECT_EQ(search.baud, baud);
    EXPECT_LT(room.seconds(), 60.0);
    room.pass(3.0);
    EXPECT_EQ(shaft->steps(), 0);
  }
}

TEST_P(FindTableTest, FindsTheOneThatIsNamed) {
  const int baud = usualBauds(GetParam()).back();
  test::SteppedRoom room(
      makeFirmwareBoard(GetParam(), TurntableFirmwareOptions{}, std::make_shared<Shaft>()));
  const TableSearch search =
      findTable(GetParam(), openerOf(room, baud), usualBauds(GetParam()), 2.0, Task());
  ASSERT_TRUE(search.driver) << search.error->sentence();
  EXPECT_EQ(search.baud, baud);
}

TEST_P(FindTableTest, OthersRefuseIt) {
  for (const std::string& other : firmwareWords()) {
    if (other == GetParam()) continue;
    const auto shaft = std::make_shared<Shaft>();
    test::SteppedRoom room(makeFirmwareBoard(GetParam(), TurntableFirmwareOptions{}, shaft));
    const TableSearch search = findTable(other, openerOf(room, 115200), {115200}, 1.0, Task());
    EXPECT_FALSE(search.driver) << other;
    ASSERT_TRUE(search.error);
    EXPECT_TRUE(search.error->code == Code::kWrongDevice || search.error->code == Code::kTimeout)
        << search.error->sentence();
    EXPECT_EQ(shaft->steps(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Firmwares, FindTableTest, testing::ValuesIn(firmwareWords()),
                         [](const auto& firmware) { return firmware.param; });

TEST(FindTable, SilenceIsATimeout) {
  test::SteppedRoom room(std::make_unique<ParrotBoard>(""));
  const TableSearch search = findTable(openerOf(room, 115200), {115200, 57600}, 1.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kTimeout);
  EXPECT_THAT(search.answers, Each(Field(&TableAnswer::heard, "")));
}

TEST(FindTable, WhatAnUnknownFirmwareSaysIsTold) {
  test::SteppedRoom room(std::make_unique<ParrotBoard>("Coffee machine ready\r\n"));
  const TableSearch search = findTable(openerOf(room, 57600), {115200, 57600}, 1.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kWrongDevice);
  EXPECT_THAT(search.error->what, HasSubstr("Coffee machine"));
  EXPECT_TRUE(search.answers.back().legible);
}

TEST(FindTable, GarbageAtEverySpeedIsSaidToBeTheSpeed) {
  test::SteppedRoom room(std::make_unique<ParrotBoard>("Grbl 1.1h ['$' for help]\r\n"));
  const TableSearch search = findTable(openerOf(room, 19200), {115200, 57600}, 1.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kWrongDevice);
  EXPECT_THAT(search.error->what, HasSubstr("garbled"));
}

TEST(FindTable, MachineThatMovesIsLeftAlone) {
  test::SteppedRoom room(std::make_unique<ParrotBoard>("<Run|MPos:1.000,0.000,0.000|FS:9,0>\r\n"));
  const TableSearch search = findTable(openerOf(room, 115200), {115200, 57600}, 1.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kBusy);
  EXPECT_THAT(room.sent(), Not(HasSubstr("\x18")));
}

TEST(FindTable, MachineThatStillSlowsDownIsLeftAlone) {
  for (const char* report : {"<Hold:1|MPos:1.000,0.000,0.000|FS:9,0>\r\n",
                             "<Door:2|MPos:1.000,0.000,0.000|FS:9,0>\r\n"}) {
    for (const char* firmware : {"", "grbl"}) {
      test::SteppedRoom room(std::make_unique<ParrotBoard>(report));
      const PortOpener open = openerOf(room, 115200);
      const TableSearch search = *firmware == 0 ? findTable(open, {115200}, 0.5, Task())
                                                : findTable(firmware, open, {115200}, 0.5, Task());
      ASSERT_TRUE(search.error);
      EXPECT_EQ(search.error->code, Code::kBusy) << search.error->sentence();
      EXPECT_THAT(room.sent(), Not(HasSubstr("\x18")));
    }
  }
}

TEST(FindTable, WorkThatWasPausedIsNotThrownAway) {
  RunningGrbl grbl("G1X90F600\n!");
  const TableSearch search = findTable(openerOf(grbl.room(), 115200), {115200}, 2.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kBusy);
  EXPECT_THAT(search.error->what, HasSubstr("paused"));
  EXPECT_THAT(grbl.room().sent(), Not(HasSubstr("\x18")));
}

TEST(FindTable, BoardThatSleepsOrLetsGoOfItsMotorFirstIsWaitedFor) {
  for (const char* said : {"$SLP\n", "$1=254\n", "$20=1\nG1X90F600\n"}) {
    RunningGrbl grbl(said);
    const TableSearch search = findTable(openerOf(grbl.room(), 115200), {115200}, 2.0, Task());
    EXPECT_FALSE(search.error) << said << search.error->sentence();
    EXPECT_EQ(search.firmware, "grbl");
    EXPECT_TRUE(search.driver);
  }
}

TEST(FindTable, PortThatMayNotBeOpenedEndsTheSearch) {
  int opened = 0;
  const PortOpener refused = [&](int) -> Result<std::unique_ptr<BytePort>> {
    ++opened;
    return Error{Error::Code::kNoPermission, "No.", "Join the group."};
  };
  const TableSearch search = findTable(refused, {115200, 57600}, 1.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kNoPermission);
  EXPECT_EQ(opened, 1);
}

TEST(FindTable, AdapterThatKnowsNoSuchSpeedIsAskedAtTheOthers) {
  test::SteppedRoom room(std::make_unique<ParrotBoard>(""));
  std::vector<int> opened;
  const PortOpener open = [&](int baud) -> Result<std::unique_ptr<BytePort>> {
    opened.push_back(baud);
    if (baud == 250000) return Error{Code::kIo, "No such speed.", ""};
    return room.openPort("the wire");
  };
  const TableSearch search = findTable(open, {115200, 250000, 9600}, 1.0, Task());
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kTimeout);
  EXPECT_EQ(opened, (std::vector<int>{115200, 250000, 9600}));
}

TEST(FindTable, CancelEndsItAtOnce) {
  test::SteppedRoom room(std::make_unique<ParrotBoard>(""));
  std::stop_source source;
  room.at(2.5, [&] { source.request_stop(); });
  const TableSearch search =
      findTable(openerOf(room, 115200), usualBauds(""), 2.0, Task(source.get_token()));
  ASSERT_TRUE(search.error);
  EXPECT_EQ(search.error->code, Code::kCancelled);
  EXPECT_LT(room.seconds(), 2.6);
}

}  // namespace
}  // namespace gyre
