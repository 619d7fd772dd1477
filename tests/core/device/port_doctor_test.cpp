// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/port_doctor.h"

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Code = Error::Code;

// A system of our own.
class PortDoctorTest : public testing::Test {
 protected:
  PortDoctorTest() {
    view_.folders = {root_ / "dev", root_ / "sys"};
    view_.proc = root_ / "proc";
    view_.rules = root_.path();
    view_.hindrance = [this](const std::string&) { return hindrance_; };
    fs::create_directories(view_.folders.dev);
    port_ = putFile(view_.folders.dev / "ttyUSB0", "").string();
  }
  void addProgram(const std::string& number, const std::string& name, const fs::path& holds = {}) {
    fs::create_directories(view_.proc / number / "fd");
    putFile(view_.proc / number / "comm", name + "\n");
    if (!holds.empty()) fs::create_symlink(holds, view_.proc / number / "fd" / "7");
  }
  fs::path addAdapter(const std::string& vendor, const std::string& product) {
    const fs::path device = view_.folders.sys / "bus/usb/devices/1-2";
    fs::create_directories(device / "1-2:1.0");
    putFile(device / "idVendor", vendor + "\n");
    putFile(device / "idProduct", product + "\n");
    return device;
  }
  static TableSearch failed(Code code, std::vector<TableAnswer> answers = {}) {
    TableSearch search;
    search.error = Error{code, "What.", "Advice."};
    search.answers = std::move(answers);
    return search;
  }

  TempDir root_;
  DoctorView view_;
  std::string port_;
  std::optional<Error> hindrance_;
};

TEST_F(PortDoctorTest, FreePortIsReadyToBeAsked) {
  addProgram("100", "bash", "/dev/null");
  const PortDiagnosis found = diagnosePort(port_, view_);
  EXPECT_EQ(found.state, PortState::kReady);
  EXPECT_THAT(found.advice, HasSubstr("--probe " + port_));
}

TEST_F(PortDoctorTest, HolderOfABusyPortIsNamed) {
  addProgram("100", "bash", "/dev/null");
  addProgram("4711", "cura", fs::canonical(port_));
  addProgram("self", "gyre", fs::canonical(port_));  // no number: no program
  const PortDiagnosis found = diagnosePort(port_, view_);
  EXPECT_EQ(found.state, PortState::kBusy);
  EXPECT_EQ(found.held_by, "cura (4711)");
  EXPECT_THAT(found.what, HasSubstr("cura (4711)"));
}

TEST_F(PortDoctorTest, BusyPortWithoutAVisibleHolderKeepsItsOwnWords) {
  const PortDiagnosis found = diagnoseSearch(port_, failed(Code::kBusy), {}, view_);
  EXPECT_EQ(found.state, PortState::kBusy);
  EXPECT_THAT(found.held_by, IsEmpty());
  EXPECT_EQ(found.what, "What.");
}

TEST_F(PortDoctorTest, MissingPermissionComesWithTheRuleUnlessItIsInstalled) {
  hindrance_ = Error{Code::kNoPermission, "You may not.", "Run \"sudo usermod ...\"."};
  PortDiagnosis found = diagnosePort(port_, view_);
  EXPECT_EQ(found.state, PortState::kNoPermission);
  EXPECT_THAT(found.advice, HasSubstr("usermod"));
  EXPECT_THAT(found.advice, HasSubstr("70-gyre.rules"));
  fs::create_directories(root_ / "usr/lib/udev/rules.d");
  putFile(root_ / "usr/lib/udev/rules.d/70-gyre.rules", "");
  found = diagnosePort(port_, view_);
  EXPECT_THAT(found.advice, Not(HasSubstr("70-gyre.rules")));
}

TEST_F(PortDoctorTest, MissingPortIsNoDevice) {
  hindrance_ = Error{Code::kNotFound, "There is none.", "Plug it in."};
  EXPECT_EQ(diagnosePort("/dev/ttyUSB9", view_).state, PortState::kNoDevice);
}

