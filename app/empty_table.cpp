// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/empty_table.h"

#include <memory>
#include <utility>

#include "core/base/clock.h"
#include "core/io/empty_table_file.h"
#include "core/scan/picture_size.h"

namespace gyre {

Result<EmptyTable> pictureOfEmptyTable(const Rig& rig, const Task& task) {
  if (rig.room) rig.room->setTable(TableLoad::kEmpty);
  auto picture = rig.camera->grabAfter(steadySeconds(), task);
  if (rig.room) rig.room->setTable(TableLoad::kObject);
  if (!picture) return picture.error();
  return EmptyTable{*std::move(picture), rig.turntable->place()};
}

Result<bool> keepEmptyTable(const EmptyTable& empty_table, const Turntable& turntable,
                            ScanStore& store) {
  const auto angle_rad = turntable.angleAt(empty_table.place);
  if (!angle_rad) return false;
  Frame frame = *empty_table.picture;
  frame.table_angle_rad = *angle_rad;
  if (const auto kept = store.addEmptyTable(frame); !kept) return kept.error();
  return true;
}

Result<void> takeEmptyTable(const Rig& rig, ScanStore& store, const Task& task) {
  if (!rig.room || rig.room->camera == nullptr) return {};
  if (!store.readEmptyTable()) {
    const auto taken = pictureOfEmptyTable(rig, task);
    if (!taken) return taken.error();
    if (const auto kept = keepEmptyTable(*taken, *rig.turntable, store); !kept) return kept.error();
  }
  rig.room->setTable(TableLoad::kObject);
  return {};
}

Result<void> keepEmptyTable(const std::filesystem::path& file_or_folder, ScanStore& store) {
  const auto read = readEmptyTable(file_or_folder);
  if (!read) return read.error();
  const Frame& frame = **read;
  if (auto fits =
          checkCalibratedSize({frame.image_bgr.cols, frame.image_bgr.rows},
                              store.calibration().camera, "The picture of the empty table has");
      !fits) {
    return fits;
  }
  return store.addEmptyTable(frame);
}

}  // namespace gyre
