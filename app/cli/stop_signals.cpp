// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/stop_signals.h"

#include <pthread.h>
#include <csignal>
#include <ctime>

namespace gyre {
namespace {

constexpr long kPoll_ns = 100'000'000;

sigset_t stopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void listen(const std::stop_token& ended, const std::stop_source& stop) {
  const sigset_t signals = stopSignals();
  const timespec poll{0, kPoll_ns};
  while (!ended.stop_requested()) {
    if (sigtimedwait(&signals, nullptr, &poll) < 0) continue;
    stop.request_stop();
    // In this thread the signals act again, so the next one ends the program.
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    while (!ended.stop_requested()) nanosleep(&poll, nullptr);
  }
}

}  // namespace

StopSignals::StopSignals() {
  const sigset_t signals = stopSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  listener_ = std::jthread([stop = stop_](const std::stop_token& ended) { listen(ended, stop); });
}

StopSignals::~StopSignals() {
  listener_.request_stop();
  listener_.join();
  const sigset_t signals = stopSignals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace gyre
