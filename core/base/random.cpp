// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/random.h"

#include <cmath>

#include "core/base/check.h"
#include "core/base/units.h"

namespace gyre {
namespace {

// Steele, Lea and Flood, "Fast splittable pseudorandom number generators" (2014), finalizer.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

constexpr std::uint64_t kGoldenGamma = 0x9e3779b97f4a7c15ULL;

}  // namespace

std::uint64_t hashWords(std::initializer_list<std::uint64_t> words) {
  std::uint64_t hash = kGoldenGamma;
  for (const std::uint64_t word : words) hash = mix(hash + kGoldenGamma + mix(word));
  return hash;
}

std::uint64_t Random::next() {
  state_ += kGoldenGamma;
  return mix(state_);
}

double Random::uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

double Random::uniform(double from, double to) { return from + (to - from) * uniform(); }

double Random::gaussian() {
  // Box and Muller; 1 - u keeps the logarithm's argument above zero.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(kTurn_rad * uniform());
}

std::uint64_t Random::below(std::uint64_t n) {
  GYRE_CHECK(n > 0);
  return next() % n;
}

}  // namespace gyre
