// Gives any bytes to the reader of measurements.json.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/measurements_file.h"
#include "tests/fuzz/fuzz_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto measured = gyre::parseMeasurements(gyre::fuzz::textOf(bytes, size), "fuzzed");
  gyre::fuzz::checkSentence(measured);
  if (!measured) return 0;
  GYRE_CHECK(measured->size() <= gyre::kMostMeasurements);
  for (const gyre::Measurement& one : *measured) {
    GYRE_CHECK(one.from_in_table.allFinite() && one.to_in_table.allFinite());
    GYRE_CHECK(!gyre::lengthText(one).empty() && !gyre::uncertaintyText(one).empty());
  }
  // What was read is written and read again as it was.
  const auto again = gyre::parseMeasurements(gyre::measurementsText(*measured), "written");
  GYRE_CHECK(again && again->size() == measured->size());
  return 0;
}
