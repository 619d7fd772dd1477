// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/fingerprint.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

// FIPS 180-2, appendix B.1 and B.3.
TEST(Fingerprint, IsThePublishedOne) {
  const TempDir dir;
  EXPECT_EQ(*fingerprintOf(putFile(dir / "a", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(*fingerprintOf(putFile(dir / "b", std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// printf abc > a; printf '' > "b 2"; sha256sum a "b 2" | sha256sum
TEST(Fingerprint, OfManyIsThatOfTheirList) {
  const TempDir dir;
  const std::vector<std::filesystem::path> files = {putFile(dir / "a", "abc"),
                                                    putFile(dir / "b 2", "")};
  EXPECT_EQ(*fingerprintOf(files, {}),
            "81a7ac822467e939c2a67904befb030882ed76bd19064f8d00dfb3cdd6afd0bc");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(fingerprintOf(files, Task(stop.get_token())).error().code, Error::Code::kCancelled);
}

TEST(Fingerprint, SaysWhichFileIsMissing) {
  const TempDir dir;
  const std::vector<std::filesystem::path> files = {putFile(dir / "a", "abc"), dir / "gone"};
  EXPECT_EQ(fingerprintOf(files, {}).error().code, Error::Code::kNotFound);
  EXPECT_NE(fingerprintOf(files, {}).error().what.find("gone"), std::string::npos);
  EXPECT_FALSE(fingerprintOf(dir.path()));
}

}  // namespace
}  // namespace gyre
