// Lets commands paint with Qt where no screen is.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include <QGuiApplication>

namespace gyre {

// Fonts need an application object; the platform "offscreen" needs no screen. Where there is one
// already, that serves. GUI thread, or a program without one.
class ScreenlessApplication {
 public:
  ScreenlessApplication() {
    if (QCoreApplication::instance() == nullptr) {
      application_ = std::make_unique<QGuiApplication>(count_, words_.data());
    }
  }

 private:
  std::array<char, 5> program_{"gyre"};
  std::array<char, 10> option_{"-platform"};
  std::array<char, 10> platform_{"offscreen"};
  std::array<char*, 4> words_ = {program_.data(), option_.data(), platform_.data(), nullptr};
  int count_ = 3;
  std::unique_ptr<QGuiApplication> application_;
};

}  // namespace gyre
