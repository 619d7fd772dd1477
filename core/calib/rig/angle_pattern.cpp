// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/angle_pattern.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/formatted.h"
#include "core/base/units.h"

namespace gyre {
namespace {

constexpr double kNormal = 1.4826;      // standard deviation over median absolute deviation
constexpr double kEvenShare = 0.35;     // steps within this share of their median are even
constexpr double kLeastTurn_rad = 5.2;  // 300 deg: less cannot tell once a turn from a drift
constexpr std::size_t kLeastForHarmonics = 10;
constexpr std::size_t kLeastForRipple = 24;
constexpr double kFalseAlarm = 1e-4;  // chance that white noise passes for a ripple
constexpr std::size_t kMostRipples = 4;
constexpr int kReweightings = 6;

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double spread(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> off;
  off.reserve(values.size());
  for (const double value : values) off.push_back(std::abs(value - middle));
  return kNormal * median(off);
}

std::vector<double> stepsOf(const std::vector<double>& angles_rad) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < angles_rad.size(); ++k) {
    steps.push_back(angles_rad[k] - angles_rad[k - 1]);
  }
  return steps;
}

// What the motor was told, or what an even one would have been told; empty when neither is known.
std::vector<double> toldAngles(const std::vector<double>& angles_rad,
                               const std::vector<std::optional<double>>& commanded_rad) {
  std::vector<double> told;
  for (const auto& angle : commanded_rad) {
    if (!angle) break;
    told.push_back(*angle);
  }
  if (told.size() == angles_rad.size()) return told;
  told.clear();
  const std::vector<double> steps = stepsOf(angles_rad);
  const double step_rad = median(steps);
  const auto even = std::count_if(steps.begin(), steps.end(), [&](double step) {
    return std::abs(step - step_rad) < kEvenShare * std::abs(step_rad);
  });
  if (steps.size() < 3 || even * 4 < static_cast<std::ptrdiff_t>(steps.size()) * 3) return told;
  for (std::size_t k = 0; k < angles_rad.size(); ++k) {
    told.push_back(step_rad * static_cast<double>(k));
  }
  return told;
}

// Marks the steps that are off by far more than the steps usually are.
std::vector<bool> oddSteps(const std::vector<double>& angles_rad, const std::vector<double>& told,
                           double scale, const AnglePatternOptions& options) {
  std::vector<double> off;
  for (std::size_t k = 1; k < angles_rad.size(); ++k) {
    off.push_back(angles_rad[k] - angles_rad[k - 1] - scale * (told[k] - told[k - 1]));
  }
  const double middle = median(off);
  const double limit = std::max(options.jump_sigma * spread(off), 2.0 * options.least_rad);
  std::vector<bool> odd;
  odd.reserve(off.size());
  for (const double step : off) odd.push_back(std::abs(step - middle) > limit);
  return odd;
}

double robustScale(const std::vector<double>& angles_rad, const std::vector<double>& told) {
  std::vector<double> ratios;
  for (std::size_t k = 1; k < told.size(); ++k) {
    const double step = told[k] - told[k - 1];
    if (step != 0.0) ratios.push_back((angles_rad[k] - angles_rad[k - 1]) / step);
  }
  return ratios.empty() ? 1.0 : median(ratios);
}

// The linear model of the angles: scale, the offset of each stretch between jumps, and waves.
struct Fit {
  Eigen::VectorXd solution;  // scale, (a, b) a wave, offsets
  Eigen::VectorXd residuals_rad;
};

