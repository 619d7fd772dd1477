// Opens a turntable and a camera from the words by which people name them.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/base/task.h"
#include "core/device/camera.h"
#include "core/device/hand_turntable.h"
#include "core/device/options.h"
#include "core/device/turntable.h"
#include "core/sim/renderer.h"
#include "core/sim/rig.h"
#include "core/sim/shaft.h"
#include "core/sim/sim_camera.h"
#include "core/sim/sim_clock.h"
#include "core/sim/turntable_firmware.h"

namespace gyre {

struct RigOptions {
  TurntableOptions turntable;
  std::string camera_mode;  // "1920x1080@MJPG"; empty: the largest at 5 pictures a second or more
  int mains_hz = 0;         // 50 or 60, against lamps that flicker; 0 leaves the camera's own
  RigSettings sim;          // the simulated rig
  double sim_speed = 10.0;  // simulated seconds a second, > 0
  AskPerson ask_person;     // who turns a table without a motor; empty: nobody
};

// The far end of a simulated rig: what a real one has instead of a program.
struct SimulatedRoom {
  RigSettings settings;
  std::shared_ptr<Shaft> shaft;
  std::unique_ptr<TurntableFirmware> firmware;
  std::shared_ptr<const Renderer> renderer;  // null when the camera is a real one
  SimCamera* camera = nullptr;               // the hand's way to the table; owned by Rig::camera

  // Puts the object on the table, or takes it away.
  void setTable(TableLoad load) const;
  // Turns the object upside down, or back, and lays it a little aside. Takes about a second.
  Result<void> turnOver();
};

struct Rig {
  std::unique_ptr<SimulatedRoom> room;  // null when turntable and camera are real
  std::unique_ptr<Turntable> turntable;
  std::unique_ptr<Camera> camera;
};

// "sim" or "sim:OBJECT", and the object (empty when none is named); the object may be
// "target:NAME_OR_FILE" (see placeObject). For other words: false.
bool namesSimulation(const std::string& word);
std::string simulatedObject(const std::string& turntable_word);

// A turntable behind "sim[:OBJECT]" or what turntableWord() reads. It is identified and not moved.
// room: given for a simulated one.
Result<std::unique_ptr<Turntable>> openTurntable(const std::string& word, const RigOptions& options,
                                                 SimulatedRoom* room, const Task& task);

// A camera behind "sim", a number or path of a device, a URL, "gphoto:", "ptpip:HOST[:PORT]", a
// folder of pictures or a video file.
Result<std::unique_ptr<Camera>> openCamera(const std::string& word, const RigOptions& options,
                                           SimulatedRoom* room);

// Both, simulated ones in one room: the simulated camera sees the simulated turntable only.
Result<Rig> openRig(const std::string& turntable_word, const std::string& camera_word,
                    const RigOptions& options, const Task& task);

}  // namespace gyre
