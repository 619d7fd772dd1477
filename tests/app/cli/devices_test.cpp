// Every simulated firmware, over the network: who it is, and that a bad port is told in words.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/table_at_port.h"
#include "core/device/find_table.h"
#include "core/sim/firmware_boards.h"
#include "core/sim/firmware_server.h"
#include "tests/support/command_answer.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

class DevicesTest : public testing::TestWithParam<std::string> {
 protected:
  DevicesTest() { setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1); }
  std::string serve(const std::string& firmware) {
    const auto board = std::make_shared<TurntableFirmware>(
        makeFirmwareBoard(firmware, TurntableFirmwareOptions{}, shaft_), SimClock(50.0));
    server_ = *FirmwareServer::start(board, 0);
    return "tcp:127.0.0.1:" + std::to_string(server_->port());
  }

  TempDir cache_;
  std::shared_ptr<Shaft> shaft_ = std::make_shared<Shaft>();
  std::unique_ptr<FirmwareServer> server_;
};

TEST_P(DevicesTest, ProbeNamesTheFirmwareByItself) {
  const std::string port = serve(GetParam());
  const test::Answer answer = test::gyre({"devices", "--probe", port, "--json"});
  EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_THAT(json["state"].get<std::string>(), testing::AnyOf("turntable", "hindered"));
  EXPECT_FALSE(json["firmware"].get<std::string>().empty());
  EXPECT_GT(json["steps_per_turn"].get<double>(), 0.0);
  EXPECT_EQ(shaft_->steps(), 0);
  EXPECT_THAT(fileText(wireLogFile(port)), HasSubstr("opened " + port));
}

INSTANTIATE_TEST_SUITE_P(Firmwares, DevicesTest, testing::ValuesIn(firmwareWords()),
                         [](const auto& firmware) { return firmware.param; });

class OneDeviceTest : public DevicesTest {};

TEST_P(OneDeviceTest, ProbeByItsNameAndByItsDescription) {
  EXPECT_EQ(test::gyre({"devices", "--probe", "marlin:" + serve("marlin")}).code, 0);
  const std::string described = std::string(GYRE_TURNTABLES) + "/workshop.json:";
  const test::Answer answer = test::gyre({"devices", "--probe", described + serve("workshop")});
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("Workshop table"));
}

TEST_P(OneDeviceTest, WrongNameIsToldWithWhatWasHeard) {
  const test::Answer answer = test::gyre({"devices", "--probe", "sardauscan:" + serve("marlin")});
  EXPECT_EQ(answer.code, 1);
  EXPECT_THAT(answer.err, HasSubstr("does not speak Sardauscan"));
}

TEST_P(OneDeviceTest, ClosedPortIsTold) {
  const test::Answer answer = test::gyre({"devices", "--probe", "tcp:127.0.0.1:1", "--json"});
  EXPECT_EQ(answer.code, 1);
  EXPECT_FALSE(nlohmann::json::parse(answer.out)["what"].get<std::string>().empty());
}

TEST_P(OneDeviceTest, WordsThatNameNoPortAreWrongUse) {
  EXPECT_EQ(test::gyre({"devices", "--probe", "hand"}).code, 2);
  EXPECT_EQ(test::gyre({"devices", "--probe", "marlin:"}).code, 2);
  EXPECT_EQ(test::gyre({"devices", "--probe", "sim"}).code, 2);
  EXPECT_EQ(test::gyre({"sim-firmware", "--tcp", "0", "--firmware", "klipper"}).code, 2);
}

TEST_P(OneDeviceTest, ListIsWholeJson) {
  const test::Answer answer = test::gyre({"devices", "--json"});
  EXPECT_EQ(answer.code, 0);
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_TRUE(json["ports"].is_array());
  EXPECT_TRUE(json["adapters"].is_array());
  EXPECT_TRUE(json["cameras"].is_array());
}

INSTANTIATE_TEST_SUITE_P(Once, OneDeviceTest, testing::Values("grbl"));

}  // namespace
}  // namespace gyre
