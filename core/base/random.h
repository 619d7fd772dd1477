// Random numbers that are the same on every machine and for every number of threads.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>

namespace gyre {

// A 64-bit hash of the words, well mixed: the seed of something identified by several numbers.
std::uint64_t hashWords(std::initializer_list<std::uint64_t> words);

// A small generator (splitmix64). Copies continue independently from the same state.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next();
  double uniform();                        // in [0, 1)
  double uniform(double from, double to);  // in [from, to)
  double gaussian();                       // mean 0, standard deviation 1
  std::uint64_t below(std::uint64_t n);    // in [0, n), n > 0

 private:
  std::uint64_t state_;
};

}  // namespace gyre
