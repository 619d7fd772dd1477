// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/ask_person.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
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

// What was typed before the end of the line.
Result<std::string> awaitLine(int keys, const Task& task) {
  std::string line;
  for (;;) {
    if (task.stopRequested()) return cancelled();
    pollfd entry{keys, POLLIN, 0};
    const int ready = poll(&entry, 1, kPoll_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    char key = '\0';
    const auto count = ready < 0 ? ssize_t{0} : read(keys, &key, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return nobody();
    if (key == '\n') return line;
    line += key;
  }
}

}  // namespace

AskPerson askAtTerminal(Console& console, int keys) {
  return [&console, keys](const HandTurn& turn, const Task& task) {
    console.warn(request(turn));
    const Result<std::string> entered = awaitLine(keys, task);
    return entered ? Result<void>() : entered.error();
  };
}

TellPerson tellAtTerminal(Console& console) {
  return [&console](const FreeTurn& turn) {
    if (!turn.seen) {
      console.warn("The markers on the platter are not seen: take hands away, keep them lit.");
      return;
    }
    console.warn(
        formatted("Turn the table %s, seen from above, by about %.0f\u00b0 and let go of it.",
                  turn.by_deg > 0.0 ? "counter-clockwise" : "clockwise", std::abs(turn.by_deg)));
  };
}

Result<void> allowUnlock(Turntable& table, UnlockWord word, Console& console, const Task& task,
                         int keys) {
  const std::string lock = table.info().lock;
  if (lock.empty()) return {};
  const Error locked{Error::Code::kNoPermission, lock, ""};
  if (word == UnlockWord::kAsk) {
    if (isatty(keys) == 0) return locked;
    console.warn(lock);
    console.warn("May it be unlocked now? Type y and press Enter; anything else leaves it locked.");
    const Result<std::string> answer = awaitLine(keys, task);
    if (!answer && answer.error().code == Error::Code::kCancelled) return answer.error();
    if (!answer || (*answer != "y" && *answer != "Y" && *answer != "yes")) return locked;
  }
  table.allowUnlock();
  return {};
}

}  // namespace gyre
