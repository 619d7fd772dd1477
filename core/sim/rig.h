// What the simulated rig is made of, and the truth about it that follows from its numbers alone.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/scan/calibration_record.h"

namespace gyre {

// Everything about the rig is a function of these numbers; a second program with the same ones
// sees the same world. The defaults are the default rig, at which published figures are judged.
struct RigSettings {
  int seed = 1;
  std::string object = "duck";     // one of objectNames(), or "target"
  std::string material = "matte";  // matte, or glossy: Phong, exponent 30, ks 0.3
  double object_size_mm = 80.0;    // diagonal of the object's bounding box
  double object_offset_mm = 5.0;   // from the axis, in a direction that the seed chooses
  double object_roll_deg = 0.0;    // turned over about the table's x axis: 180 = upside down
  double object_yaw_deg = 0.0;     // then turned about the upright, counter-clockwise
  double texture_finest_mm = 0.75;
  double texture_contrast = 1.0;

  // A calibration target: its file or its name. It is the object when that is "target" (the wedge
  // when none is named); otherwise it lies on the platter, about the axis, under the object.
  std::string target;
  double target_bow_mm = 0.0;          // how far the middle of each face stands out
  double target_fold_error_deg = 0.0;  // how far each face leans off
  double print_scale_right = 1.0;      // what 1 mm on the page became along its width
  double print_scale_down = 1.0;       // and along its height

  int image_width_px = 1280;
  int image_height_px = 960;
  double focal_px = 2400.0;
  double k1 = -0.08;
  double principal_offset_x_px = 8.0;  // together 10 px off the middle of the picture
  double principal_offset_y_px = -6.0;
  double camera_distance_mm = 350.0;  // along the optical axis, to where it meets the table's axis
  double camera_elevation_deg = 30.0;
  double camera_roll_deg = 1.0;
  double aim_height_mm = 20.0;  // above the platter, where the optical axis meets the table's axis
  double frames_per_s = 30.0;

  double key_light_deg = 40.0;  // off the camera's axis, up and to the left; fixed to the room
  double key_light = 0.70;
  double ambient_light = 0.40;
  double background_flicker = 0.01;  // relative standard deviation of its brightness
  double platter_radius_mm = 70.0;
  double exposure_gain = 1.0;  // all light is brighter by this; full scale stays
  double noise_sigma = 2.0;    // grey levels of 255, in each channel
  double blur_sigma_px = 0.8;

  double bump_px = 0.0;        // somebody knocks the camera aside: the picture moves by so much
  double push_mm = 0.0;        // somebody pushes the table: it slides to the camera's right
  double bump_at_deg = 180.0;  // from where on the table, as commanded, both stay so

  int steps_per_turn = 3200;
  double firmware_steps_per_turn = 0.0;  // what its board believes; 0 = the truth
  int motor_direction = 1;               // -1: wired so that plus turns the table clockwise
  double step_scale_error = 0.0;         // relative: 0.001 turns 360.36 deg for 360
  double white_error_deg = 0.02;
  double once_per_turn_error_deg = 0.05;  // amplitude; the seed chooses the phase
  double backlash_deg = 0.0;              // lost when the motor turns back

  template <class V>
  void describe(V& visit);

