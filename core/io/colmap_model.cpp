// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "core/io/atomic_file.h"
#include "core/io/camera_export.h"
#include "core/io/json_text.h"
#include "core/io/posed_pictures.h"

namespace gyre {
namespace {

constexpr const char* kUnknownError = "-1";

// Where a point of the cloud was seen, in the place that images.txt gives it.
struct TrackElement {
  std::size_t image = 0;  // from 0
  std::size_t place = 0;  // among the image's own points, from 0
};

// The sightings picture by picture, and where each ended up.
struct Tracks {
  std::vector<std::string> points_of_image;         // "x y id x y id"
  std::vector<std::vector<TrackElement>> of_point;  // as in points3D.txt
};

std::string listText(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + jsonNumber(number);
  return text;
}

std::string cameraText(const CameraModel& camera) {
  const bool full = camera.k3 != 0.0;
  std::string text = (full ? "FULL_OPENCV " : "OPENCV ") + std::to_string(camera.width_px) + " " +
                     std::to_string(camera.height_px) + " ";
  text += listText({camera.fx, camera.fy, camera.cx + kPixelCentre, camera.cy + kPixelCentre,
                    camera.k1, camera.k2, camera.p1, camera.p2});
  if (full) text += " " + listText({camera.k3, 0.0, 0.0, 0.0});
  return text + "\n";
}

std::string camerasText(const std::vector<CameraModel>& cameras) {
  std::string text =
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n# Number of cameras: " +
      std::to_string(cameras.size()) + "\n";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    text += std::to_string(i + 1) + " " + cameraText(cameras[i]);
  }
  return text;
}

Tracks tracksOf(const PosedPictures& posed) {
  Tracks tracks;
  tracks.points_of_image.resize(posed.pictures.size());
  tracks.of_point.resize(posed.cloud.points.size());
  std::vector<std::size_t> used(posed.pictures.size(), 0);
  for (std::size_t point = 0; point < posed.sightings.size(); ++point) {
    for (const Observation& seen : posed.sightings[point]) {
      const auto image = static_cast<std::size_t>(seen.view);
      if (image >= posed.pictures.size()) continue;
      std::string& line = tracks.points_of_image[image];
      if (!line.empty()) line += ' ';
      line += listText({seen.pixel.x() + kPixelCentre, seen.pixel.y() + kPixelCentre}) + " " +
              std::to_string(point + 1);
      tracks.of_point[point].push_back({image, used[image]++});
    }
  }
  return tracks;
}

std::string imagesText(const PosedPictures& posed, const Tracks& tracks) {
  std::string text =
      "# Image list with two lines of data per image:\n"
      "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "#   POINTS2D[] as (X, Y, POINT3D_ID)\n# Number of images: " +
      std::to_string(posed.pictures.size()) + "\n";
  for (std::size_t i = 0; i < posed.pictures.size(); ++i) {
    const Rigid3& pose = posed.pictures[i].cam_from_table;
    Eigen::Quaterniond turn(pose.rotation);
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    text += std::to_string(i + 1) + " " + listText({turn.w(), turn.x(), turn.y(), turn.z()}) + " " +
            listText({pose.translation.x(), pose.translation.y(), pose.translation.z()}) + " " +
            std::to_string(posed.pictures[i].camera + 1) + " " + posed.pictures[i].name + "\n" +
            tracks.points_of_image[i] + "\n";
  }
  return text;
}

// Mean distance of the sightings from where the point is seen; "-1" when nobody kept them.
std::string errorText(const PosedPictures& posed, std::size_t point) {
  if (posed.sightings.empty()) return kUnknownError;
  double sum_px = 0.0;
  std::size_t count = 0;
  for (const Observation& seen : posed.sightings[point]) {
    const auto image = static_cast<std::size_t>(seen.view);
    if (image >= posed.pictures.size()) continue;
    const PosedPicture& picture = posed.pictures[image];
    const auto pixel = posed.cameras[picture.camera].project(picture.cam_from_table *
                                                             posed.cloud.points[point].position);
    if (!pixel) continue;
    sum_px += (*pixel - seen.pixel).norm();
    ++count;
  }
  return count > 0 ? jsonNumber(sum_px / static_cast<double>(count)) : kUnknownError;
}

std::string pointsText(const PosedPictures& posed, const Tracks& tracks) {
  std::string text =
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
      "# Number of points: " +
      std::to_string(posed.cloud.points.size()) + "\n";
  for (std::size_t i = 0; i < posed.cloud.points.size(); ++i) {
    const Point& point = posed.cloud.points[i];
    text += std::to_string(i + 1) + " " +
            listText({point.position.x(), point.position.y(), point.position.z()});
    for (const std::uint8_t channel : point.rgb) text += " " + std::to_string(channel);
    text += " " + errorText(posed, i);
    for (const TrackElement& each : tracks.of_point[i]) {
      text += " " + std::to_string(each.image + 1) + " " + std::to_string(each.place);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

Result<void> writeColmapModel(const std::filesystem::path& folder, const PosedPictures& posed) {
  for (const CameraModel& camera : posed.cameras) {
    if (const auto fits = checkSkew(camera); !fits) return fits;
  }
  for (const PosedPicture& picture : posed.pictures) {
    if (picture.name.find_first_of(" \t\n\r") != std::string::npos) {
      return Error{Error::Code::kInvalidInput,
                   "The picture \"" + picture.name +
                       "\" has a blank in its name, which a COLMAP text model cannot hold.",
                   "Rename the pictures and reconstruct again, or export to transforms."};
    }
  }
  const Tracks tracks = tracksOf(posed);
  if (auto done = writeFileAtomically(folder / "cameras.txt", camerasText(posed.cameras)); !done) {
    return done;
  }
  if (auto done = writeFileAtomically(folder / "images.txt", imagesText(posed, tracks)); !done) {
    return done;
  }
  return writeFileAtomically(folder / "points3D.txt", pointsText(posed, tracks));
}

}  // namespace gyre
