// Gives any bytes to the reader of passes.json.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/passes_file.h"
#include "tests/fuzz/fuzz_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto passes = gyre::parsePasses(gyre::fuzz::textOf(bytes, size), "fuzzed");
  gyre::fuzz::checkSentence(passes);
  if (!passes) return 0;
  GYRE_CHECK(!passes->empty());
  for (const gyre::ScanPass& pass : *passes) {
    GYRE_CHECK(!pass.name.empty() && pass.name.find('/') == std::string::npos);
    GYRE_CHECK(gyre::isRigid(pass.merged_from_pass));
    GYRE_CHECK(pass.merged_from_pass.translation.allFinite());
  }
  // What was read is written and read again as it was.
  const auto again = gyre::parsePasses(gyre::passesText(*passes), "written");
  GYRE_CHECK(again && again->size() == passes->size());
  return 0;
}
