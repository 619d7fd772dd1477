// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sim_target.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/calib/targets/standard_targets.h"
#include "core/io/target_file.h"

namespace gyre {
namespace {

constexpr const char* kUsualTarget = "wedge";
const std::string kTargetWord = "target";

bool isStandard(const std::string& name) {
  const auto& names = standardTargetNames();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Result<Target> findTarget(const std::string& name_or_file) {
  if (!isStandard(name_or_file)) return readTarget(name_or_file);
  auto made = standardTarget(name_or_file);
  if (!made) return made.error();
  return std::move(made->target);
}

void placeObject(const std::string& word, RigSettings& rig) {
  if (word.empty()) return;
  if (!word.starts_with(kTargetWord + ":")) {
    rig.object = word;
    return;
  }
  rig.object = kTargetWord;
  rig.target = word.substr(kTargetWord.size() + 1);
  if (rig.target.empty() || isStandard(rig.target)) return;
  std::error_code failed;
  const auto absolute = std::filesystem::absolute(rig.target, failed);
  if (!failed) rig.target = absolute.string();
}

Result<std::shared_ptr<const PrintedTarget>> simulatedTarget(const RigSettings& rig) {
  std::string name = rig.target;
  if (name.empty() && rig.object == kTargetWord) name = kUsualTarget;
  if (name.empty()) return std::shared_ptr<const PrintedTarget>();
  const auto target = findTarget(name);
  if (!target) return target.error();
  return PrintedTarget::make(*target, rig);
}

}  // namespace gyre
