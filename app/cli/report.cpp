// gyre report: report.html once more, of what lies in a result's folder now.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/cli/subcommands.h"
#include "core/pipeline/report_page.h"

namespace gyre {
namespace {

int run(const std::string& input, Console& console) {
  std::filesystem::path folder = input;
  if (folder.extension() == ".gyre") folder = std::filesystem::absolute(folder).parent_path();
  if (const auto done = writeReportPage(folder); !done) return console.fail(done.error());
  console.say((folder / "report.html").string() + " is written.");
  return kDone;
}

}  // namespace

void addReport(CLI::App& app, Run& chosen) {
  auto input = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("report", "Write a result's report.html anew, with its pictures");
  command->add_option("result", *input, "A result's folder or a scan")->required();
  command->callback([&chosen, input] {
    chosen = [input](Console& console, const Task&) { return run(*input, console); };
  });
}

}  // namespace gyre
