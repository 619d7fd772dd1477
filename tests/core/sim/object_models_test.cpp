// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/object_models.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace gyre {
namespace {

TEST(ObjectModels, StayInsideTheirBoxes) {
  for (const std::string& name : objectNames()) {
    const ObjectModel model = objectModel(name);
    if (!model.distance) continue;
    // On the box's sides (but for the base) nothing of the object is left.
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
      Eigen::Vector3d p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = random.uniform(model.box.min[axis], model.box.max[axis]);
      }
      const auto side = static_cast<int>(random.below(5));
      p[side / 2] = side % 2 == 0 ? model.box.max[side / 2] : model.box.min[side / 2];
      ASSERT_GT(model.distance(p), 0.0) << name << " at " << p.transpose();
    }
  }
}

TEST(ObjectModels, StandOnZero) {
  for (const std::string& name : objectNames()) {
    const ObjectModel model = objectModel(name);
    if (!model.distance) continue;
    for (double x = -50.0; x <= 50.0; x += 2.0) {
      for (double y = -50.0; y <= 50.0; y += 2.0) {
        ASSERT_GE(model.distance({x, y, -0.5}), 0.0) << name;
      }
    }
  }
}

// What the mesher relies on to skip empty space: where the sign changes within a distance, the
// function is not far above that distance.
TEST(ObjectModels, DistancesPromiseNoMoreEmptySpaceThanThereIs) {
  for (const std::string& name : objectNames()) {
    const ObjectModel model = objectModel(name);
    if (!model.distance) continue;
    Random random(4);
    for (int i = 0; i < 40000; ++i) {
      Eigen::Vector3d p;
      Eigen::Vector3d step;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = random.uniform(model.box.min[axis], model.box.max[axis]);
        step[axis] = 3.0 * random.gaussian();
      }
      const double here = model.distance(p);
      if ((here < 0.0) == (model.distance(p + step) < 0.0)) continue;
      const double most = here < 0.0 ? kMostStretchInside : kMostStretchOutside;
      ASSERT_LE(std::abs(here), most * step.norm()) << name << " at " << p.transpose();
    }
  }
}

TEST(ObjectModels, PaintIsAColour) {
  for (const std::string& name : objectNames()) {
    const ObjectModel model = objectModel(name);
    const Eigen::Vector3f paint = model.paint(0.5 * (model.box.min + model.box.max));
    EXPECT_GE(paint.minCoeff(), 0.0F);
    EXPECT_LE(paint.maxCoeff(), 1.0F);
  }
}

TEST(ObjectModels, DuckHasEyesAndAnOrangeBeak) {
  const ObjectModel duck = objectModel("duck");
  EXPECT_LT(duck.paint({24.0, 9.0, 48.5}).maxCoeff(), 0.1F);
  EXPECT_LT(duck.paint({37.0, 0.0, 41.6}).y(), 0.5F);
  EXPECT_GT(duck.paint({-20.0, 0.0, 30.0}).y(), 0.8F);
}

}  // namespace
}  // namespace gyre
