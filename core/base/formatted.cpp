// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/formatted.h"

#include <clocale>
#include <cstdarg>
#include <cstdio>

#include <locale.h>

#include "core/base/check.h"

namespace gyre {
namespace {

// The calling thread's numbers have a decimal point while this lives.
class DecimalPoint {
 public:
  DecimalPoint() : before_(::uselocale(plain())) {}
  DecimalPoint(const DecimalPoint&) = delete;
  DecimalPoint& operator=(const DecimalPoint&) = delete;
  ~DecimalPoint() { ::uselocale(before_); }

 private:
  static locale_t plain() {
    static const locale_t locale = ::newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
    return locale;
  }

  locale_t before_;
};

}  // namespace

std::string formatted(const char* format, ...) {
  const DecimalPoint decimal_point;
  std::va_list values;
  va_start(values, format);
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, format, values);
  va_end(values);
  GYRE_CHECK(length >= 0);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string pxText(double px) {
  if (px < 1.0) return formatted("%.2g px", px);
  return formatted(px < 10.0 ? "%.1f px" : "%.0f px", px);
}

}  // namespace gyre
