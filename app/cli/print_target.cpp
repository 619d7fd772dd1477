// gyre print-target: calibration targets to print, at true size.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/print_target.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"

namespace gyre {
namespace {

constexpr const char* kAll = "all";

struct Words {
  std::string page;
  std::string target = kAll;
  std::string out;
};

int run(const Words& words, Console& console, const Task& task) {
  const auto page = pageSize(words.page);
  if (!page) {
    return console.wrongUse({Error::Code::kInvalidInput,
                             "There is no page '" + words.page + "' to print on.",
                             "Give --page a4 or --page letter."});
  }
  std::vector<std::string> names = {words.target};
  if (words.target == kAll) names = standardTargetNames();
  for (const std::string& name : names) {
    if (task.stopRequested()) return console.fail(cancelled());
    const auto target = standardTarget(name);
    if (!target) return console.wrongUse(target.error());
    if (const auto done = printTarget(*target, *page, words.out); !done) {
      return console.fail(done.error());
    }
    console.say(words.out + "/" + name + ".pdf: " + target->title + ". " + target->purpose);
  }
  console.say("Print at 100 %, do not fit to page; then measure both rulers with a caliper.");
  return kDone;
}

}  // namespace

void addPrintTarget(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("print-target", "Write calibration targets to print, at true size");
  command->add_option("--page", words->page, "The paper: a4 or letter")->required();
  std::string known = "One of all (default)";
  for (const std::string& name : standardTargetNames()) known += ", " + name;
  command->add_option("--target", words->target, known);
  command->add_option("--out", words->out, "Folder for the PDFs and their target files")
      ->required();
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
