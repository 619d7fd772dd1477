// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/clean_words.h"

#include <array>
#include <string_view>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/option_words.h"

namespace gyre {
namespace {

constexpr const char* kGroup = "Clean-up";
constexpr std::array<std::string_view, 8> kWords = {"crop-radius",   "z-min",      "z-max",
                                                    "min-component", "fill-holes", "smooth",
                                                    "triangles",     "remesh"};

}  // namespace

void addCleanWords(CLI::App& command, CleanOptions& options) {
  addOptionWords(command, OptionList::of(options), kWords, kGroup);
  command
      .add_flag_callback(
          "--keep-pieces", [&options] { options.min_component_share = 0.0; },
          "Keep all pieces, however small")
      ->excludes("--min-component")
      ->group(kGroup);
  command
      .add_flag("--base-cap", options.base_cap, "Close the rim around the bottom by a flat base")
      ->group(kGroup);
}

}  // namespace gyre
