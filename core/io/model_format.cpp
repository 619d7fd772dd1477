// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/model_format.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace gyre {

std::optional<ModelFormat> modelFormatOf(const std::filesystem::path& file) {
  static constexpr std::pair<std::string_view, ModelFormat> kEndings[] = {
      {".ply", ModelFormat::kPly},
      {".obj", ModelFormat::kObj},
      {".stl", ModelFormat::kStl},
      {".3mf", ModelFormat::kThreeMf},
      {".glb", ModelFormat::kGlb}};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const auto& [known, format] : kEndings) {
    if (known == ending) return format;
  }
  return std::nullopt;
}

}  // namespace gyre