Fit fitWaves(const std::vector<double>& angles_rad, const std::vector<double>& told,
             const std::vector<bool>& odd, const std::vector<double>& orders) {
  const auto rows = static_cast<Eigen::Index>(angles_rad.size());
  const auto waves = static_cast<Eigen::Index>(orders.size());
  const auto stretches = 1 + std::count(odd.begin(), odd.end(), true);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, 1 + 2 * waves + stretches);
  Eigen::VectorXd b(rows);
  Eigen::Index stretch = 0;
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto index = static_cast<std::size_t>(k);
    if (k > 0 && odd[index - 1]) ++stretch;
    b[k] = angles_rad[index];
    a(k, 0) = told[index];
    for (Eigen::Index wave = 0; wave < waves; ++wave) {
      const double phase_rad = orders[static_cast<std::size_t>(wave)] * angles_rad[index];
      a(k, 1 + 2 * wave) = std::sin(phase_rad);
      a(k, 2 + 2 * wave) = std::cos(phase_rad);
    }
    a(k, 1 + 2 * waves + stretch) = 1.0;
  }
  Fit fit;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(rows);
  for (int iteration = 0; iteration < kReweightings; ++iteration) {
    // The smallest solution, for a stretch of one picture explains itself by its offset alone.
    fit.solution = (weights.asDiagonal() * a)
                       .completeOrthogonalDecomposition()
                       .solve(weights.asDiagonal() * b);
    fit.residuals_rad = b - a * fit.solution;
    std::vector<double> off(fit.residuals_rad.data(), fit.residuals_rad.data() + rows);
    const double scale = std::max(3.0 * spread(off), 1e-9);
    for (Eigen::Index k = 0; k < rows; ++k) {
      const double share = fit.residuals_rad[k] / scale;
      weights[k] = 1.0 / std::sqrt(1.0 + share * share);
    }
  }
  return fit;
}

TurnHarmonic harmonicOf(const Fit& fit, Eigen::Index wave) {
  const double a = fit.solution[1 + 2 * wave];
  const double b = fit.solution[2 + 2 * wave];
  return {std::hypot(a, b), std::atan2(b, a)};
}

// The order, in waves a turn, at which the residuals ripple most, or nothing when no ripple stands
// out of white noise (Lomb's periodogram; its peak's false-alarm chance after Scargle).
std::optional<double> strongestRipple(const std::vector<double>& angles_rad, const Fit& fit) {
  const auto count = static_cast<double>(angles_rad.size());
  const auto [low, high] = std::minmax_element(angles_rad.begin(), angles_rad.end());
  const double span_turns = (*high - *low) / kTurn_rad;
  const double highest = 0.5 * count / span_turns;
  const double step = 0.1 / span_turns;
  const double variance = fit.residuals_rad.squaredNorm() / count;
  if (!(variance > 0.0) || !(span_turns > 0.0)) return std::nullopt;
  double best_power = 0.0;
  double best_order = 0.0;
  const double lowest = std::max(2.5, 1.5 / span_turns);
  const int orders = static_cast<int>(std::ceil((highest - lowest) / step));
  for (int i = 0; i < orders; ++i) {
    const double order = lowest + i * step;
    double a = 0.0;
    double b = 0.0;
    for (std::size_t k = 0; k < angles_rad.size(); ++k) {
      const double residual = fit.residuals_rad[static_cast<Eigen::Index>(k)];
      a += residual * std::sin(order * angles_rad[k]);
      b += residual * std::cos(order * angles_rad[k]);
    }
    const double power = (a * a + b * b) / (count * variance);
    if (power <= best_power) continue;
    best_power = power;
    best_order = order;
  }
  const double independent = count / 2.0;
  if (best_power < std::log(independent / kFalseAlarm)) return std::nullopt;
  return best_order;
}

std::vector<AngleJump> jumpsOf(const std::vector<double>& angles_rad,
                               const std::vector<double>& regular_rad,
                               const std::vector<bool>& odd) {
  std::vector<AngleJump> jumps;
  for (std::size_t k = 0; k < odd.size(); ++k) {
    if (!odd[k]) continue;
    // Odd steps that follow each other are one event.
    const bool goes_on = !jumps.empty() && jumps.back().first + jumps.back().moved_rad.size() == k;
    if (!goes_on) jumps.push_back({k, {}, regular_rad[k + 1] - regular_rad[k]});
    jumps.back().moved_rad.push_back(angles_rad[k + 1] - angles_rad[k]);
  }
  return jumps;
}

