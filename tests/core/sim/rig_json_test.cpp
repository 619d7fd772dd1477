// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/rig_json.h"

#include <gtest/gtest.h>

namespace gyre {
namespace {

TEST(RigJson, ComesBackAsWritten) {
  RigSettings rig;
  rig.seed = 77;
  rig.object = "vase";
  rig.k1 = -0.1234567890123;
  const auto read = rigFromJson(rigToJson(rig));
  ASSERT_TRUE(read.ok()) << read.error().sentence();
  EXPECT_EQ(rigToJson(*read), rigToJson(rig));
  EXPECT_EQ(read->object, "vase");
  EXPECT_EQ(read->k1, rig.k1);
}

TEST(RigJson, KeepsWhatIsNotNamed) {
  RigSettings base;
  base.object = "bowl";
  const auto read = rigFromJson(R"({"noise_sigma": 0})", base);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->object, "bowl");
  EXPECT_EQ(read->noise_sigma, 0.0);
}

TEST(RigJson, RefusesEachKindOfNonsenseWithASentence) {
  for (const char* text :
       {"", "[]", "{", R"({"sed": 1})", R"({"seed": "one"})", R"({"seed": 1.5})",
        R"({"seed": 99999999999})", R"({"object": "teapot"})", R"({"focal": 0})"}) {
    const auto read = rigFromJson(text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().code, Error::Code::kInvalidInput) << text;
    EXPECT_FALSE(read.error().what.empty());
  }
}

TEST(RigJson, KnowsAKeyThatIsWrittenAsOnTheCommandLine) {
  const auto read = rigFromJson(R"({"camera-elevation": 15})");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().advice, "Write it as 'camera_elevation'.");
}

}  // namespace
}  // namespace gyre
