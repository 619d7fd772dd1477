// Archives are judged by the programs that people open them with.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/archive_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::ElementsAre;
using testing::Pair;

// Name and content of every entry, read back by the library's own reader.
std::map<std::string, std::string> entriesOf(const std::filesystem::path& file) {
  setlocale(LC_CTYPE, "C.UTF-8");
  std::map<std::string, std::string> entries;
  archive* pack = archive_read_new();
  archive_read_support_format_all(pack);
  archive_read_support_filter_all(pack);
  EXPECT_EQ(archive_read_open_filename(pack, file.c_str(), 4096), ARCHIVE_OK);
  archive_entry* entry = nullptr;
  while (archive_read_next_header(pack, &entry) == ARCHIVE_OK) {
    const char* name = archive_entry_pathname_utf8(entry);
    EXPECT_NE(name, nullptr);
    std::string& bytes = entries[name != nullptr ? name : "(none)"];
    char buffer[1000];
    la_ssize_t count = 0;
    while ((count = archive_read_data(pack, buffer, sizeof(buffer))) > 0) {
      bytes.append(buffer, static_cast<std::size_t>(count));
    }
  }
  archive_read_free(pack);
  setlocale(LC_CTYPE, "C");
  return entries;
}

TEST(ArchiveFile, PacksTextAndFilesInBothForms) {
  const TempDir folder;
  const std::string large(100000, 'x');
  const auto file = putFile(folder / "large", large);
  for (const char* name : {"a.tar.gz", "a.tgz", "a.zip"}) {
    auto archive = ArchiveFile::create(folder / name);
    ASSERT_TRUE(archive) << archive.error().sentence();
    EXPECT_TRUE(archive->add("scan/Stra\u00dfe.json", "{}"));
    EXPECT_TRUE(archive->addFile("scan/large", file));
    EXPECT_TRUE(archive->add("scan/empty", ""));
    EXPECT_FALSE(std::filesystem::exists(folder / name));
    ASSERT_TRUE(archive->finish());
    EXPECT_THAT(entriesOf(folder / name),
                ElementsAre(Pair("scan/Stra\u00dfe.json", "{}"), Pair("scan/empty", ""),
                            Pair("scan/large", large)));
  }
}

TEST(ArchiveFile, UnfinishedArchiveLeavesNothingAndHarmsNothing) {
  const TempDir folder;
  putFile(folder / "old.zip", "old");
  {
    auto archive = ArchiveFile::create(folder / "old.zip");
    ASSERT_TRUE(archive);
    EXPECT_TRUE(archive->add("a", "b"));
    EXPECT_FALSE(archive->addFile("c", folder / "none"));
  }
  EXPECT_EQ(fileText(folder / "old.zip"), "old");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(names, ElementsAre("old.zip"));
}

TEST(ArchiveFile, OtherEndingsAndFoldersThatAreMissingAreTold) {
  const TempDir folder;
  const auto rar = ArchiveFile::create(folder / "a.rar");
  ASSERT_FALSE(rar);
  EXPECT_EQ(rar.error().code, Error::Code::kInvalidInput);
  EXPECT_FALSE(ArchiveFile::create(folder / "none/a.zip"));
}

}  // namespace
}  // namespace gyre
