// Gives a test program of widgets its one application object.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include <QApplication>

#include "ui/scene_canvas.h"

namespace gyre {

// Made before the first test, ended after the last: widgets need it around them.
class QtApplication final : public testing::Environment {
 public:
  void SetUp() override {
    setDefaultSurfaceFormat();
    application_ = std::make_unique<QApplication>(count_, words_);
  }
  void TearDown() override { application_.reset(); }

 private:
  int count_ = 1;
  char name_[5] = "gyre";
  char* words_[2] = {name_, nullptr};
  std::unique_ptr<QApplication> application_;
};

inline testing::Environment* const kQtApplication =
    testing::AddGlobalTestEnvironment(new QtApplication);

}  // namespace gyre
