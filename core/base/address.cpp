// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/address.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace gyre {
namespace {

// What stands in place of a password.
constexpr const char* kHidden = "***";

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
    kept += secret ? std::string(field.substr(0, equals + 1)) + kHidden : std::string(field);
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

// "user:***@" for "user:password@"; a user alone may be a key, and is hidden whole.
std::string withHiddenPassword(std::string_view user) {
  if (user.empty()) return {};
  const std::size_t colon = user.find(':');
  const std::string_view shown = colon == std::string_view::npos ? "" : user.substr(0, colon + 1);
  return std::string(shown) + kHidden + "@";
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
  kept += withHiddenPassword(rest.substr(0, rest.size() - host.size()));
  kept += host.substr(0, query);
  if (query < host.size()) kept.append("?").append(withoutSecrets(host.substr(query + 1)));
  return kept;
}

bool lacksPassword(const std::string& address) {
  return address.find("://") != std::string::npos && address.find(kHidden) != std::string::npos;
}

}  // namespace gyre
