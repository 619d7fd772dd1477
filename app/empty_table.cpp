// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/empty_table.h"

#include <string>

#include "core/base/clock.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"

namespace gyre {

Result<void> takeEmptyTable(const Rig& rig, ScanStore& store, const Task& task) {
  if (!rig.room || rig.room->camera == nullptr) return {};
  if (!store.readEmptyTable()) {
    rig.room->setTable(TableLoad::kEmpty);
    const auto picture = rig.camera->grabAfter(steadySeconds(), task);
    if (!picture) return picture.error();
    Frame frame = **picture;
    frame.table_angle_rad = rig.turntable->angleRad();
    if (const auto kept = store.addEmptyTable(frame); !kept) return kept;
  }
  rig.room->setTable(TableLoad::kObject);
  return {};
}

Result<void> keepEmptyTable(const std::filesystem::path& file_or_folder, ScanStore& store) {
  std::filesystem::path file = file_or_folder;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    const auto pictures = listPictures(file);
    if (!pictures) return pictures.error();
    file = pictures->front();
  }
  const auto frame = readPicture(file);
  if (!frame) return frame.error();
  const CameraModel& camera = store.calibration().camera;
  if (frame->image_bgr.cols != camera.width_px || frame->image_bgr.rows != camera.height_px) {
    return Error{Error::Code::kInvalidInput,
                 "The picture of the empty table has another size than the calibration.",
                 "Take it with the camera mode that is calibrated."};
  }
  return store.addEmptyTable(*frame);
}

}  // namespace gyre
