// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/device/gphoto_words.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(GphotoWords, ReadNumbersAsCamerasWriteThem) {
  EXPECT_DOUBLE_EQ(numberInWord("1/125"), 0.008);
  EXPECT_DOUBLE_EQ(numberInWord("f/5.6"), 5.6);
  EXPECT_DOUBLE_EQ(numberInWord("0.4"), 0.4);
  EXPECT_DOUBLE_EQ(numberInWord("1/0"), 0.0);
  for (const char* word : {"", "Daylight", "f/", "auto", "/2"}) {
    EXPECT_EQ(numberInWord(word), 0.0) << word;
  }
}

TEST(GphotoWords, TellJpegPicturesByTheirNames) {
  EXPECT_TRUE(namesJpeg("IMG_0001.JPG"));
  EXPECT_TRUE(namesJpeg("a.jpeg"));
  for (const char* name : {"IMG_0001.CR2", "", "jpg", "a.jpg.tmp"}) EXPECT_FALSE(namesJpeg(name));
}

TEST(GphotoWords, GiveANetworkCameraBothItsPorts) {
  EXPECT_EQ(ptpIpPortFor("ptpip:camera.local"), "ptpip:camera.local:15740:15740");
  EXPECT_EQ(ptpIpPortFor("ptpip:10.0.0.7:1234"), "ptpip:10.0.0.7:1234:1234");
  EXPECT_EQ(ptpIpPortFor("ptpip:10.0.0.7:1234:1234"), "ptpip:10.0.0.7:1234:1234");
  EXPECT_EQ(ptpIpPortFor("ptpip:10.0.0.7:"), "ptpip:10.0.0.7:15740:15740");
}

}  // namespace
}  // namespace gyre
