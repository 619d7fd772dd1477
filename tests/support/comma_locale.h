// A country where 0.5 is written 0,5: its locale is made afresh, for few machines have one.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdlib.h>

#include <string>

#include "tests/support/temp_dir.h"

namespace gyre::test {

/// For as long as it lives, programs and setlocale(…, "") of this process find a German locale.
class CommaLocale {
 public:
  CommaLocale() {
    const std::string command =
        "localedef -i de_DE -f UTF-8 '" + (folder_ / "de_DE.UTF-8").string() + "'";
    made_ = std::system(command.c_str()) == 0;
    ::setenv("LOCPATH", folder_.path().c_str(), 1);
    ::setenv("LC_ALL", "de_DE.UTF-8", 1);
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() {
    ::unsetenv("LOCPATH");
    ::setenv("LC_ALL", "C.UTF-8", 1);
  }

  bool made() const { return made_; }

 private:
  TempDir folder_;
  bool made_ = false;
};

}  // namespace gyre::test
