// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/calibrate_ending.h"

#include <cctype>
#include <iomanip>
#include <sstream>

#include "core/base/units.h"
#include "core/io/calibration_record_file.h"

namespace gyre {
namespace {

void tellTurning(Console& console, const CalibratedTurntable& turntable) {
  std::ostringstream text;
  text << "The turntable's axis " << turntable.axis << " counts " << std::setprecision(7)
       << turntable.units_per_turn << " units a turn"
       << (turntable.direction < 0 ? ", clockwise for plus" : "")
       << "; scans take it from the file.";
  console.note(text.str());
}

// The fit alone: what points and hand-held sets have instead of a verdict.
void tellFit(Console& console, const CalibrationRecord& record) {
  const CameraModel& camera = record.calibration.camera;
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "Focal length " << camera.fx;
  if (record.report && record.report->focal_sigma_px > 0.0) {
    text << " ± " << record.report->focal_sigma_px;
  }
  text << " px, principal point " << camera.cx << ", " << camera.cy << ", k1 "
       << std::setprecision(4) << camera.k1 << ".";
  console.say(text.str());
  if (!record.report) return;
  std::ostringstream fit;
  fit << std::fixed << std::setprecision(3) << "The sightings miss by " << record.report->rms_px
      << " px (rms), " << record.report->median_px << " px (median), in " << record.report->views
      << " pictures.";
  console.say(fit.str());
}

}  // namespace

std::string turningText(double told_rad, double turned_rad) {
  std::ostringstream text;
  text << std::setprecision(3) << "Told to turn by " << degFromRad(told_rad)
       << "\u00b0 in all, the table turned by " << degFromRad(turned_rad) << "\u00b0.";
  return text.str();
}

std::string pictureText(const SightedPicture& picture) {
  if (!picture.view) return picture.name + ": " + picture.reason;
  return picture.name + ": " + std::to_string(picture.view->sightings.size()) +
         " points of the target.";
}

void tellOutcome(Console& console, const CalibrationOutcome& outcome) {
  for (const std::string& remark : outcome.remarks) console.say(remark);
  if (outcome.skipped.empty()) return;
  console.warn(std::to_string(outcome.skipped.size()) + " of " +
               std::to_string(outcome.skipped.size() + outcome.views.size()) +
               " pictures are left out:");
  for (const std::string& skipped : outcome.skipped) console.warn("  " + skipped);
}

void tellVerdict(Console& console, const CalibrationReport& report) {
  std::string sentence = report.sentence;  // begins with the verdict's word
  if (!sentence.empty()) sentence.front() = static_cast<char>(std::tolower(sentence.front()));
  console.say("Verdict: " + sentence);
}

int endCalibration(Console& console, const std::filesystem::path& file,
                   const CalibrationRecord& record) {
  if (const auto done = writeCalibrationRecord(file, record); !done) {
    return console.fail(done.error());
  }
  tellFit(console, record);
  // Without a table there is no object whose error could be predicted.
  const bool judged = record.report && !record.report->sentence.empty();
  if (record.report) {
    for (const std::string& remark : record.report->remarks) console.say(remark);
  }
  if (record.turntable) tellTurning(console, *record.turntable);
  if (judged) tellVerdict(console, *record.report);
  console.say("Written to " + file.string() + ".");
  if (!judged || record.report->verdict != CalibrationVerdict::kRedo) return kDone;
  return console.fail({Error::Code::kTooFew,
                       "This calibration is not good enough to measure with; the file is written "
                       "and marked so.",
                       "Do what the verdict says, and calibrate again."});
}

}  // namespace gyre
