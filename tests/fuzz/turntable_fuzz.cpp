// Gives any bytes to the reader of turntable descriptions.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/turntable_file.h"
#include "tests/fuzz/fuzz_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto table = gyre::parseTurntableDescription(gyre::fuzz::textOf(bytes, size), "fuzzed");
  gyre::fuzz::checkSentence(table);
  if (!table) return 0;
  // What was accepted can be used.
  GYRE_CHECK(!table->name.empty() && !table->done.empty() && !table->answer_ends.empty());
  GYRE_CHECK(!table->greeting.empty() || !table->ask.send.empty());
  GYRE_CHECK((table->move.find("{by}") == std::string::npos) !=
             (table->move.find("{to}") == std::string::npos));
  GYRE_CHECK(table->units_per_turn >= 1.0 && table->units_per_turn <= 1e8);
  GYRE_CHECK(table->direction == 1 || table->direction == -1);
  GYRE_CHECK(table->decimals >= 0 && table->baud > 0);
  return 0;
}
