// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/frame_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/picture_file.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

void putPicture(const std::filesystem::path& file, int width_px, int height_px) {
  ASSERT_TRUE(writePicture(file, cv::Mat(height_px, width_px, CV_8UC3, cv::Scalar(1, 2, 3))));
}

TEST(ListPictures, ListsPicturesInNaturalOrderAndNothingElse) {
  const TempDir dir;
  for (const std::string name : {"v101.png", "v1.JPG", "v3.jpeg", "v20.tif", "v21.bmp"}) {
    putFile(dir / name, "");
  }
  for (const std::string name : {"angles.csv", ".hidden.png", "v2.gif"}) putFile(dir / name, "");
  std::filesystem::create_directory(dir / "folder.png");
  const auto pictures = listPictures(dir.path());
  ASSERT_TRUE(pictures) << pictures.error().sentence();
  std::vector<std::string> names;
  for (const auto& picture : *pictures) names.push_back(picture.filename().string());
  EXPECT_THAT(names, testing::ElementsAre("v1.JPG", "v3.jpeg", "v20.tif", "v21.bmp", "v101.png"));
}

TEST(ListPictures, TellsAMissingFolderFromAnEmptyOne) {
  const TempDir dir;
  const auto missing = listPictures(dir / "nowhere");
  EXPECT_EQ(missing.error().code, Error::Code::kNotFound);
  EXPECT_THAT(missing.error().what, HasSubstr("nowhere"));
  EXPECT_THAT(listPictures(dir.path()).error().what, HasSubstr("no pictures"));
  EXPECT_FALSE(listPictures(putFile(dir / "file", "")));
}

TEST(CommonSize, IsTheSizeOfAllPictures) {
  const TempDir dir;
  putPicture(dir / "1.png", 64, 48);
  putPicture(dir / "2.png", 64, 48);
  const auto size = commonSize(*listPictures(dir.path()));
  ASSERT_TRUE(size) << size.error().sentence();
  EXPECT_EQ(size->width_px, 64);
  EXPECT_EQ(size->height_px, 48);
}

TEST(CommonSize, NamesThePictureThatDiffersOrIsCut) {
  const TempDir dir;
  putPicture(dir / "1.png", 64, 48);
  putPicture(dir / "2.png", 48, 64);
  const auto mixed = commonSize(*listPictures(dir.path()));
  ASSERT_FALSE(mixed);
  EXPECT_THAT(mixed.error().what, HasSubstr("\"2.png\" has 48 x 64"));
  const std::string whole = fileText(dir / "1.png");
  putFile(dir / "2.png", whole.substr(0, whole.size() - 1));
  EXPECT_THAT(commonSize(*listPictures(dir.path())).error().what, HasSubstr("cut off"));
}

TEST(MaskFor, HasThePicturesStem) {
  EXPECT_EQ(maskFor("a/view.1.jpg", "masks"), std::filesystem::path("masks/view.1.png"));
}

}  // namespace
}  // namespace gyre
