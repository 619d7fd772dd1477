// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/scan_words.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "app/sim_target.h"
#include "core/io/file_bytes.h"
#include "core/sim/rig_json.h"

namespace gyre {
namespace {

constexpr std::uintmax_t kMaxRigBytes = 1U << 20U;

}  // namespace

void addSimWords(CLI::App& command, SimWords& words) {
  command.add_option("--rig", words.rig_file, "Settings of the simulated rig, a JSON file");
  command.add_option("--seed", words.seed, "Chooses texture, noise and motor errors of the rig")
      ->check(CLI::Range(0, 2147483647));
  command.add_flag("--glossy", words.glossy, "Make the simulated object shine");
  command.add_option("--sim-speed", words.speed, "Simulated seconds a second (default 10)")
      ->check(CLI::Range(0.1, 1000.0));
}

void addUnlockWord(CLI::App& command, bool& unlock) {
  command.add_flag("--unlock", unlock,
                   "Unlock a board that is locked at its start; only when it is your turntable");
}

UnlockWord unlockWord(bool unlock) { return unlock ? UnlockWord::kGiven : UnlockWord::kAsk; }

Result<RigSettings> simulatedRig(const SimWords& words, const std::string& object) {
  RigSettings rig;
  if (!words.rig_file.empty()) {
    const auto text = readFileBytes(words.rig_file, kMaxRigBytes);
    if (!text) return text.error();
    const auto read = rigFromJson(*text);
    if (!read) return read.error();
    rig = *read;
  }
  if (words.seed >= 0) rig.seed = words.seed;
  if (words.glossy) rig.material = "glossy";
  placeObject(object, rig);
  if (const auto valid = rig.validate(); !valid) return valid.error();
  return rig;
}

}  // namespace gyre
