// Reads and writes angles.csv: at which table angle each picture was taken.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/natural_order.h"

namespace gyre {

// Picture's file name -> table angle [rad], positive counter-clockwise seen from above.
using AngleTable = std::map<std::string, double, NaturalOrder>;

// The same in the order of the file's lines.
struct PictureAngle {
  std::string picture;
  double angle_rad = 0.0;
};
using AngleList = std::vector<PictureAngle>;

// Fails on a wrong header, a line that is not a name and a number, and a name that comes twice.
Result<AngleTable> readAngles(const std::filesystem::path& file);

// The same from the file's text. file: what the sentences call it.
Result<AngleTable> parseAngles(std::string_view text, const std::string& file);

// The same, line by line: where lines are numbered like views, as in angles_solved.csv.
Result<AngleList> readAngleList(const std::filesystem::path& file);
Result<AngleList> parseAngleList(std::string_view text, const std::string& file);

// Replaces the file atomically; the lines are in natural order, the angles in degrees.
Result<void> writeAngles(const std::filesystem::path& file, const AngleTable& angles);

// The same in the list's order.
Result<void> writeAngleList(const std::filesystem::path& file, const AngleList& angles);

// The angle of each picture [rad], in the pictures' order. Fails when a picture has no line, and
// when all angles are the same: then nothing has turned.
Result<std::vector<double>> anglesOfPictures(std::span<const std::filesystem::path> pictures,
                                             const AngleTable& angles);

}  // namespace gyre
