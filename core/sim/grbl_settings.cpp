// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/grbl_settings.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/check.h"
#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr int kBadNumber = 2;
constexpr int kInvalidStatement = 3;
constexpr int kNegativeValue = 4;

// As the firmware is told and tells: three decimals.
double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

bool isInteger(int number) {
  return number < 100 && number != 11 && number != 12 && number != 24 && number != 25 &&
         number != 27;
}

template <class Number>
std::optional<Number> numberIn(std::string_view text) {
  Number value{};
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string fixedText(double value, int decimals) { return formatted("%.*f", decimals, value); }

// GRBL's defaults, but for a motor that stays energised ($1) and for the X axis.
GrblSettings::GrblSettings(const TurntableFirmwareOptions& options)
    : values_{{0, 10},  {1, 255},  {2, 0},     {3, 0},     {4, 0},     {5, 0},     {6, 0},
              {10, 1},  {11, .01}, {12, .002}, {13, 0},    {20, 0},    {21, 0},    {22, 0},
              {23, 0},  {24, 25},  {25, 500},  {26, 250},  {27, 1},    {30, 1000}, {31, 0},
              {32, 0},  {100, 0},  {101, 250}, {102, 250}, {110, 0},   {111, 500}, {112, 500},
              {120, 0}, {121, 10}, {122, 10},  {130, 360}, {131, 200}, {132, 200}} {
  GYRE_CHECK(options.steps_per_turn > 0 && options.units_per_turn > 0);
  GYRE_CHECK(options.max_speed_deg_per_s > 0 && options.acceleration_deg_per_s2 > 0);
  const double units_per_deg = options.units_per_turn / 360.0;
  values_[kHoming] = options.homing ? 1.0 : 0.0;
  values_[kStepsPerUnit] = rounded(options.steps_per_turn / options.units_per_turn);
  values_[kMaxRate] = rounded(options.max_speed_deg_per_s * 60.0 * units_per_deg);
  values_[kAcceleration] = rounded(options.acceleration_deg_per_s2 * units_per_deg);
  GYRE_CHECK(values_[kStepsPerUnit] > 0 && values_[kMaxRate] > 0 && values_[kAcceleration] > 0);
}

int GrblSettings::assign(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return kInvalidStatement;
  const std::optional<int> number = numberIn<int>(line.substr(1, equals - 1));
  if (!number) return kInvalidStatement;
  const std::optional<double> value = numberIn<double>(line.substr(equals + 1));
  if (!value || !std::isfinite(*value)) return kBadNumber;
  if (*value < 0.0) return kNegativeValue;
  const bool must_be_positive = *number >= kStepsPerUnit && *number < kMaxTravel;
  if (!values_.contains(*number) || (must_be_positive && rounded(*value) <= 0.0)) {
    return kInvalidStatement;
  }
  values_[*number] = isInteger(*number) ? std::floor(*value) : rounded(*value);
  return 0;
}

std::string GrblSettings::report() const {
  std::string lines;
  for (const auto& [number, value] : values_) {
    lines += '$';
    lines.append(std::to_string(number)).append("=");
    lines.append(fixedText(value, isInteger(number) ? 0 : 3)).append("\r\n");
  }
  return lines;
}

}  // namespace gyre
