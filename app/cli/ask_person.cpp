// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/ask_person.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

#include "core/base/formatted.h"

namespace gyre {
namespace {

constexpr int kPoll_ms = 20;  // how long a stop may take

std::string request(const HandTurn& turn) {
  const auto marks = std::llabs(turn.ticks);
  return formatted(
      "Turn the table %s, seen from above, by %lld mark%s to %.6g\u00b0, and press "
      "Enter.",
      turn.ticks > 0 ? "counter-clockwise" : "clockwise", marks, marks == 1 ? "" : "s",
      turn.to_deg);
}

Error nobody() {
  return {Error::Code::kGone, "Nobody says any more that the table was turned.",
          "Run the command in a terminal, and go on with `gyre resume`."};
}

// Waits for the end of a line.
Result<void> awaitEnter(int keys, const Task& task) {
  for (;;) {
    if (task.stopRequested()) return cancelled();
    pollfd entry{keys, POLLIN, 0};
    const int ready = poll(&entry, 1, kPoll_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    char key = '\0';
    const auto count = ready < 0 ? ssize_t{0} : read(keys, &key, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return nobody();
    if (key == '\n') return {};
  }
}

}  // namespace

AskPerson askAtTerminal(Console& console, int keys) {
  return [&console, keys](const HandTurn& turn, const Task& task) {
    console.warn(request(turn));
    return awaitEnter(keys, task);
  };
}

}  // namespace gyre
