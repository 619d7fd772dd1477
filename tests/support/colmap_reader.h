// Reads COLMAP's text model by its documentation, with nothing of ours: for tests of what we write.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace gyre::test {

struct ColmapImage {
  cv::Matx33d rotation;  // from the world to the camera
  cv::Vec3d translation;
  int camera = 0;
  std::string name;
  std::vector<std::pair<cv::Point2d, long>> points;  // pixel from the corner; the point, or -1
};

struct ColmapPoint {
  cv::Point3d position;
  cv::Vec3i rgb;
  double error = 0.0;
  std::vector<std::pair<int, std::size_t>> track;  // image, index of its point
};

struct ColmapCamera {
  std::string model;
  int width = 0;
  int height = 0;
  std::vector<double> parameters;
};

struct ColmapModel {
  std::map<int, ColmapCamera> cameras;
  std::map<int, ColmapImage> images;
  std::map<long, ColmapPoint> points;
};

inline std::vector<std::string> dataLines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("no " + file.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] != '#') lines.push_back(line);
  }
  return lines;
}

inline cv::Matx33d rotationOf(double w, double x, double y, double z) {
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
          2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

inline ColmapModel readColmap(const std::filesystem::path& folder) {
  ColmapModel model;
  for (const std::string& line : dataLines(folder / "cameras.txt")) {
    std::istringstream words(line);
    int id = 0;
    ColmapCamera camera;
    words >> id >> camera.model >> camera.width >> camera.height;
    for (double value = 0.0; words >> value;) camera.parameters.push_back(value);
    model.cameras[id] = camera;
  }
  const std::vector<std::string> lines = dataLines(folder / "images.txt");
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    std::istringstream head(lines[i]);
    int id = 0;
    cv::Vec4d q;
    ColmapImage image;
    head >> id >> q[0] >> q[1] >> q[2] >> q[3] >> image.translation[0] >> image.translation[1] >>
        image.translation[2] >> image.camera >> image.name;
    image.rotation = rotationOf(q[0], q[1], q[2], q[3]);
    std::istringstream seen(lines[i + 1]);
    cv::Point2d pixel;
    for (long point = 0; seen >> pixel.x >> pixel.y >> point;)
      image.points.emplace_back(pixel, point);
    model.images[id] = image;
  }
  for (const std::string& line : dataLines(folder / "points3D.txt")) {
    std::istringstream words(line);
    long id = 0;
    ColmapPoint point;
    words >> id >> point.position.x >> point.position.y >> point.position.z >> point.rgb[0] >>
        point.rgb[1] >> point.rgb[2] >> point.error;
    int image = 0;
    for (std::size_t at = 0; words >> image >> at;) point.track.emplace_back(image, at);
    model.points[id] = point;
  }
  return model;
}

// Where the camera sees the place, in pixels from the picture's corner.
inline cv::Point2d projected(const ColmapCamera& camera, const ColmapImage& image,
                             const cv::Point3d& place) {
  const std::vector<double>& p = camera.parameters;
  const cv::Matx33d matrix(p[0], 0, p[2], 0, p[1], p[3], 0, 0, 1);
  const std::vector<double> lens(p.begin() + 4, p.end());
  cv::Vec3d turn;
  cv::Rodrigues(image.rotation, turn);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{place}, turn, image.translation, matrix, lens, pixels);
  return pixels.front();
}

}  // namespace gyre::test
