// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/pipe_port.h"

#include <array>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/clock.h"

namespace gyre {
namespace {

Result<void> writeText(BytePort& port, std::string_view text) {
  return port.write(std::as_bytes(std::span(text)), 0.1);
}

std::string readText(BytePort& port, double timeout_s) {
  std::array<std::byte, 64> buffer{};
  const Result<std::size_t> count = port.read(buffer, timeout_s);
  if (!count) return "!";
  std::string text;
  for (const std::byte byte : std::span(buffer).first(*count)) text += static_cast<char>(byte);
  return text;
}

TEST(PipePort, CarriesBothWays) {
  auto [host, device] = PipePort::makePair("pipe");
  ASSERT_TRUE(writeText(*host, "there"));
  ASSERT_TRUE(writeText(*device, "back"));
  EXPECT_EQ(readText(*device, 0.0), "there");
  EXPECT_EQ(readText(*host, 0.0), "back");
  EXPECT_EQ(host->name(), "pipe");
}

TEST(PipePort, ReadGivesNothingAfterItsTime) {
  auto [host, device] = PipePort::makePair("pipe");
  const double begin_s = steadySeconds();
  EXPECT_EQ(readText(*host, 0.03), "");
  EXPECT_GE(steadySeconds() - begin_s, 0.03);
}

TEST(PipePort, ReadWakesWhenBytesCome) {
  auto [host, device] = PipePort::makePair("pipe");
  const std::jthread writer([&device = device] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_TRUE(writeText(*device, "x"));
  });
  EXPECT_EQ(readText(*host, 10.0), "x");
}

TEST(PipePort, WhatWasWrittenBeforeTheEndIsStillRead) {
  auto [host, device] = PipePort::makePair("pipe");
  ASSERT_TRUE(writeText(*device, "last words"));
  device.reset();
  EXPECT_EQ(readText(*host, 0.1), "last words");
  std::array<std::byte, 8> buffer{};
  const Result<std::size_t> count = host->read(buffer, 10.0);
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().code, Error::Code::kGone);
  const Result<void> written = writeText(*host, "hello?");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Error::Code::kGone);
}

TEST(PipePort, WriteTimesOutWhenNobodyReads) {
  auto [host, device] = PipePort::makePair("pipe");
  const std::vector<std::byte> much(40000);
  ASSERT_TRUE(host->write(much, 0.1));
  const Result<void> written = host->write(much, 0.01);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Error::Code::kTimeout);
}

}  // namespace
}  // namespace gyre
