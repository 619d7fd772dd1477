// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/empty_table_file.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "core/base/units.h"
#include "core/io/angles_file.h"
#include "core/io/frame_folder.h"
#include "core/io/picture_file.h"

namespace gyre {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPicture = "empty.png";
constexpr const char* kAngles = "angles.csv";
constexpr std::size_t kMostPictures = 16;
// A platter that turned by less looks the same in a picture of its texture.
constexpr double kSameAngle_rad = radFromDeg(0.01);

struct EmptyTableFiles {
  std::vector<fs::path> pictures;  // all at the same angle
  double table_angle_rad = 0.0;
};

// The first picture, and those that were taken at its angle.
Result<void> keepSameAngle(const fs::path& angles_file, EmptyTableFiles& files) {
  const auto angles = readAngles(angles_file);
  if (!angles) return angles.error();
  std::vector<fs::path> kept;
  for (const fs::path& picture : files.pictures) {
    const auto line = angles->find(picture.filename().string());
    if (line == angles->end()) {
      return Error{Error::Code::kInvalidInput,
                   "\"" + angles_file.string() + "\" has no angle for the picture \"" +
                       picture.filename().string() + "\" of the empty table.",
                   "Add the picture's line, or take the picture out of the folder."};
    }
    if (kept.empty()) files.table_angle_rad = line->second;
    if (std::abs(line->second - files.table_angle_rad) <= kSameAngle_rad) kept.push_back(picture);
  }
  files.pictures = std::move(kept);
  return {};
}

Result<EmptyTableFiles> filesOf(const fs::path& file_or_folder) {
  EmptyTableFiles files;
  std::error_code ignored;
  if (!fs::is_directory(file_or_folder, ignored)) {
    files.pictures = {file_or_folder};
    return files;
  }
  auto listed = listPictures(file_or_folder);
  if (!listed) return listed.error();
  files.pictures = std::move(*listed);
  if (fs::exists(file_or_folder / kAngles, ignored)) {
    if (auto kept = keepSameAngle(file_or_folder / kAngles, files); !kept) return kept.error();
  }
  files.pictures.resize(std::min(files.pictures.size(), kMostPictures));
  return files;
}

}  // namespace

Result<void> writeEmptyTable(const fs::path& folder, const Frame& frame) {
  if (auto done = writeAngles(folder / kAngles, {{kPicture, frame.table_angle_rad}}); !done) {
    return done;
  }
  return writePicture(folder / kPicture, frame.image_bgr);
}

Result<FramePtr> readEmptyTable(const fs::path& file_or_folder) {
  const auto files = filesOf(file_or_folder);
  if (!files) return files.error();
  cv::Mat sum;
  for (const fs::path& file : files->pictures) {
    const auto frame = readPicture(file);
    if (!frame) return frame.error();
    if (!sum.empty() && frame->image_bgr.size() != sum.size()) {
      return Error{Error::Code::kInvalidInput, "The pictures of the bare table differ in size.",
                   "Take them all with the same camera settings."};
    }
    if (sum.empty()) sum = cv::Mat::zeros(frame->image_bgr.size(), CV_32FC3);
    cv::add(sum, frame->image_bgr, sum, cv::noArray(), CV_32F);
  }
  auto mean = std::make_shared<Frame>();
  mean->name = files->pictures.front().filename().string();
  mean->table_angle_rad = files->table_angle_rad;
  sum.convertTo(mean->image_bgr, CV_8U, 1.0 / static_cast<double>(files->pictures.size()));
  return FramePtr(std::move(mean));
}

}  // namespace gyre
