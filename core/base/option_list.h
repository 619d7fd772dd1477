// Options as a flat list: what panels, the command line and files make of an options struct.
//
// An options struct describes itself once:
//   template <class V> void describe(V& visit) {
//     visit({"window", "px", 5, 41, "Side of the square that is compared."}, window_px);
//   }
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace gyre {

// What people are told of an option.
struct OptionInfo {
  std::string name;  // kebab-case, unique within its struct
  std::string unit;  // "mm", "px", "deg", or empty
  double min = 0.0;  // inclusive; ignored for bool and text
  double max = 0.0;  // inclusive
  std::string text;  // one sentence: what it does and when to change it
};

// One option and the field that holds it. The field outlives the list.
struct Option {
  OptionInfo info;
  std::variant<bool*, int*, double*, std::string*> field;

  std::string valueText() const;
  // Sets the field from text; the field is unchanged when the text does not fit type or range.
  Result<void> setFromText(const std::string& text) const;
};

class OptionList {
 public:
  template <class Options>
  static OptionList of(Options& options) {
    OptionList list;
    options.describe(list);
    return list;
  }

  template <class Field>
  void operator()(OptionInfo info, Field& field) {
    options_.push_back({std::move(info), &field});
  }

  const std::vector<Option>& options() const { return options_; }
  const Option* find(const std::string& name) const;

  // Every option's name with its value and unit, as a report tells them.
  std::map<std::string, std::string> texts() const;

  // Fails on the first number that is out of its range or not finite.
  Result<void> validate() const;

 private:
  std::vector<Option> options_;
};

template <class Options>
std::map<std::string, std::string> optionTexts(const Options& options) {
  Options copy = options;
  return OptionList::of(copy).texts();
}

// For a struct's own validate(): checks every described number against its range.
template <class Options>
Result<void> validateRanges(const Options& options) {
  Options copy = options;
  return OptionList::of(copy).validate();
}

}  // namespace gyre
