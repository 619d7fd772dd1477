// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/calib/rig/rig_verdict.h"

#include <cmath>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr double kBlurred_px = 0.3;   // median misfit of corners that are not sharp
constexpr double kSmallTarget = 0.4;  // share of the picture's side
constexpr double kHardlyAllAround_rad = radFromDeg(300.0);
constexpr std::size_t kFewViews = 20;
constexpr double kManyOutliers = 0.1;  // share of all sightings
constexpr double kScaleOff = 0.002;    // of the steps per turn: beyond what gears do
constexpr double kHarmonic_rad = radFromDeg(0.1);
constexpr double kBow_mm = 0.1;
constexpr double kFold_rad = radFromDeg(0.25);
constexpr double kFoldShift_mm = 0.3;

// The one change that helps most, the cheapest first.
std::string remedy(const CaptureFacts& facts, const CalibrationReport& report) {
  if (report.median_px > kBlurred_px) {
    return "Focus on the target and light it better: its corners scatter by " +
           formatted("%.2f px.", report.median_px);
  }
  if (facts.arc_rad < kHardlyAllAround_rad) return "Turn the table all the way around.";
  if (facts.target_share < kSmallTarget) {
    return formatted("Bring the target closer: it fills only %.0f %% of the picture.",
                     100.0 * facts.target_share);
  }
  if (report.views < kFewViews) return "Take more pictures around the turn.";
  return "Use a target with more corners, or tilt it more towards the camera.";
}

CalibrationVerdict verdictOn(const CalibrationReport& report, const VerdictLimits& limits) {
  const double detail = report.local_detail_mm / report.object_size_mm;
  const double size = report.overall_size_mm / report.object_size_mm;
  // Written so that what is no number is never good.
  if (!(detail <= limits.acceptable_detail) || !(size <= limits.acceptable_size)) {
    return CalibrationVerdict::kRedo;
  }
  const bool good = detail <= limits.good_detail && size <= limits.good_size;
  return good && report.size_verified ? CalibrationVerdict::kGood : CalibrationVerdict::kAcceptable;
}

const char* wordOf(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::kGood:
      return "Good";
    case CalibrationVerdict::kAcceptable:
      return "Acceptable";
    case CalibrationVerdict::kRedo:
      break;
  }
  return "Better calibrate again";
}

std::string faceSentence(std::size_t number, const FaceReport& face) {
  std::string found;
  const auto add = [&](const std::string& what) { found += (found.empty() ? "" : ", ") + what; };
  if (std::abs(face.bow_mm) > kBow_mm) add(formatted("is bowed by %.2f mm", face.bow_mm));
  if (face.tilt_rad > kFold_rad)
    add(formatted("is folded %.2f deg off", degFromRad(face.tilt_rad)));
  if (face.shift_mm > kFoldShift_mm) add(formatted("stands %.2f mm off", face.shift_mm));
  if (found.empty()) return {};
  return formatted("Face %zu of the target ", number) + found + "; this was corrected.";
}

void remarkOnMotor(const CalibrationReport& report, std::vector<std::string>& remarks) {
  if (report.direction < 0) {
    remarks.push_back(
        "The motor is reversed: the table turns clockwise, seen from above, for positive "
        "commands. Its direction is -1.");
  }
  if (std::abs(report.step_scale - 1.0) > kScaleOff) {
    remarks.push_back(
        formatted("The table turns %.4f times as far as it is told: the steps per turn "
                  "are set wrong.",
                  report.step_scale));
  }
  if (report.once_per_turn.amplitude_rad > kHarmonic_rad) {
    remarks.push_back(formatted("Once a turn the table runs ahead and behind by %.2f deg.",
                                degFromRad(report.once_per_turn.amplitude_rad)));
  }
  if (report.twice_per_turn.amplitude_rad > kHarmonic_rad) {
    remarks.push_back(formatted("Twice a turn the table runs ahead and behind by %.2f deg.",
                                degFromRad(report.twice_per_turn.amplitude_rad)));
  }
}

}  // namespace

void judge(const RigBundleOptions& options, const CaptureFacts& facts, CalibrationReport& report) {
  report.verdict = verdictOn(report, options.limits);
  const double detail = report.local_detail_mm / report.object_size_mm;
  report.sentence = wordOf(report.verdict);
  report.sentence += formatted(
      ": on an object of %.0f mm, local detail \u00b1 %.3f mm, overall size \u00b1 %.2f mm",
      report.object_size_mm, report.local_detail_mm, report.overall_size_mm);
  report.sentence += report.size_verified ? "." : " (size not verified).";
  if (!(detail <= options.limits.good_detail)) {
    report.sentence += " " + remedy(facts, report);
  } else if (!report.size_verified) {
    report.sentence += " Measure the two printed rulers with a caliper and type in what it shows.";
  } else if (report.verdict != CalibrationVerdict::kGood) {
    report.sentence += " Measure the rulers with a finer caliper, or use a target of known size.";
  }
}

void judgeByCheck(const CalibrationCheck& check, const RigBundleOptions& options,
                  CalibrationReport& report) {
  report.check_mm = check.detail_mm;
  report.remarks.push_back(formatted(
      "Checked by %zu points of the target that took no part in the solution: they were measured "
      "to %.3f mm.",
      check.points, check.detail_mm));
  const double share = check.detail_mm / report.object_size_mm;
  CalibrationVerdict verdict = report.verdict;
  if (!(share <= options.limits.acceptable_detail)) {
    verdict = CalibrationVerdict::kRedo;
  } else if (!(share <= options.limits.good_detail) && verdict == CalibrationVerdict::kGood) {
    verdict = CalibrationVerdict::kAcceptable;
  }
  if (verdict == report.verdict) return;
  report.verdict = verdict;
  report.sentence = std::string(wordOf(verdict)) +
                    formatted(
                        ": points of the target that took no part in the solution were measured "
                        "only to %.3f mm. Glue the target to something flat and stiff, and see "
                        "that it does not move on the table.",
                        check.detail_mm);
}

std::vector<std::string> remarksOn(const CalibrationReport& report, const CaptureFacts& facts) {
  std::vector<std::string> remarks;
  remarkOnMotor(report, remarks);
  for (std::size_t face = 0; face < report.faces.size(); ++face) {
    std::string sentence = faceSentence(face + 1, report.faces[face]);
    if (!sentence.empty()) remarks.push_back(std::move(sentence));
  }
  if (facts.outlier_share > kManyOutliers) {
    remarks.push_back(
        formatted("%.0f %% of the sightings did not fit and were left out: look for "
                  "reflections, or for pictures in which the target moved.",
                  100.0 * facts.outlier_share));
  }
  return remarks;
}

}  // namespace gyre
