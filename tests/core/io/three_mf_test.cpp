// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/three_mf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <map>
#include <vector>

#include <Model/COM/NMR_DLLInterfaces.h>

#include "core/io/standing_mesh.h"
#include "tests/support/comma_locale.h"
#include "tests/support/foreign_model.h"
#include "tests/support/model_samples.h"
#include "tests/support/temp_dir.h"

namespace gyre {
namespace {

using testing::Contains;
using testing::Pair;

constexpr double kStep_mm = 2e-6;  // six digits after the point, of a float below 32 mm

// What lib3mf's reader finds in a file; it is told apart from the writer by the file alone.
struct Read {
  unsigned int unit = 99;
  std::vector<NMR::MODELMESHVERTEX> vertices;
  std::vector<NMR::MODELMESHTRIANGLE> triangles;
  std::vector<NMR::MODELMESH_TRIANGLECOLOR_SRGB> colours;
  NMR::MODELTRANSFORM place{};
  std::map<std::string, std::string> texts;
};

void readTexts(NMR::PLib3MFBase* model, Read& read) {
  unsigned int count = 0;
  NMR::lib3mf_model_getmetadatacount(model, &count);
  for (unsigned int i = 0; i < count; ++i) {
    std::array<char, 256> name{};
    std::array<char, 256> text{};
    unsigned int needed = 0;
    NMR::lib3mf_model_getmetadatakeyutf8(model, i, name.data(), name.size(), &needed);
    NMR::lib3mf_model_getmetadatavalueutf8(model, i, text.data(), text.size(), &needed);
    read.texts[name.data()] = text.data();
  }
}

void readSurface(NMR::PLib3MFBase* object, Read& read) {
  unsigned int count = 0;
  NMR::lib3mf_meshobject_getvertexcount(object, &count);
  read.vertices.resize(count);
  NMR::lib3mf_meshobject_getvertices(object, read.vertices.data(), count, nullptr);
  NMR::lib3mf_meshobject_gettrianglecount(object, &count);
  read.triangles.resize(count);
  NMR::lib3mf_meshobject_gettriangleindices(object, read.triangles.data(), count, nullptr);
  read.colours.resize(count);
  NMR::PLib3MFBase* colours = nullptr;
  NMR::lib3mf_meshobject_createpropertyhandler(object, &colours);
  NMR::lib3mf_propertyhandler_getcolorarray(colours, read.colours.data());
  NMR::lib3mf_release(colours);
}

Read readByLib3mf(const std::filesystem::path& file) {
  Read read;
  NMR::PLib3MFBase* model = nullptr;
  NMR::PLib3MFBase* reader = nullptr;
  NMR::PLib3MFBase* items = nullptr;
  NMR::lib3mf_createmodel(&model);
  NMR::lib3mf_model_queryreader(model, "3mf", &reader);
  EXPECT_EQ(NMR::lib3mf_reader_readfromfileutf8(reader, file.c_str()), 0U);
  NMR::lib3mf_model_getunit(model, &read.unit);
  NMR::lib3mf_model_getbuilditems(model, &items);
  int has_next = 0;
  while (NMR::lib3mf_builditemiterator_movenext(items, &has_next) == 0 && has_next != 0) {
    NMR::PLib3MFBase* item = nullptr;
    NMR::PLib3MFBase* object = nullptr;
    NMR::lib3mf_builditemiterator_getcurrent(items, &item);
    NMR::lib3mf_builditem_getobjecttransform(item, &read.place);
    NMR::lib3mf_builditem_getobjectresource(item, &object);
    readSurface(object, read);
    NMR::lib3mf_release(object);
    NMR::lib3mf_release(item);
  }
  readTexts(model, read);
  for (NMR::PLib3MFBase* held : {items, reader, model}) NMR::lib3mf_release(held);
  return read;
}

Eigen::Vector3d positionOf(const NMR::MODELMESHVERTEX& vertex) {
  return {vertex.m_fPosition[0], vertex.m_fPosition[1], vertex.m_fPosition[2]};
}

void expectEgg(const Read& read) {
  const auto standing = standingMesh(test::hoveringEgg());
  ASSERT_EQ(read.triangles.size(), standing->triangles.size());
  Bounds bounds;
  for (const auto& vertex : read.vertices) bounds.include(positionOf(vertex));
  EXPECT_EQ(bounds.min.z(), 0.0);
  EXPECT_LT((bounds.max - boundsOf(*standing).max).norm(), kStep_mm);
  EXPECT_LT((bounds.min - boundsOf(*standing).min).norm(), kStep_mm);
  for (std::size_t i = 0; i < read.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& vertex = standing->vertices[standing->triangles[i][k]];
      const auto& position = read.vertices[read.triangles[i].m_nIndices[k]];
      EXPECT_LT((positionOf(position) - vertex.position).norm(), kStep_mm);
      const auto& colour = read.colours[i].m_Colors[k];
      EXPECT_EQ((Rgb{colour.m_Red, colour.m_Green, colour.m_Blue}), vertex.rgb);
    }
  }
}

TEST(WriteThreeMf, IsReadInMillimetresStandingOnTheBedWithItsColours) {
  const TempDir dir;
  ASSERT_TRUE(writeThreeMf(dir / "Ei ä.3mf", test::hoveringEgg()));
  const Read read = readByLib3mf(dir / "Ei ä.3mf");
  EXPECT_EQ(read.unit, static_cast<unsigned int>(NMR::MODELUNIT_MILLIMETER));
  expectEgg(read);
}

TEST(WriteThreeMf, PlacesTheObjectAtTheFrontLeftCornerOfTheBed) {
  const TempDir dir;
  ASSERT_TRUE(writeThreeMf(dir / "a.3mf", test::hoveringEgg()));
  const Read read = readByLib3mf(dir / "a.3mf");
  const Bounds bounds = boundsOf(*standingMesh(test::hoveringEgg()));
  for (int axis = 0; axis < 2; ++axis) {
    const double least = bounds.min[axis] + static_cast<double>(read.place.m_fFields[axis][3]);
    EXPECT_GE(least, 0.0);
    EXPECT_LT(least, 1.0);
    EXPECT_EQ(read.place.m_fFields[axis][axis], 1.0F);
  }
  EXPECT_EQ(read.place.m_fFields[2][3], 0.0F);
}

TEST(WriteThreeMf, CarriesTitleNumberAndRights) {
  const TempDir dir;
  const ModelLabel label = {"Ente \"ä\" & <so>", "MK 12", "© Museum"};
  ASSERT_TRUE(writeThreeMf(dir / "a.3mf", sampleMesh(), label));
  const Read read = readByLib3mf(dir / "a.3mf");
  // lib3mf's reader leaves the characters of XML spelled out.
  EXPECT_THAT(read.texts, Contains(Pair("Title", "Ente &quot;ä&quot; &amp; &lt;so&gt;")));
  EXPECT_THAT(read.texts, Contains(Pair("Copyright", label.rights)));
  EXPECT_THAT(read.texts, Contains(Pair("Description", "Inventory number: MK 12")));
  ASSERT_TRUE(writeThreeMf(dir / "b.3mf", sampleMesh()));
  EXPECT_EQ(readByLib3mf(dir / "b.3mf").texts.count("Title"), 0U);
}

TEST(WriteThreeMf, WritesPointsInACountryOfCommas) {
  const test::CommaLocale comma;
  if (!comma.made()) GTEST_SKIP() << "localedef cannot make de_DE here";
  const TempDir dir;
  ASSERT_NE(std::setlocale(LC_ALL, ""), nullptr);
  const auto written = writeThreeMf(dir / "a.3mf", test::hoveringEgg());
  std::setlocale(LC_ALL, "C");
  ASSERT_TRUE(written) << written.error().sentence();
  expectEgg(readByLib3mf(dir / "a.3mf"));
}

TEST(WriteThreeMf, SaysWhyItCannot) {
  EXPECT_EQ(writeThreeMf("/nowhere/a.3mf", sampleMesh()).error().code, Error::Code::kNotFound);
  EXPECT_EQ(writeThreeMf("/nowhere/a.3mf", Mesh{}).error().code, Error::Code::kInvalidInput);
}

}  // namespace
}  // namespace gyre
