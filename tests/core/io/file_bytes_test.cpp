// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/file_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::HasSubstr;

TEST(ReadFileBytes, GivesEveryByteUnderAnyName) {
  const TempDir dir;
  const std::string bytes("a\0b\r\n\xFF", 6);
  EXPECT_EQ(*readFileBytes(putFile(dir / "Größe 猫.bin", bytes), 100), bytes);
  EXPECT_EQ(*readFileBytes(putFile(dir / "empty", ""), 100), "");
}

TEST(ReadFileBytes, NamesTheFileThatIsNotThere) {
  const TempDir dir;
  const auto read = readFileBytes(dir / "none.json", 100);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Error::Code::kNotFound);
  EXPECT_THAT(read.error().what, HasSubstr("none.json"));
}

TEST(ReadFileBytes, RefusesFoldersPipesAndFilesThatAreTooLarge) {
  const TempDir dir;
  EXPECT_EQ(readFileBytes(dir.path(), 100).error().code, Error::Code::kInvalidInput);
  ASSERT_EQ(::mkfifo((dir / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(readFileBytes(dir / "pipe", 100).error().code, Error::Code::kInvalidInput);
  EXPECT_EQ(readFileBytes(putFile(dir / "large", "12345"), 4).error().code,
            Error::Code::kInvalidInput);
}

TEST(FileError, TellsAFullDiskFromAForbiddenOne) {
  EXPECT_EQ(fileError(ENOSPC, "write", "x").code, Error::Code::kNoSpace);
  EXPECT_EQ(fileError(EROFS, "write", "x").code, Error::Code::kNoPermission);
  EXPECT_EQ(fileError(EACCES, "write", "x").code, Error::Code::kNoPermission);
  EXPECT_EQ(fileError(EIO, "write", "x").code, Error::Code::kIo);
}

}  // namespace
}  // namespace gyre
