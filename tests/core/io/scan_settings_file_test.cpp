// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/scan_settings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/mutate.h"

namespace gyre {
namespace {

using testing::HasSubstr;
using testing::Not;

ScanSettings oddSettings() {
  ScanSettings settings;
  settings.title = "Krug \"blau\", 猫";
  settings.inventory_number = "1899/4\\b";
  settings.rights = "CC0\n";
  settings.turntable = "sim:duck";
  settings.camera = "rtsp://camera.local:554/live?channel=1";
  settings.camera_mode = "1920x1080@MJPG";
  settings.axis = "A";
  settings.sim_rig_json = R"({"seed":7,"rig":{"z_mm":0.1,"a":[1,2]}})";
  settings.views = 72;
  settings.start_angle_rad = 0.1 + 0.2;
  return settings;
}

TEST(ScanSettingsText, ReadsBackTheSame) {
  const ScanSettings settings = oddSettings();
  const auto back = parseScanSettings(*scanSettingsText(settings), "f");
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->title, settings.title);
  EXPECT_EQ(back->inventory_number, settings.inventory_number);
  EXPECT_EQ(back->rights, settings.rights);
  EXPECT_EQ(back->turntable, settings.turntable);
  EXPECT_EQ(back->camera, settings.camera);
  EXPECT_EQ(back->camera_mode, settings.camera_mode);
  EXPECT_EQ(back->axis, settings.axis);
  EXPECT_EQ(back->sim_rig_json, settings.sim_rig_json);
  EXPECT_EQ(back->views, settings.views);
  EXPECT_EQ(back->start_angle_rad, settings.start_angle_rad);
}

TEST(ScanSettingsText, KeepsHowTheCameraWasSet) {
  ScanSettings settings = oddSettings();
  settings.camera_controls = {{"focus", true, 35.0, ""},
                              {"exposure", true, 0.008, "", "1/125"},
                              {"gain", false, 0.0, "The camera keeps changing it by itself."}};
  const auto back = parseScanSettings(*scanSettingsText(settings), "f");
  ASSERT_TRUE(back) << back.error().sentence();
  ASSERT_EQ(back->camera_controls.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back->camera_controls[i].name, settings.camera_controls[i].name);
    EXPECT_EQ(back->camera_controls[i].locked, settings.camera_controls[i].locked);
    EXPECT_EQ(back->camera_controls[i].value, settings.camera_controls[i].value);
    EXPECT_EQ(back->camera_controls[i].word, settings.camera_controls[i].word);
    EXPECT_EQ(back->camera_controls[i].remark, settings.camera_controls[i].remark);
  }
}

TEST(ScanSettingsText, HoldsTheRigAsAnObjectAndNothingOnRealHardware) {
  EXPECT_THAT(*scanSettingsText(oddSettings()), HasSubstr("\"seed\": 7"));
  EXPECT_THAT(*scanSettingsText(ScanSettings{}), Not(HasSubstr("sim_rig")));
  EXPECT_EQ(parseScanSettings(*scanSettingsText(ScanSettings{}), "f")->sim_rig_json, "");
}

TEST(ScanSettingsText, RefusesWhatItCouldNotRead) {
  ScanSettings settings = oddSettings();
  settings.sim_rig_json = R"({"seed":)";
  EXPECT_FALSE(scanSettingsText(settings));
  settings = oddSettings();
  settings.views = 0;
  EXPECT_FALSE(scanSettingsText(settings));
  settings = oddSettings();
  settings.start_angle_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(scanSettingsText(settings));
}

TEST(ScanSettingsText, NeverHoldsAPassword) {
  ScanSettings settings;
  settings.camera = "http://anna:geheim@10.0.0.7:8080/video?user=anna&password=geheim&w=640";
  const std::string text = *scanSettingsText(settings);
  EXPECT_THAT(text, Not(HasSubstr("geheim")));
  EXPECT_THAT(text, HasSubstr("http://anna:***@10.0.0.7:8080/video?user=anna&password=***&w=640"));
}

TEST(ParseScanSettings, TellsWhatIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "is damaged"},
      {"[1]", "\"format\""},
      {R"({"format":"gyre-calibration"})", "\"format\""},
      {R"({"format":"gyre-scan","version":9})", "version"},
      {R"({"format":"gyre-scan","version":1})", "\"views\""},
      {R"({"format":"gyre-scan","version":1,"views":"72"})", "\"views\""},
      {R"({"format":"gyre-scan","version":1,"views":-1})", "\"views\""},
      {R"({"format":"gyre-scan","version":1,"views":1000000})", "\"views\""},
      {R"({"format":"gyre-scan","version":1,"views":72})", "\"start_angle_rad\""},
      {R"({"format":"gyre-scan","version":1,"views":72,"start_angle_rad":1e9})", "angle_rad"},
  };
  for (const auto& [text, problem] : cases) {
    const auto settings = parseScanSettings(text, "duck.gyre");
    ASSERT_FALSE(settings) << text;
    EXPECT_THAT(settings.error().what, HasSubstr("duck.gyre"));
    EXPECT_THAT(settings.error().what, HasSubstr(problem));
  }
}

TEST(ParseScanSettings, SurvivesDamage) {
  const std::string text = *scanSettingsText(oddSettings());
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const auto settings = parseScanSettings(mutated(text, seed), "f");
    EXPECT_TRUE(!settings || settings->views > 0);
  }
}

}  // namespace
}  // namespace gyre
