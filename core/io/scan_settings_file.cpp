// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_settings_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/io/file_bytes.h"
#include "core/io/json_text.h"

namespace gyre {
namespace {

using nlohmann::ordered_json;

constexpr std::uintmax_t kMaxBytes = 16U << 20U;
constexpr double kMaxAngle_rad = 1e5;

Error badSettings(const std::string& file, const std::string& problem) {
  return {Error::Code::kInvalidInput, "The scan file \"" + file + "\" " + problem + ".",
          "Give the .gyre file that the program wrote; the pictures in \"frames\" are untouched."};
}

// The text under the key; none when there is no such key.
std::string textAt(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool namesSecret(std::string_view key) {
  std::string lower(key);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.find("pass") != std::string::npos || lower.find("pwd") != std::string::npos ||
         lower.find("token") != std::string::npos || lower.find("secret") != std::string::npos ||
         lower == "key" || lower == "auth";
}

// Empties the values of the secret fields of "a=1&password=2#part".
std::string withoutSecrets(std::string_view query) {
  std::string kept;
  while (!query.empty()) {
    const std::size_t end = std::min(query.find_first_of("&#;"), query.size());
    const std::string_view field = query.substr(0, end);
    const std::size_t equals = field.find('=');
    const bool secret = equals != std::string_view::npos && namesSecret(field.substr(0, equals));
    kept += secret ? field.substr(0, equals + 1) : field;
    kept += query.substr(end, 1);
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return kept;
}

// How many characters of the rest of an address, "user:password@host/path", come before the host.
std::size_t lengthOfUser(std::string_view rest) {
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const std::size_t at = rest.substr(0, slash).rfind('@');
  if (at != std::string_view::npos) return at + 1;
  // A slash in the password? Then what looks like a port holds more than digits.
  const std::size_t colon = rest.substr(0, slash).find(':');
  if (colon == std::string_view::npos || rest.starts_with('[')) return 0;
  const std::string_view port = rest.substr(colon + 1, slash - colon - 1);
  const bool is_port =
      std::all_of(port.begin(), port.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const std::size_t last_at = rest.rfind('@');
  return is_port || last_at == std::string_view::npos ? 0 : last_at + 1;
}

}  // namespace

std::string withoutPassword(const std::string& address) {
  const std::size_t scheme = address.find("://");
  if (scheme == std::string::npos) return address;
  const std::string_view rest = std::string_view(address).substr(scheme + 3);
  // A password may hold a question mark: the user part ends at the last @ before the path.
  const std::string_view host = rest.substr(lengthOfUser(rest));
  const std::size_t query = std::min(host.find('?'), host.size());
  std::string kept = address.substr(0, scheme + 3);
  kept += host.substr(0, query);
  if (query < host.size()) kept.append("?").append(withoutSecrets(host.substr(query + 1)));
  return kept;
}

Result<ScanSettings> parseScanSettings(std::string_view text, const std::string& file) {
  if (const auto valid = checkJson(text, file); !valid) return valid.error();
  const ordered_json root = ordered_json::parse(text);
  if (!root.is_object() || textAt(root, "format") != "gyre-scan") {
    return badSettings(file, "is no scan of Gyre: its \"format\" is not \"gyre-scan\"");
  }
  if (root.value("version", ordered_json()) != 1) {
    return badSettings(file, "is of a version that this program does not know");
  }
  ScanSettings settings;
  settings.title = textAt(root, "title");
  settings.inventory_number = textAt(root, "inventory_number");
  settings.rights = textAt(root, "rights");
  settings.turntable = textAt(root, "turntable");
  settings.camera = textAt(root, "camera");
  const ordered_json rig = root.value("sim_rig", ordered_json());
  if (!rig.is_null()) settings.sim_rig_json = rig.dump();
  const ordered_json views = root.value("views", ordered_json());
  if (!views.is_number_integer() || views < 1 || views > kMaxViews) {
    return badSettings(file, "has no usable number of \"views\"");
  }
  settings.views = views.get<int>();
  const ordered_json angle = root.value("start_angle_rad", ordered_json());
  if (!angle.is_number() || std::abs(angle.get<double>()) > kMaxAngle_rad) {
    return badSettings(file, "has no usable \"start_angle_rad\"");
  }
  settings.start_angle_rad = angle.get<double>();
  return settings;
}

Result<ScanSettings> readScanSettings(const std::filesystem::path& file) {
  const auto text = readFileBytes(file, kMaxBytes);
  if (!text) return text.error();
  return parseScanSettings(*text, file.string());
}

Result<std::string> scanSettingsText(const ScanSettings& settings) {
  const std::string& rig = settings.sim_rig_json;
  if (const auto valid = checkJson(rig.empty() ? "null" : rig, "rig.json"); !valid) {
    return valid.error();
  }
  ordered_json root;
  root["format"] = "gyre-scan";
  root["version"] = 1;
  root["title"] = settings.title;
  root["inventory_number"] = settings.inventory_number;
  root["rights"] = settings.rights;
  root["turntable"] = settings.turntable;
  root["camera"] = withoutPassword(settings.camera);
  root["views"] = settings.views;
  root["start_angle_rad"] = settings.start_angle_rad;
  if (!rig.empty()) root["sim_rig"] = ordered_json::parse(rig);
  std::string text = root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  if (const auto readable = parseScanSettings(text, "scan.gyre"); !readable) {
    return readable.error();
  }
  return text;
}

}  // namespace gyre
