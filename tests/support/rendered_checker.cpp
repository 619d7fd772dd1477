// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/rendered_checker.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"

namespace gyre {
namespace {

constexpr int kFiner = 8;

// pixel -> board, in the plane of the board.
class ToBoard {
 public:
  explicit ToBoard(const Eigen::Matrix3d& pixel_from_board)
      : board_from_pixel_(pixel_from_board.inverse()) {}

  Eigen::Vector2d operator()(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d on_board = board_from_pixel_ * pixel.homogeneous();
    return on_board.hnormalized();
  }

 private:
  Eigen::Matrix3d board_from_pixel_;
};

bool evenSquare(const Eigen::Vector2d& place) {
  const auto sum = static_cast<long>(std::floor(place.x())) + std::lround(std::floor(place.y()));
  return sum % 2 == 0;
}

}  // namespace

cv::Mat renderPattern(const CheckerPicture& picture, const Pattern& is_bright) {
  cv::Mat fine(picture.height_px * kFiner, picture.width_px * kFiner, CV_32F);
  for (int row = 0; row < fine.rows; ++row) {
    float* line = fine.ptr<float>(row);
    for (int column = 0; column < fine.cols; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / kFiner - 0.5, (row + 0.5) / kFiner - 0.5);
      line[column] = static_cast<float>(is_bright(pixel) ? picture.bright : picture.dark);
    }
  }
  if (picture.psf_px > 0.0) cv::GaussianBlur(fine, fine, {0, 0}, picture.psf_px * kFiner);
  cv::Mat coarse;
  cv::resize(fine, coarse, {picture.width_px, picture.height_px}, 0, 0, cv::INTER_AREA);
  cv::Mat grey(coarse.size(), CV_8U);
  Random random(picture.seed);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      const double value = coarse.at<float>(row, column) + picture.noise * random.gaussian();
      grey.at<std::uint8_t>(row, column) = cv::saturate_cast<std::uint8_t>(value);
    }
  }
  return grey;
}

Pattern checkerPattern(const Eigen::Matrix3d& pixel_from_board) {
  return [to_board = ToBoard(pixel_from_board)](const Eigen::Vector2d& pixel) {
    return evenSquare(to_board(pixel));
  };
}

Pattern boardPattern(const Eigen::Matrix3d& pixel_from_board, int columns, int rows) {
  return [=, to_board = ToBoard(pixel_from_board)](const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d place = to_board(pixel);
    const bool on_board =
        place.x() >= 0.0 && place.y() >= 0.0 && place.x() < columns && place.y() < rows;
    return !on_board || !evenSquare(place);
  };
}

Pattern quarterPattern(const Eigen::Matrix3d& pixel_from_board) {
  return [to_board = ToBoard(pixel_from_board)](const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d place = to_board(pixel);
    return place.x() < 0.0 || place.y() < 0.0;
  };
}

}  // namespace gyre
