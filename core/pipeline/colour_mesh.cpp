// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/colour_mesh.h"

#include <string>
#include <utility>

#include "core/io/picture_file.h"
#include "core/mesh/vertex_colours.h"
#include "core/pipeline/result_views.h"

namespace gyre {

Result<std::size_t> colourFromPictures(Mesh& mesh, const std::filesystem::path& folder,
                                       const PictureFinder& pictures, const Task& task) {
  const auto views = readResultViews(folder);
  if (!views) return views.error();
  const auto picture_of = [&](std::size_t view) -> Result<cv::Mat> {
    const std::string& name = (*views)[view].picture;
    const std::filesystem::path file = pictures.find(name);
    if (file.empty()) {
      return Error{Error::Code::kNotFound,
                   "The picture \"" + name + "\" that the result was made from is missing.",
                   "Name the folder of the pictures with --pictures."};
    }
    auto frame = readPicture(file);
    if (!frame) return frame.error();
    return std::move(frame->image_bgr);
  };
  return colourVertices(mesh, camerasOf(*views), picture_of, task);
}

}  // namespace gyre
