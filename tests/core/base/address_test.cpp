// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/address.h"

#include <utility>

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(WithoutPassword, RemovesOnlyWhatIsSecret) {
  const std::pair<std::string, std::string> cases[] = {
      {"/dev/video0", "/dev/video0"},
      {"me:pw@home", "me:pw@home"},
      {"sim", "sim"},
      {"http://host/a@b", "http://host/a@b"},
      {"http://host:80/a@b", "http://host:80/a@b"},
      {"rtsp://u:p@host/x", "rtsp://u:***@host/x"},
      {"rtsp://u@host/x", "rtsp://***@host/x"},
      {"rtsp://u:p@ss@host/x", "rtsp://u:***@host/x"},
      {"rtsp://u:p/w@host/x", "rtsp://u:***@host/x"},
      {"rtsp://u:p?w@host/x", "rtsp://u:***@host/x"},
      {"http://u:p@[::1]:80/x", "http://u:***@[::1]:80/x"},
      {"http://[::1]:80/x@y", "http://[::1]:80/x@y"},
      {"http://h/x?loginpas=s&PWD=s&b=2#part", "http://h/x?loginpas=s&PWD=***&b=2#part"},
      {"http://h/x?token=s", "http://h/x?token=***"},
      {"http://", "http://"},
  };
  for (const auto& [address, kept] : cases) EXPECT_EQ(withoutPassword(address), kept);
  for (const auto& [address, kept] : cases) {
    EXPECT_EQ(withoutPassword(kept), kept) << "a second time";
    EXPECT_EQ(lacksPassword(kept), kept != address) << kept;
  }
}

}  // namespace
}  // namespace gyre
