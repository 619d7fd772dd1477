// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/adaptive_alpha.h"

#include <stop_token>

#include <gtest/gtest.h>

#include "core/mesh/mesh_health.h"
#include "tests/support/seen_bodies.h"

namespace gyre {
namespace {

void expectTheBody(const test::Body& body, double noise_share) {
  const auto seen = test::seenBody(body, noise_share, 3);
  const auto made = adaptiveAlphaMesh(seen.cloud, seen.sights, {}, {});
  ASSERT_TRUE(made) << made.error().sentence();
  const MeshHealth health = meshHealth(made->mesh);
  EXPECT_TRUE(health.closed);
  EXPECT_TRUE(health.manifold);
  EXPECT_EQ(health.components, 1U);
  EXPECT_EQ(health.euler_number, body.euler_number);
  EXPECT_LT(test::errorInSpacings(made->mesh, body, 0.95), 1.0);
}

TEST(AdaptiveAlphaMesh, FollowsADensityThatChangesTenfold) {
  for (const double noise_share : {0.0, 0.1}) expectTheBody(test::tenfoldBody(), noise_share);
}

TEST(AdaptiveAlphaMesh, KeepsTheHoleOfATorus) { expectTheBody(test::torusBody(), 0.1); }

TEST(AdaptiveAlphaMesh, KeepsAPlateOfTwoSpacings) { expectTheBody(test::plateBody(), 0.05); }

TEST(AdaptiveAlphaMesh, WorksWithoutSights) {
  const auto seen = test::seenBody(test::torusBody(), 0.05, 3);
  const auto made = adaptiveAlphaMesh(seen.cloud, {}, {}, {});
  ASSERT_TRUE(made);
  EXPECT_TRUE(meshHealth(made->mesh).closed);
}

TEST(AdaptiveAlphaMesh, SaysWhatItCannotDo) {
  EXPECT_EQ(adaptiveAlphaMesh({}, {}, {}, {}).error().code, Error::Code::kTooFew);
  std::stop_source stop;
  stop.request_stop();
  const auto seen = test::seenBody(test::plateBody(), 0.05, 3);
  EXPECT_EQ(adaptiveAlphaMesh(seen.cloud, {}, {}, Task(stop.get_token())).error().code,
            Error::Code::kCancelled);
}

}  // namespace
}  // namespace gyre
