// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/rig.h"

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/sim_target.h"
#include "app/table_at_port.h"
#include "app/turntable_word.h"
#include "core/base/check.h"
#include "core/device/discovery.h"
#include "core/device/folder_camera.h"
#include "core/device/gphoto_camera.h"
#include "core/device/opencv_source.h"
#include "core/device/protocol_turntable.h"
#include "core/device/stream_source.h"
#include "core/device/streaming_camera.h"
#include "core/device/video_file_camera.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"

namespace gyre {
namespace {

// What a picture needs from the sensor to the driver: USB cameras about a frame at 30 a second;
// cameras on a network code it, buffer it and send it.
constexpr double kUsbDelay_s = 0.04;
// A simulated camera has no cable that could be pulled: when it is silent, the processor is busy.
constexpr double kSimSilence_s = 60.0;
constexpr double kNetworkDelay_s = 0.25;
// A network camera that was lost is looked for again so long before the scan gives up.
constexpr double kNetworkSilence_s = 20.0;
constexpr double kNetworkPatience_s = 40.0;
// A hand that turns an object over does not lay it exactly as it lay.
constexpr double kUpsideDown_deg = 180.0;
constexpr double kLaidAside_deg = 50.0;

Result<std::unique_ptr<SimulatedRoom>> furnish(const std::string& turntable_word,
                                               const RigOptions& options) {
  auto room = std::make_unique<SimulatedRoom>();
  room->settings = options.sim;
  placeObject(simulatedObject(turntable_word), room->settings);
  if (const auto valid = room->settings.validate(); !valid) return valid.error();
  room->shaft = std::make_shared<Shaft>(
      std::llround(room->settings.backlash_deg / 360.0 * room->settings.steps_per_turn));
  TurntableFirmwareOptions firmware;
  firmware.steps_per_turn = room->settings.firmware_steps_per_turn > 0.0
                                ? room->settings.firmware_steps_per_turn
                                : room->settings.steps_per_turn;
  room->firmware =
      std::make_unique<TurntableFirmware>(firmware, room->shaft, SimClock(options.sim_speed));
  return room;
}

// The person's table, or the one at a port.
Result<std::unique_ptr<Turntable>> openReal(const TurntableWord& word, TurntableOptions options,
                                            const AskPerson& ask, const Task& task) {
  if (word.port.empty()) {
    if (word.marks > 0) options.steps_per_turn = word.marks;
    auto table = HandTurntable::open(options, ask);
    if (!table) return table.error();
    return std::unique_ptr<Turntable>(std::move(table).value());
  }
  if (options.device_id.empty() && !word.isNetwork()) options.device_id = stablePathOf(word.port);
  TableSearch search = searchAtPort(word, options.greeting_s, task.part(0.0, 0.05));
  if (!search.driver) return *search.error;
  auto table = ProtocolTurntable::adopt(std::move(search.driver), options, task);
  if (!table) return table.error();
  return std::unique_ptr<Turntable>(std::move(table).value());
}

Result<std::unique_ptr<Camera>> openFolder(const std::string& folder) {
  auto pictures = listPictures(folder);
  if (!pictures) return pictures.error();
  const auto read = [](const std::filesystem::path& picture) -> Result<cv::Mat> {
    const auto frame = readPicture(picture);
    if (!frame) return frame.error();
    return frame->image_bgr;
  };
  return std::unique_ptr<Camera>(std::make_unique<FolderCamera>(std::move(pictures).value(), read));
}

Result<std::unique_ptr<Camera>> openStream(const std::string& url) {
  auto source = openStreamSource(url);
  if (!source) return source.error();
  StreamingCameraOptions streaming;
  streaming.transport_delay_s = kNetworkDelay_s;
  streaming.silence_s = kNetworkSilence_s;
  streaming.patience_s = kNetworkPatience_s;
  return std::unique_ptr<Camera>(
      std::make_unique<StreamingCamera>(std::move(source).value(), streaming));
}

Result<std::unique_ptr<Camera>> openDevice(const std::string& word, const RigOptions& options) {
  OpenCvSourceOptions mode;
  if (!options.camera_mode.empty()) {
    auto read = cameraModeFromText(options.camera_mode);
    if (!read) return read.error();
    mode = std::move(read).value();
  }
  mode.mains_hz = options.mains_hz;
  auto source = openOpenCvSource(word, mode);
  if (!source) return source.error();
  StreamingCameraOptions streaming;
  streaming.transport_delay_s = kUsbDelay_s;
  return std::unique_ptr<Camera>(
      std::make_unique<StreamingCamera>(std::move(source).value(), streaming));
}

Result<std::unique_ptr<Camera>> openSimulated(const RigOptions& options, SimulatedRoom* room) {
  if (room == nullptr) {
    return Error{Error::Code::kInvalidInput,
                 "The simulated camera sees only the simulated turntable.",
                 "Use `--turntable sim` with it, or name a real camera."};
  }
  auto target = simulatedTarget(room->settings);
  if (!target) return target.error();
  room->renderer = std::make_shared<const Renderer>(room->settings, std::move(target).value());
  auto source =
      std::make_unique<SimCamera>(room->renderer, room->shaft, SimClock(options.sim_speed));
  room->camera = source.get();
  StreamingCameraOptions streaming;
  streaming.silence_s = kSimSilence_s;
  streaming.patience_s = 2.0 * kSimSilence_s;
  return std::unique_ptr<Camera>(std::make_unique<StreamingCamera>(std::move(source), streaming));
}

}  // namespace

void SimulatedRoom::setTable(TableLoad load) const {
  if (camera != nullptr) camera->setTable(load);
}

Result<void> SimulatedRoom::turnOver() {
  if (camera == nullptr) return {};
  settings.object_roll_deg = settings.object_roll_deg == 0.0 ? kUpsideDown_deg : 0.0;
  settings.object_yaw_deg = std::remainder(settings.object_yaw_deg + kLaidAside_deg, 360.0);
  auto target = simulatedTarget(settings);
  if (!target) return target.error();
  renderer = std::make_shared<const Renderer>(settings, std::move(target).value());
  camera->setRoom(renderer);
  return {};
}

bool namesSimulation(const std::string& word) { return word == "sim" || word.starts_with("sim:"); }

std::string simulatedObject(const std::string& turntable_word) {
  return turntable_word.starts_with("sim:") ? turntable_word.substr(4) : "";
}

Result<std::unique_ptr<Turntable>> openTurntable(const std::string& word, const RigOptions& options,
                                                 SimulatedRoom* room, const Task& task) {
  if (!namesSimulation(word)) {
    if (const auto valid = options.turntable.validate(); !valid) return valid.error();
    const auto parsed = turntableWord(word);
    if (!parsed) return parsed.error();
    return openReal(*parsed, options.turntable, options.ask_person, task);
  }
  GYRE_CHECK(room != nullptr);
  TurntableOptions harmless = options.turntable;
  harmless.may_unlock = true;  // there is no machine that could move unexpectedly
  auto turntable = ProtocolTurntable::open(room->firmware->openPort(), harmless, task);
  if (!turntable) return turntable.error();
  return std::unique_ptr<Turntable>(std::move(turntable).value());
}

Result<std::unique_ptr<Camera>> openCamera(const std::string& word, const RigOptions& options,
                                           SimulatedRoom* room) {
  if (word == "sim") return openSimulated(options, room);
  if (namesStream(word)) return openStream(word);
  if (namesGphoto(word)) return openGphotoCamera(word);
  std::error_code ignored;
  if (std::filesystem::is_directory(word, ignored)) return openFolder(word);
  if (std::filesystem::is_regular_file(word, ignored)) {
    auto video = openVideoFile(word);
    if (!video) return video.error();
    return std::unique_ptr<Camera>(std::move(video).value());
  }
  return openDevice(word, options);
}

Result<Rig> openRig(const std::string& turntable_word, const std::string& camera_word,
                    const RigOptions& options, const Task& task) {
  Rig rig;
  if (namesSimulation(turntable_word)) {
    auto room = furnish(turntable_word, options);
    if (!room) return room.error();
    rig.room = std::move(room).value();
  }
  auto camera = openCamera(camera_word, options, rig.room.get());
  if (!camera) return camera.error();
  rig.camera = std::move(camera).value();
  auto turntable = openTurntable(turntable_word, options, rig.room.get(), task);
  if (!turntable) return turntable.error();
  rig.turntable = std::move(turntable).value();
  return rig;
}

}  // namespace gyre