TEST_F(PortDoctorTest, AdapterWithItsPortIsNoTrouble) {
  const fs::path device = addAdapter("1a86", "7523");
  fs::create_directories(device / "1-2:1.0/ttyUSB0");
  addProgram("55", "brltty");
  EXPECT_THAT(diagnoseAdapters(view_), IsEmpty());
}

TEST_F(PortDoctorTest, AdapterThatBrlttyGrabsGetsARuleOfItsOwn) {
  addAdapter("1a86", "7523");
  addProgram("55", "brltty");
  const auto found = diagnoseAdapters(view_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].state, PortState::kGrabbed);
  EXPECT_THAT(found[0].advice, HasSubstr("ATTR{idVendor}==\"1a86\", ATTR{idProduct}==\"7523\""));
  EXPECT_THAT(found[0].advice, Not(HasSubstr("remove")));
}

TEST_F(PortDoctorTest, AdapterWithoutADriverNamesIt) {
  addAdapter("1a86", "7523");
  const auto found = diagnoseAdapters(view_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].state, PortState::kNoDriver);
  EXPECT_THAT(found[0].advice, HasSubstr("modprobe ch341"));
}

TEST_F(PortDoctorTest, OtherUsbDevicesAreNobodysBusiness) {
  addAdapter("046d", "c52b");
  EXPECT_THAT(diagnoseAdapters(view_), IsEmpty());
}

TEST_F(PortDoctorTest, TellsApartWhatAnswers) {
  const TableAnswer nothing{115200, "(nothing)", "", false};
  const TableAnswer garbage{115200, "(nothing)", ".\x7f..", false};
  const TableAnswer words{57600, "M115", "coffee", true};
  const auto state = [&](const TableSearch& search) {
    return diagnoseSearch(port_, search, {}, view_).state;
  };
  EXPECT_EQ(state(failed(Code::kTimeout, {nothing})), PortState::kSilent);
  EXPECT_EQ(state(failed(Code::kWrongDevice, {nothing, garbage})), PortState::kGarbled);
  EXPECT_EQ(state(failed(Code::kWrongDevice, {garbage, words})), PortState::kUnknownFirmware);
  EXPECT_EQ(state(failed(Code::kBusy, {nothing})), PortState::kMoving);
  EXPECT_EQ(state(failed(Code::kGone, {nothing})), PortState::kGone);
  EXPECT_EQ(state(failed(Code::kIo)), PortState::kFailed);
}

TEST_F(PortDoctorTest, TurntableIsToldWithWhatHindersIt) {
  TableSearch search;
  search.firmware = "grbl";
  search.baud = 115200;
  TurntableInfo info;
  info.firmware = "Grbl 1.1h";
  info.steps_per_turn = 3200.0;
  PortDiagnosis found = diagnoseSearch(port_, search, info, view_);
  EXPECT_EQ(found.state, PortState::kTurntable);
  EXPECT_EQ(found.firmware, "Grbl 1.1h");
  EXPECT_EQ(found.baud, 115200);
  info.hindrances = {"Soft limits are on."};
  found = diagnoseSearch(port_, search, info, view_);
  EXPECT_EQ(found.state, PortState::kHindered);
  EXPECT_THAT(found.hindrances, ElementsAre("Soft limits are on."));
  info.lock = "It is locked. Allow that it is unlocked.";
  found = diagnoseSearch(port_, search, info, view_);
  EXPECT_EQ(found.state, PortState::kLocked);
  EXPECT_EQ(portStateWord(found.state), "locked");
  EXPECT_EQ(found.advice, info.lock);
  EXPECT_THAT(found.hindrances, ElementsAre("Soft limits are on."));
}

TEST_F(PortDoctorTest, MotorThatStandsIsAStateOfItsOwn) {
  const PortDiagnosis found = diagnoseMotor(port_, {Code::kRejected, "It stands.", "Power?"});
  EXPECT_EQ(found.state, PortState::kMotorStands);
  EXPECT_EQ(portStateWord(found.state), "motor-stands");
  EXPECT_EQ(portStateWord(PortState::kReady), "ready");
  EXPECT_EQ(portStateWord(PortState::kFailed), "failed");
}

}  // namespace
}  // namespace gyre
