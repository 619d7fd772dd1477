// The program with a window.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

namespace gyre {

struct GuiOptions {
  std::filesystem::path open;        // a scan or a model to begin with; empty: the start page
  std::filesystem::path screenshot;  // draws one scene into this file and ends; empty: a window
  std::string scene;            // of the screenshot: start, scan, mesh, clean, measure or a page
                                // of the calibration wizard
  std::string object = "duck";  // on the table of the screenshot
  std::string theme = "light";  // of the screenshot: light or dark
  std::stop_token stop;         // requested by a signal: the window closes as by hand
};

// Opens the window and returns its exit code when it is closed: 0, or 1 with a sentence on standard
// error when there is no display. A screenshot needs no display.
int runGui(int argc, char** argv, const GuiOptions& options);

}  // namespace gyre
