// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_format.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(ModelFormatOf, KnowsTheEndingsInAnyCase) {
  EXPECT_EQ(modelFormatOf("a.ply"), ModelFormat::kPly);
  EXPECT_EQ(modelFormatOf("/some/where.stl/a.OBJ"), ModelFormat::kObj);
  EXPECT_EQ(modelFormatOf("a.b.Stl"), ModelFormat::kStl);
  EXPECT_EQ(modelFormatOf("a.3MF"), ModelFormat::kThreeMf);
  EXPECT_EQ(modelFormatOf("ä.glb"), ModelFormat::kGlb);
}

TEST(ModelFormatOf, KnowsNoOthers) {
  for (const char* name :
       {"", ".", "stl", ".stl", "a", "a.", "a.gltf", "a.stl ", "a.stlx", "a.st"}) {
    EXPECT_FALSE(modelFormatOf(name)) << name;
  }
}

}  // namespace
}  // namespace gyre
