// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/solid_texture.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

Eigen::Vector3f somewhere(Random& random) {
  return {static_cast<float>(random.uniform(-40.0, 40.0)),
          static_cast<float>(random.uniform(-40.0, 40.0)),
          static_cast<float>(random.uniform(0.0, 60.0))};
}

TEST(SolidTexture, HasMeanZeroAndSigmaOneInFourIndependentChannels) {
  const SolidTexture texture(1, 0.75, 11.0);
  Random random(5);
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  constexpr int kCount = 40000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector4d value = texture.at(somewhere(random)).matrix().cast<double>();
    sum += value / kCount;
    products += value * value.transpose() / kCount;
  }
  // The tile holds some hundreds of waves an octave: its own mean and variance vary by this much.
  EXPECT_LT(sum.cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((products - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 0.1);
}

TEST(SolidTexture, IsSmoothAtAFractionOfItsFinestWave) {
  const SolidTexture texture(1, 0.75, 11.0);
  Random random(6);
  double squares = 0.0;
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3f p = somewhere(random);
    const float change = texture.at(p + Eigen::Vector3f(0.075F, 0.0F, 0.0F))[0] - texture.at(p)[0];
    squares += static_cast<double>(change) * static_cast<double>(change) / kCount;
  }
  // A tenth of the finest wave moves that octave by 2 pi / 10 / sqrt(3) of itself at most; there
  // are four octaves of equal strength and the others change less.
  EXPECT_LT(std::sqrt(squares), 0.3);
  EXPECT_GT(std::sqrt(squares), 0.05);
}

TEST(SolidTexture, SeedChoosesIt) {
  const Eigen::Vector3f p(1.0F, 2.0F, 3.0F);
  EXPECT_TRUE((SolidTexture(1, 1.0, 8.0).at(p) == SolidTexture(1, 1.0, 8.0).at(p)).all());
  EXPECT_FALSE((SolidTexture(1, 1.0, 8.0).at(p) == SolidTexture(2, 1.0, 8.0).at(p)).any());
}

}  // namespace
}  // namespace gyre
