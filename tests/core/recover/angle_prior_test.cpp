// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/angle_prior.h"

#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace gyre {
namespace {

TEST(InformationOf, IsTheInverseOfTheCovariance) {
  const std::vector<double> sigma_rad = {0.01, 0.02, 0.005, 0.01};
  const std::vector<double> turned_rad = {0.0, 0.5, 1.0, 6.0};
  const AnglePrior prior{sigma_rad, turned_rad, 0.02};
  const Eigen::Map<const Eigen::VectorXd> turned(turned_rad.data(), 4);
  const Eigen::Map<const Eigen::VectorXd> sigma(sigma_rad.data(), 4);
  Eigen::MatrixXd covariance = 0.02 * 0.02 * turned * turned.transpose();
  covariance.diagonal() += sigma.cwiseAbs2();
  EXPECT_LT((informationOf(prior) * covariance - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-9);
}

TEST(InformationOf, IsDiagonalWithoutScale) {
  const std::vector<double> sigma_rad = {0.1, 0.2};
  const Eigen::MatrixXd information = informationOf({sigma_rad});
  EXPECT_NEAR(information(0, 0), 100.0, 1e-9);
  EXPECT_NEAR(information(1, 1), 25.0, 1e-9);
  EXPECT_EQ(information(0, 1), 0.0);
}

TEST(InformationOf, LeavesHeldViewsOut) {
  const std::vector<double> sigma_rad = {0.0, 0.1, 0.1};
  const std::vector<double> turned_rad = {0.0, 1.0, 2.0};
  const Eigen::MatrixXd information = informationOf({sigma_rad, turned_rad, 0.05});
  EXPECT_TRUE(information.row(0).isZero());
  EXPECT_TRUE(information.col(0).isZero());
  EXPECT_LT(information(1, 2), 0.0);
}

// A turn that is too long as a whole costs next to nothing; one view that stands out costs all.
TEST(InformationOf, ForgivesACommonScale) {
  std::vector<double> sigma_rad(50, 0.01);
  std::vector<double> turned_rad;
  for (int view = 0; view < 50; ++view) turned_rad.push_back(0.12 * view);
  sigma_rad.front() = 0.0;
  const Eigen::MatrixXd information = informationOf({sigma_rad, turned_rad, 0.02});
  const Eigen::VectorXd scaled = 0.01 * Eigen::Map<const Eigen::VectorXd>(turned_rad.data(), 50);
  EXPECT_LT(scaled.dot(information * scaled), 0.5);
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(50);
  alone[20] = 0.02;
  EXPECT_GT(alone.dot(information * alone), 3.0);
}

TEST(InformationOf, IsEmptyForNoViews) { EXPECT_EQ(informationOf({}).size(), 0); }

}  // namespace
}  // namespace gyre