std::string degrees(double angle_rad) {
  return formatted("%.2f deg", degFromRad(std::abs(angle_rad)));
}

}  // namespace

AnglePattern anglePatternOf(const std::vector<double>& angles_rad,
                            const std::vector<std::optional<double>>& commanded_rad,
                            const AnglePatternOptions& options) {
  AnglePattern pattern;
  const std::vector<double> told = toldAngles(angles_rad, commanded_rad);
  pattern.step_rad = median(stepsOf(angles_rad));
  if (told.size() < 2) return pattern;
  const bool commanded =
      std::all_of(commanded_rad.begin(), commanded_rad.end(), [](auto& a) { return !!a; });
  const double scale = robustScale(angles_rad, told);
  const std::vector<bool> odd = oddSteps(angles_rad, told, scale, options);
  std::vector<double> regular_rad;
  regular_rad.reserve(told.size());
  for (const double angle : told) regular_rad.push_back(scale * angle);
  pattern.jumps = jumpsOf(angles_rad, regular_rad, odd);

  const auto [low, high] = std::minmax_element(angles_rad.begin(), angles_rad.end());
  const bool whole_turn = *high - *low > kLeastTurn_rad && angles_rad.size() >= kLeastForHarmonics;
  std::vector<double> orders;
  if (whole_turn) orders = {1.0, 2.0};
  Fit fit = fitWaves(angles_rad, told, odd, orders);
  const std::size_t regular = orders.size();
  while (whole_turn && angles_rad.size() >= kLeastForRipple &&
         orders.size() < regular + kMostRipples) {
    const auto order = strongestRipple(angles_rad, fit);
    if (!order) break;
    orders.push_back(*order);
    fit = fitWaves(angles_rad, told, odd, orders);
  }
  if (commanded) pattern.step_scale = fit.solution[0];
  if (whole_turn) {
    pattern.once_per_turn = harmonicOf(fit, 0);
    pattern.twice_per_turn = harmonicOf(fit, 1);
  }
  for (std::size_t wave = regular; wave < orders.size(); ++wave) {
    const double amplitude_rad = harmonicOf(fit, static_cast<Eigen::Index>(wave)).amplitude_rad;
    if (amplitude_rad < options.least_rad) continue;
    pattern.ripples.push_back({amplitude_rad, kTurn_rad / orders[wave]});
  }
  std::sort(pattern.ripples.begin(), pattern.ripples.end(),
            [](auto& a, auto& b) { return a.amplitude_rad > b.amplitude_rad; });
  const double spare = static_cast<double>(fit.residuals_rad.size() - fit.solution.size());
  if (spare > 0.0) pattern.white_rad = std::sqrt(fit.residuals_rad.squaredNorm() / spare);
  return pattern;
}

std::vector<std::string> sentencesOf(const AnglePattern& pattern,
                                     const std::vector<std::string>& view_names) {
  std::vector<std::string> sentences;
  for (const AngleJump& jump : pattern.jumps) {
    std::string moved;
    for (const double step : jump.moved_rad) {
      moved += (moved.empty() ? "" : ", then ") + degrees(step);
    }
    sentences.push_back("Between the pictures " + view_names[jump.first] + " and " +
                        view_names[jump.first + jump.moved_rad.size()] + " the table turned " +
                        moved + " instead of " + degrees(jump.expected_rad) +
                        " a step: it was stopped, started again or moved by hand there.");
  }
  for (const AngleRipple& ripple : pattern.ripples) {
    const std::string pictures =
        formatted("%.1f pictures", ripple.period_rad / std::max(std::abs(pattern.step_rad), 1e-12));
    sentences.push_back("The angle ripples by +-" + degrees(ripple.amplitude_rad) +
                        " with a period of " + degrees(ripple.period_rad) + " (" + pictures +
                        "): uneven steps of the motor or its gears.");
  }
  return sentences;
}

}  // namespace gyre
