// gyre bundle: what somebody else needs to find out what went wrong with a scan, in one file.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/bundle.h"
#include "app/cli/subcommands.h"

namespace gyre {
namespace {

struct Words {
  std::string scan;
  std::string out;
  bool with_pictures = false;
};

int run(const Words& words, Console& console, const Task& task) {
  const auto bundled =
      writeBundle(words.scan, words.out,
                  words.with_pictures ? BundlePictures::kInclude : BundlePictures::kLeaveOut, task);
  if (!bundled) return console.fail(bundled.error());
  const std::string pictures = bundled->pictures > 0
                                   ? std::to_string(bundled->pictures) + " of them pictures"
                                   : std::string("no pictures");
  console.say(words.out + ": " + std::to_string(bundled->files) + " files, " + pictures + ".");
  console.say("Look through it before you hand it on: it names your ports and folders.");
  return kDone;
}

}  // namespace

void addBundle(CLI::App& app, Run& chosen) {
  auto words = std::make_shared<Words>();
  CLI::App* command =
      app.add_subcommand("bundle", "Pack a scan's records and logs, to ask somebody for help");
  command->add_option("scan", words->scan, "The scan's folder, or the .gyre file in it")
      ->required();
  command->add_option("--out", words->out, "FILE.tar.gz or FILE.zip")->required();
  command->add_flag("--with-pictures", words->with_pictures, "Pictures and points too");
  command->callback([&chosen, words] {
    chosen = [words](Console& console, const Task& task) { return run(*words, console, task); };
  });
}

}  // namespace gyre
