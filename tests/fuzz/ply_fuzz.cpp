// Gives any bytes to the reader of PLY files.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/fuzz_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  gyre::fuzz::checkModel(gyre::parsePly(gyre::fuzz::textOf(bytes, size), "fuzzed"));
  return 0;
}
