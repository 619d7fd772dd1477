// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/turn_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/geometry/ray.h"
#include "core/geometry/turntable_pose.h"
#include "core/recover/ray_intersection.h"

namespace gyre {
namespace {

constexpr double kGrid_rad = radFromDeg(0.1);
constexpr int kRefinements = 40;  // golden sections: to a millionth of the interval
// A pair's own step is looked for within this share of the common one, or this angle.
constexpr double kNear = 0.3;
constexpr double kNear_rad = radFromDeg(1.0);
// The runner-up, further than kNear away, must be agreed on by less than this share; one that is as
// good as the best by more than that.
constexpr double kClear = 0.9;
constexpr double kAsGood = 0.98;
// Motors that turn unevenly do so by about this share of a step.
constexpr double kUneven = 0.03;
constexpr double kLeastAgreeing = 0.2;  // of all matches
// Steps that miss whole turns by more than this share do not close.
constexpr double kClosing = 0.03;
// So many matches tell the common step as well as more.
constexpr std::size_t kMostAsked = 20000;
constexpr double kLeastParallax_rad = 1e-5;
constexpr double kGolden = 0.6180339887498949;
constexpr double kMadToSigma = 1.4826;

// The matches' common geometry for a step: the second camera, seen from the first.
class EpipolarStep {
 public:
  EpipolarStep(const Rigid3& cam_from_table, double step_rad)
      : first_(cam_from_table), second_(camFromTable(cam_from_table, step_rad)) {
    const Rigid3 second_from_first = second_ * first_.inverse();
    const Eigen::Vector3d& t = second_from_first.translation;
    Eigen::Matrix3d cross;
    cross << 0.0, -t.z(), t.y(), t.z(), 0.0, -t.x(), -t.y(), t.x(), 0.0;
    essential_ = cross * second_from_first.rotation;
  }

  // Squared Sampson distance of a match, on the plane z = 1.
  double squaredMiss(const ViewMatch& match) const {
    const Eigen::Vector3d line_second = essential_ * match.first.homogeneous();
    const Eigen::Vector3d line_first = essential_.transpose() * match.second.homogeneous();
    const double miss = match.second.homogeneous().dot(line_second);
    const double slope = line_second.head<2>().squaredNorm() + line_first.head<2>().squaredNorm();
    return slope > 0.0 ? miss * miss / slope : 0.0;
  }

  // The spot lies where its two rays pass each other, which must be near enough to the axis.
  bool within(const ViewMatch& match, double most_radius_mm) const {
    const auto spot = intersectTwoRays(rayThrough(first_, match.first),
                                       rayThrough(second_, match.second), kLeastParallax_rad);
    return spot && spot->head<2>().norm() <= most_radius_mm;
  }

 private:
  Rigid3 first_;
  Rigid3 second_;
  Eigen::Matrix3d essential_;
};

class StepSearch {
 public:
  StepSearch(const Rigid3& cam_from_table, const TurnStepsOptions& options)
      : cam_from_table_(cam_from_table), options_(options) {}

  // 1 for a match that fits exactly, 0 beyond the tolerance, summed.
  double support(std::span<const ViewMatch> matches, double step_rad) const {
    const EpipolarStep step(cam_from_table_, step_rad);
    const double squared_tolerance = options_.tolerance * options_.tolerance;
    double sum = 0.0;
    for (const ViewMatch& match : matches) {
      const double fit = 1.0 - step.squaredMiss(match) / squared_tolerance;
      if (fit > 0.0 && step.within(match, options_.most_radius_mm)) sum += fit;
    }
    return sum;
  }

  std::size_t agreeing(std::span<const ViewMatch> matches, double step_rad) const {
    const EpipolarStep step(cam_from_table_, step_rad);
    const double squared_tolerance = options_.tolerance * options_.tolerance;
    return static_cast<std::size_t>(
        std::count_if(matches.begin(), matches.end(), [&](const ViewMatch& match) {
          return step.squaredMiss(match) < squared_tolerance &&
                 step.within(match, options_.most_radius_mm);
        }));
  }

  // The best step within the reach of a start.
  template <class Support>
  double refine(const Support& support_of, double start_rad, double reach_rad) const {
    double low = start_rad - reach_rad;
    double high = start_rad + reach_rad;
    for (int i = 0; i < kRefinements; ++i) {
      const double a = high - kGolden * (high - low);
      const double b = low + kGolden * (high - low);
      (support_of(a) > support_of(b) ? high : low) = support_of(a) > support_of(b) ? b : a;
    }
    return 0.5 * (low + high);
  }

  // A pair's own step near the common one.
  double ownStep(std::span<const ViewMatch> matches, double common_rad) const {
    const auto of = [&](double step_rad) {
      const double uneven = (step_rad / common_rad - 1.0) / kUneven;
      return support(matches, step_rad) - 0.5 * uneven * uneven;
    };
    const double reach_rad = std::max(kNear * std::abs(common_rad), kNear_rad);
    double best_rad = common_rad;
    double best_support = of(common_rad);
    const int most = static_cast<int>(reach_rad / (0.5 * kGrid_rad));
    for (int i = -most; i <= most; ++i) {
      const double off_rad = 0.5 * kGrid_rad * i;
      if (common_rad * (common_rad + off_rad) <= 0.0) continue;
      const double here = of(common_rad + off_rad);
      if (here <= best_support) continue;
      best_support = here;
      best_rad = common_rad + off_rad;
    }
    return refine(of, best_rad, 0.5 * kGrid_rad);
  }

