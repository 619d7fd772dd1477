// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/rig_json.h"

#include <algorithm>
#include <variant>

#include <nlohmann/json.hpp>

#include "core/base/option_list.h"

namespace gyre {
namespace {

std::string keyOf(const Option& option) {
  std::string key = option.info.name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

bool assign(const Option& option, const nlohmann::json& value) {
  return std::visit(
      [&](auto* field) {
        using Field = std::remove_pointer_t<decltype(field)>;
        const bool fits = std::is_same_v<Field, bool>          ? value.is_boolean()
                          : std::is_same_v<Field, std::string> ? value.is_string()
                          : std::is_same_v<Field, int>         ? value.is_number_integer()
                                                               : value.is_number();
        if (!fits) return false;
        if constexpr (std::is_same_v<Field, int>) {
          const auto wide = value.get<std::int64_t>();
          if (static_cast<double>(wide) < option.info.min ||
              static_cast<double>(wide) > option.info.max)
            return false;
        }
        *field = value.get<Field>();
        return true;
      },
      option.field);
}

Error badRig(
    const std::string& what,
    const std::string& advice = "Compare with the rig in the truth.json of a `gyre demo`.") {
  return {Error::Code::kInvalidInput, what, advice};
}

// The words of the command line are written with hyphens, the keys of the file are not.
Error unknownKey(const std::string& key, const OptionList& list) {
  const std::string what = "The rig file has an unknown key '" + key + "'.";
  for (const Option& option : list.options()) {
    if (option.info.name == key) return badRig(what, "Write it as '" + keyOf(option) + "'.");
  }
  return badRig(what);
}

}  // namespace

std::string rigToJson(const RigSettings& rig) {
  RigSettings copy = rig;
  nlohmann::ordered_json json;
  const OptionList list = OptionList::of(copy);
  for (const Option& option : list.options()) {
    std::visit([&](auto* field) { json[keyOf(option)] = *field; }, option.field);
  }
  return json.dump(2) + "\n";
}

Result<RigSettings> rigFromJson(const std::string& text, const RigSettings& base) {
  const auto json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return badRig("The rig file is not a JSON object.");
  RigSettings rig = base;
  const OptionList list = OptionList::of(rig);
  for (auto entry = json.begin(); entry != json.end(); ++entry) {
    const std::string& key = entry.key();
    const auto option = std::find_if(list.options().begin(), list.options().end(),
                                     [&](const Option& each) { return keyOf(each) == key; });
    if (option == list.options().end()) return unknownKey(key, list);
    if (!assign(*option, entry.value()))
      return badRig("The rig file's value of '" + key + "' does not fit.");
  }
  if (auto valid = rig.validate(); !valid) return valid.error();
  return rig;
}

}  // namespace gyre
