// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/control_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/formatted.h"

namespace gyre {
namespace {

const ControlState* named(const std::vector<ControlState>& controls, const std::string& name) {
  const auto found = std::find_if(controls.begin(), controls.end(),
                                  [&](const ControlState& each) { return each.name == name; });
  return found == controls.end() ? nullptr : &*found;
}

bool sameValue(const ControlState& a, const ControlState& b) {
  return a.value == b.value && a.word == b.word;
}

std::string valueText(const ControlState& control) {
  return control.word.empty() ? formatted("%g", control.value) : control.word;
}

}  // namespace

ControlWatch::ControlWatch(std::vector<ControlState> at_start) : known_(std::move(at_start)) {
  std::erase_if(known_, [](const ControlState& control) { return !control.locked; });
}

std::vector<std::string> ControlWatch::look(const std::vector<ControlState>& now, int view) {
  std::vector<std::string> sentences;
  for (ControlState& known : known_) {
    const ControlState* present = named(now, known.name);
    if (present == nullptr || (present->locked == known.locked && sameValue(*present, known))) {
      continue;
    }
    const std::string where = " at view " + std::to_string(view + 1) + ".";
    if (!sameValue(*present, known)) {
      sentences.push_back("The camera's " + known.name + " changed from " + valueText(known) +
                          " to " + valueText(*present) + where);
    } else if (!present->locked) {
      sentences.push_back("The camera's " + known.name + " is automatic again" + where);
    }
    known = *present;
  }
  return sentences;
}

Result<void> sameLens(const std::vector<ControlState>& then, const std::vector<ControlState>& now) {
  for (const char* name : {"focus", "zoom"}) {
    const ControlState* before = named(then, name);
    const ControlState* present = named(now, name);
    if (before == nullptr || present == nullptr || !before->locked ||
        sameValue(*before, *present)) {
      continue;
    }
    return Error{Error::Code::kRejected,
                 std::string("The camera's ") + name + " is " + valueText(*present) + "; it was " +
                     valueText(*before) + " when the scan began.",
                 "Set it back: the calibration holds for one lens setting."};
  }
  return {};
}

}  // namespace gyre
