// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command_line.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "app/version.h"

namespace gyre {
namespace {

struct Loudness {
  bool quiet = false;
  bool verbose = false;
};

void addLoudness(CLI::App& command, Loudness& loudness) {
  auto* quiet = command.add_flag("--quiet,-q", loudness.quiet, "Say nothing but errors");
  command.add_flag("--verbose,-v", loudness.verbose, "Say more of what is done")->excludes(quiet);
}

void addSubcommands(CLI::App& app, Loudness& loudness, Run& chosen) {
  for (const auto& add : {addDemo, addScan, addResume, addCalibrate, addReconstruct, addMesh,
                          addMerge, addMeasure, addReport, addExport, addCompare, addReproduce,
                          addPrintTarget, addDevices, addBundle, addSimFirmware}) {
    add(app, chosen);
  }
  for (CLI::App* command : app.get_subcommands({})) addLoudness(*command, loudness);
}

// CLI11's own message, as a sentence.
Error wrongWords(const CLI::App& app, const CLI::ParseError& problem) {
  std::string what = problem.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  if (!what.empty() && what.back() != '.') what += '.';
  const auto given = app.get_subcommands();
  const std::string command = given.empty() ? "gyre" : "gyre " + given.front()->get_name();
  return {Error::Code::kInvalidInput, what, "`" + command + " --help` lists the words."};
}

int runChosen(const Run& chosen, Console& console, const Task& task) try {
  return chosen(console, task);
} catch (const std::bad_alloc&) {
  return console.fail({Error::Code::kInternal, "The memory of this computer does not suffice.",
                       "Close other programs, or use fewer or smaller pictures."});
} catch (const std::exception& problem) {
  return console.fail({Error::Code::kInternal,
                       std::string("Something failed inside: ") + problem.what() + ".",
                       "Please report it with the words you gave."});
}

}  // namespace

int runCommandLine(std::vector<std::string> words, Console& console, std::stop_token stop_token) {
  CLI::App app("Gyre makes measured 3D models, in millimetres, from a turntable and one camera.",
               "gyre");
  app.set_version_flag("--version", std::string("gyre ") + programVersion());
  app.require_subcommand(1);
  Loudness loudness;
  Run chosen;
  addSubcommands(app, loudness, chosen);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
  try {
    app.parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    const auto given = app.get_subcommands();
    console.sayAlways(given.empty() ? app.help() : given.front()->help());
    return kDone;
  } catch (const CLI::CallForVersion& version) {
    console.sayAlways(version.what());
    return kDone;
  } catch (const CLI::ParseError& problem) {
    return console.wrongUse(wrongWords(app, problem));
  }
  if (loudness.quiet) console.setVerbosity(Verbosity::kQuiet);
  if (loudness.verbose) console.setVerbosity(Verbosity::kVerbose);
  return runChosen(chosen, console, console.task(std::move(stop_token)));
}

}  // namespace gyre
