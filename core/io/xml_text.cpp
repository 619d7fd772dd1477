// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/xml_text.h"

namespace gyre {

std::string xmlText(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe.append("&amp;");
        break;
      case '<':
        safe.append("&lt;");
        break;
      case '>':
        safe.append("&gt;");
        break;
      case '"':
        safe.append("&quot;");
        break;
      default:
        safe.push_back(c);
    }
  }
  return safe;
}

}  // namespace gyre
