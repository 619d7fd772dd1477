// Skips a whole test program where the machine has no pseudo terminals.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "tests/support/pty_port.h"

namespace gyre::test {

// To be registered by every test program that makes a PtyPort. A container or chroot may lack
// them (its /dev/pts is not mounted); a missing file system says nothing about the program.
class NeedsPty final : public testing::Environment {
 public:
  void SetUp() override {
    if (!PtyPort::available()) {
      GTEST_SKIP() << "This machine has no pseudo terminals: is devpts mounted at /dev/pts?";
    }
  }
};

}  // namespace gyre::test
