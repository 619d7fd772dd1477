// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/discovery.h"

#include <unistd.h>

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

// A system of our own: /dev and /sys in a folder.
class DiscoveryTest : public testing::Test {
 protected:
  DiscoveryTest() {
    root_ = fs::temp_directory_path() / ("gyre-discovery-" + std::to_string(getpid()));
    fs::remove_all(root_);
    folders_ = {root_ / "dev", root_ / "sys"};
    fs::create_directories(folders_.dev);
    fs::create_directories(folders_.sys);
  }
  ~DiscoveryTest() override { fs::remove_all(root_); }

  void addCamera(const std::string& node, const std::string& name, const std::string& index) {
    const fs::path known = folders_.sys / "class" / "video4linux" / node;
    fs::create_directories(known);
    std::ofstream(known / "name") << name << "\n";
    std::ofstream(known / "index") << index << "\n";
    std::ofstream(folders_.dev / node) << "";
  }

  fs::path root_;
  DeviceFolders folders_;
};

TEST_F(DiscoveryTest, ListsCamerasByNameAndLeavesOutMetadataNodes) {
  addCamera("video10", "Second camera", "0");
  addCamera("video0", "USB camera: HD", "0");
  addCamera("video1", "USB camera: HD", "1");
  const std::vector<CameraDeviceInfo> cameras = listCameras(folders_);
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].path, (folders_.dev / "video0").string());
  EXPECT_EQ(cameras[0].description, "USB camera: HD");
  EXPECT_TRUE(cameras[0].may_open);
  EXPECT_EQ(cameras[1].description, "Second camera");
}

TEST_F(DiscoveryTest, CameraWithoutDeviceFileHasAHindrance) {
  addCamera("video0", "Ghost", "0");
  fs::remove(folders_.dev / "video0");
  const std::vector<CameraDeviceInfo> cameras = listCameras(folders_);
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_FALSE(cameras[0].may_open);
  EXPECT_THAT(cameras[0].hindrance, HasSubstr("There is no device"));
}

TEST_F(DiscoveryTest, NoCamerasIsAnEmptyList) { EXPECT_THAT(listCameras(folders_), IsEmpty()); }

TEST_F(DiscoveryTest, FindsTheStableNameOfAPort) {
  const fs::path by_id = folders_.dev / "serial" / "by-id";
  fs::create_directories(by_id);
  std::ofstream(folders_.dev / "ttyACM0") << "";
  std::ofstream(folders_.dev / "ttyACM1") << "";
  fs::create_symlink("../../ttyACM0", by_id / "usb-Arduino_Uno_123-if00");
  fs::create_symlink("../../ttyACM9", by_id / "usb-unplugged");
  EXPECT_EQ(stablePathOf(folders_.dev / "ttyACM0", folders_),
            (by_id / "usb-Arduino_Uno_123-if00").string());
  EXPECT_THAT(stablePathOf(folders_.dev / "ttyACM1", folders_), IsEmpty());
  EXPECT_THAT(stablePathOf(folders_.dev / "ttyACM7", folders_), IsEmpty());
}

TEST_F(DiscoveryTest, ListsPortsOfThisMachineWithAWordOnEach) {
  for (const PortInfo& port : listPorts()) {
    EXPECT_THAT(port.path, HasSubstr("/dev/"));
    EXPECT_FALSE(port.description.empty());
    EXPECT_EQ(port.may_open, port.hindrance.empty());
  }
}

}  // namespace
}  // namespace gyre