  // Fails on a number out of its range, an unknown object or an unknown material.
  Result<void> validate() const;
};

// The same rig with another picture size: the focal length and all that is bound to pixels follow
// the width, so that the same scene fills the picture.
RigSettings atImageWidth(RigSettings rig, int width_px);

// The camera as it truly is; the table's x axis points towards it at angle 0.
Calibration trueCalibration(const RigSettings& rig);

// The same with the target that lies under the object, such as a ring: its name and place.
CalibrationRecord trueRecord(const RigSettings& rig);

// The camera of trueCalibration() once it has been knocked aside by bump_px, about its own centre.
Calibration bumpedCalibration(const RigSettings& rig);
bool isBumped(const RigSettings& rig, std::int64_t steps);  // or pushed

// How far the table slides when it is pushed; the base frame stays where it was.
Eigen::Vector3d pushInBase(const RigSettings& rig);  // mm

// Where the table truly stands after so many commanded steps; exactly 0 at 0 steps, because the
// first picture defines the table frame. Nominal angle, scaled, with a once-per-turn and a white
// error; a pure function of the rig's numbers and the steps.
double trueAngleRad(const RigSettings& rig, std::int64_t steps);

// Unit vector towards the key light; the base frame stands still.
Eigen::Vector3d keyLightInBase(const RigSettings& rig);

// Where the object's middle stands on the platter.
Eigen::Vector2d objectOffsetInTable(const RigSettings& rig);  // mm

// Where the calibration target stands: turned as the seed chooses; as far off the axis as objects
// are when it is the object itself.
Rigid3 tableFromTarget(const RigSettings& rig);

template <class V>
void RigSettings::describe(V& visit) {
  visit({"seed", "", 0, 2147483647, "Chooses texture, clutter, noise and motor errors."}, seed);
  visit({"object", "", 0, 0, "What stands on the table."}, object);
  visit({"material", "", 0, 0, "How its surface shines: matte or glossy."}, material);
  visit({"object-size", "mm", 5, 500, "Diagonal of its bounding box."}, object_size_mm);
  visit({"object-offset", "mm", 0, 100, "How far off the axis it stands."}, object_offset_mm);
  visit({"object-roll", "deg", -180, 180, "How far it is turned over; 180 is upside down."},
        object_roll_deg);
  visit({"object-yaw", "deg", -180, 180, "How far it is turned about the upright, after that."},
        object_yaw_deg);
  visit({"texture-finest", "mm", 0.05, 20, "Wavelength of the finest texture."}, texture_finest_mm);
  visit({"texture-contrast", "", 0, 1, "Strength of the texture."}, texture_contrast);
  visit({"target", "", 0, 0, "Calibration target on the table: a file or a name."}, target);
  visit({"target-bow", "mm", -10, 10, "How far its faces stand out in the middle."}, target_bow_mm);
  visit({"target-fold-error", "deg", -10, 10, "How far its faces lean off."},
        target_fold_error_deg);
  visit(
      {"print-scale-right", "", 0.5, 2, "How much its print is stretched along the page's width."},
      print_scale_right);
  visit(
      {"print-scale-down", "", 0.5, 2, "How much its print is stretched along the page's height."},
      print_scale_down);
  visit({"image-width", "px", 16, 8192, "Width of the pictures."}, image_width_px);
  visit({"image-height", "px", 16, 8192, "Height of the pictures."}, image_height_px);
  visit({"focal", "px", 10, 100000, "Focal length."}, focal_px);
  visit({"k1", "", -0.5, 0.5, "Radial distortion."}, k1);
  visit({"principal-offset-x", "px", -500, 500, "Optical axis right of the middle."},
        principal_offset_x_px);
  visit({"principal-offset-y", "px", -500, 500, "Optical axis below the middle."},
        principal_offset_y_px);
  visit({"camera-distance", "mm", 50, 10000, "From the camera to the axis, along its view."},
        camera_distance_mm);
  visit({"camera-elevation", "deg", -80, 89, "How far the camera looks down."},
        camera_elevation_deg);
  visit({"camera-roll", "deg", -180, 180, "How far the camera is tilted."}, camera_roll_deg);
  visit({"aim-height", "mm", -200, 500, "Height at which the camera looks."}, aim_height_mm);
  visit({"frames-per-s", "1/s", 1, 1000, "Pictures a simulated second."}, frames_per_s);
  visit({"key-light-angle", "deg", 0, 90, "Key light off the camera's axis."}, key_light_deg);
  visit({"key-light", "", 0, 2, "Strength of the key light."}, key_light);
  visit({"ambient-light", "", 0, 2, "Strength of the light from everywhere."}, ambient_light);
  visit({"background-flicker", "", 0, 0.2, "How much the background's brightness changes."},
        background_flicker);
  visit({"platter-radius", "mm", 5, 500, "Radius of the platter."}, platter_radius_mm);
  visit({"exposure-gain", "", 0.01, 100, "How much brighter the pictures are."}, exposure_gain);
  visit({"noise-sigma", "", 0, 50, "Noise of the sensor in grey levels."}, noise_sigma);
  visit({"blur-sigma", "px", 0, 5, "Blur of the lens."}, blur_sigma_px);
  visit({"bump", "px", -100, 100, "How far somebody knocks the picture aside."}, bump_px);
  visit({"push", "mm", -50, 50, "How far somebody pushes the table."}, push_mm);
  visit({"bump-at", "deg", -36000, 36000, "Where the table then stands."}, bump_at_deg);
  visit({"steps-per-turn", "", 8, 10000000, "Motor steps a turn."}, steps_per_turn);
  visit({"firmware-steps-per-turn", "", 0, 10000000, "What the board is set up for; 0: the truth."},
        firmware_steps_per_turn);
  visit({"motor-direction", "", -1, 1, "-1 when the motor turns the other way round."},
        motor_direction);
  visit({"step-scale-error", "", -0.2, 0.2, "How much too far the motor turns."}, step_scale_error);
  visit({"white-error", "deg", 0, 5, "Random error of each position."}, white_error_deg);
  visit({"once-per-turn-error", "deg", 0, 5, "Error that comes back with each turn."},
        once_per_turn_error_deg);
  visit({"backlash", "deg", 0, 20, "Play of gears or belt, lost when the motor turns back."},
        backlash_deg);
}

}  // namespace gyre
