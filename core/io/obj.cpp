// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "core/io/atomic_file.h"

namespace gyre {
namespace {

// The shortest text from which the number is read again as a float: 0.1 µm at any size we measure.
void appendNumber(std::string& text, double number) {
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(number)).ptr;
  text.append(digits.data(), end);
}

void appendRow(std::string& text, std::string_view word, const Eigen::Vector3d& row) {
  text.append(word);
  for (int i = 0; i < 3; ++i) appendNumber(text.append(" "), row[i]);
}

}  // namespace

std::string objText(const Mesh& mesh) {
  std::string text = "# Gyre: millimetres, z up along the turntable's axis\n";
  const bool normals =
      std::none_of(mesh.vertices.begin(), mesh.vertices.end(),
                   [](const MeshVertex& vertex) { return vertex.normal.isZero(0.0); });
  for (const MeshVertex& vertex : mesh.vertices) {
    appendRow(text, "v", vertex.position);
    for (const std::uint8_t channel : vertex.rgb) {
      // Four digits: enough to come back to the same of 256 levels.
      const int ten_thousandths = (channel * 10000 + 127) / 255;
      appendNumber(text.append(" "), ten_thousandths / 10000.0);
    }
    text.append("\n");
  }
  for (const MeshVertex& vertex : mesh.vertices) {
    if (!normals) break;
    appendRow(text, "vn", vertex.normal);
    text.append("\n");
  }
  for (const Triangle& triangle : mesh.triangles) {
    text.append("f");
    for (const std::uint32_t corner : triangle) {
      const std::string number = std::to_string(std::uint64_t{corner} + 1);
      text.append(" ").append(number);
      if (normals) text.append("//").append(number);
    }
    text.append("\n");
  }
  return text;
}

Result<void> writeObj(const std::filesystem::path& file, const Mesh& mesh) {
  return writeFileAtomically(file, objText(mesh));
}

}  // namespace gyre