 private:
  const Rigid3& cam_from_table_;
  const TurnStepsOptions& options_;
};

Error notTold() {
  return {Error::Code::kTooFew, "The pictures do not tell how far the table turned between them.",
          "Give more pictures with smaller steps of an object with texture, or name the step: "
          "--step-deg 10."};
}

// The turn that all wide pairs share; whole_rad: the one that makes a single turn of all views.
Result<double> commonStep(const StepSearch& search, std::span<const ViewMatch> all,
                          double whole_rad, const TurnStepsOptions& options) {
  std::vector<double> steps_rad;
  const int count =
      static_cast<int>((options.most_step_rad - options.least_step_rad) / kGrid_rad) + 1;
  for (int i = 0; i < count; ++i) {
    const double step_rad = options.least_step_rad + kGrid_rad * i;
    steps_rad.push_back(step_rad);
    steps_rad.push_back(-step_rad);
  }
  std::vector<double> supports(steps_rad.size());
  parallelFor(steps_rad.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) supports[i] = search.support(all, steps_rad[i]);
  });
  const auto best = static_cast<std::size_t>(std::max_element(supports.begin(), supports.end()) -
                                             supports.begin());
  if (supports[best] < kLeastAgreeing * static_cast<double>(all.size())) return notTold();
  const auto of = [&](double step_rad) { return search.support(all, step_rad); };
  whole_rad = std::copysign(whole_rad, steps_rad[best]);
  const bool whole_turn = of(whole_rad) > kAsGood * supports[best];
  const double near_rad = std::max(kNear * std::abs(steps_rad[best]), kNear_rad);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const bool other_way = steps_rad[i] * steps_rad[best] < 0.0;
    const bool elsewhere = std::abs(steps_rad[i] - steps_rad[best]) > near_rad && !whole_turn;
    if ((other_way || elsewhere) && supports[i] > kClear * supports[best]) return notTold();
  }
  return search.refine(of, whole_turn ? whole_rad : steps_rad[best], kGrid_rad);
}

std::vector<ViewMatch> thinned(const std::vector<ViewMatch>& matches) {
  const std::size_t stride = matches.size() / kMostAsked + 1;
  std::vector<ViewMatch> some;
  for (std::size_t i = 0; i < matches.size(); i += stride) some.push_back(matches[i]);
  return some;
}

double scatterOf(const std::vector<double>& steps_rad) {
  const double middle_rad = median(steps_rad);
  std::vector<double> off_rad;
  off_rad.reserve(steps_rad.size());
  for (const double step_rad : steps_rad) off_rad.push_back(std::abs(step_rad - middle_rad));
  return kMadToSigma * median(std::move(off_rad));
}

// Spreads what is missing to whole turns, when the closing pair agrees that they are whole.
void close(const StepSearch& search, std::span<const ViewMatch> closing,
           const TurnStepsOptions& options, TurnSteps& steps) {
  if (closing.size() < options.least_matches) return;
  double turned_rad = 0.0;
  for (const double step_rad : steps.steps_rad) turned_rad += step_rad;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double turns = std::max(1.0, std::round(std::abs(turned_rad + steps.common_rad) / kTurn));
  const double whole_rad = std::copysign(kTurn * turns, turned_rad);
  const double expected_rad = whole_rad - turned_rad;
  if (expected_rad * turned_rad <= 0.0 || std::abs(expected_rad) > options.most_step_rad) return;
  const double closing_rad = search.ownStep(closing, expected_rad);
  if (search.agreeing(closing, closing_rad) < options.least_matches) return;
  const double scale = whole_rad / (turned_rad + closing_rad);
  if (std::abs(scale - 1.0) > kClosing) return;
  for (double& step_rad : steps.steps_rad) step_rad *= scale;
  steps.closed = true;
}

}  // namespace

Result<TurnSteps> turnSteps(const TurnMatches& matches, const Rigid3& cam_from_table,
                            const TurnStepsOptions& options) {
  const auto& pairs = matches.pairs;
  const std::vector<ViewMatch> asked = thinned(matches.wide);
  if (pairs.empty() || asked.size() < options.least_matches) return notTold();
  const StepSearch search(cam_from_table, options);
  const auto apart = static_cast<double>(matches.stride);
  const double whole_rad = apart * 2.0 * std::numbers::pi / static_cast<double>(pairs.size() + 1);
  const auto common = commonStep(search, asked, whole_rad, options);
  if (!common) return common.error();
  TurnSteps steps;
  steps.common_rad = *common / apart;
  steps.steps_rad.assign(pairs.size(), steps.common_rad);
  parallelFor(pairs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double own_rad = search.ownStep(pairs[i], steps.common_rad);
      if (search.agreeing(pairs[i], own_rad) >= options.least_matches) {
        steps.steps_rad[i] = own_rad;
      }
    }
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    steps.agreeing += search.agreeing(pairs[i], steps.steps_rad[i]);
  }
  steps.scatter_rad = scatterOf(steps.steps_rad);
  close(search, matches.closing, options, steps);
  return steps;
}

}  // namespace gyre
