// Gives any bytes to the readers of calibration.json.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/calibration_file.h"
#include "core/io/calibration_record_file.h"
#include "tests/fuzz/fuzz_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text = gyre::fuzz::textOf(bytes, size);
  const auto calibration = gyre::parseCalibration(text, "fuzzed");
  gyre::fuzz::checkSentence(calibration);
  const auto record = gyre::parseCalibrationRecord(text, "fuzzed");
  gyre::fuzz::checkSentence(record);
  GYRE_CHECK(record.ok() == calibration.ok());
  if (!calibration) return 0;
  // What was accepted once is written and accepted again, to the last bit.
  const std::string whole = gyre::calibrationRecordText(*record);
  const auto whole_again = gyre::parseCalibrationRecord(whole, "fuzzed");
  GYRE_CHECK(whole_again);
  GYRE_CHECK(gyre::calibrationRecordText(*whole_again) == whole);
  const std::string again = gyre::calibrationText(*calibration);
  const auto reread = gyre::parseCalibration(again, "fuzzed");
  GYRE_CHECK(reread);
  GYRE_CHECK(gyre::calibrationText(*reread) == again);
  return 0;
}
