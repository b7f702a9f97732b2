// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "experiments/base/error.h"
#include "tests/full_disk.h"

namespace limen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ImageFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "limen_image_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Values count up from 0 in steps of 1/255, channel by channel, pixel by pixel.
  void save(const std::string& name, const OIIO::ImageSpec& spec) const {
    std::vector<float> values(static_cast<size_t>(spec.width) * spec.height * spec.nchannels);
    for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) / 255.0F;
    const auto out = OIIO::ImageOutput::create(path(name));
    ASSERT_TRUE(out && out->open(path(name), spec)) << OIIO::geterror();
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    ASSERT_TRUE(out->close());
  }

  std::filesystem::path folder_;
};

TEST_F(ImageFileTest, TellsWhatTheFileHolds) {
  save("a.png", {5, 4, 3, OIIO::TypeDesc::UINT8});
  save("a.tif", {5, 4, 1, OIIO::TypeDesc::UINT16});
  save("a.exr", {5, 4, 3, OIIO::TypeDesc::HALF});
  const ImageFile png = readImageFile(path("a.png")), tif = readImageFile(path("a.tif")),
                  exr = readImageFile(path("a.exr"));
  EXPECT_EQ(png.kind(), "8-bit png");
  EXPECT_EQ(tif.kind(), "16-bit tiff");
  EXPECT_EQ(exr.kind(), "16-bit float openexr");
  EXPECT_TRUE(png.integer && tif.integer && !exr.integer);
  EXPECT_EQ(png.image.channels, 3);
  EXPECT_EQ(tif.image.channels, 1);
  EXPECT_TRUE(png.alpha.data.empty());
  EXPECT_THAT(png.remarks, IsEmpty());
  EXPECT_FLOAT_EQ(png.image.at(2, 1, 1), (3 * (5 + 2) + 1) / 255.0F);
}

TEST_F(ImageFileTest, AlphaComesApartAndColoursAreLeftAlone) {
  OIIO::ImageSpec spec(3, 2, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  save("a.png", spec);
  const ImageFile file = readImageFile(path("a.png"));
  EXPECT_FALSE(file.premultiplied);
  ASSERT_EQ(file.image.channels, 3);
  EXPECT_FLOAT_EQ(file.image.at(1, 1, 2), (4 * 4 + 2) / 255.0F);
  EXPECT_FLOAT_EQ(file.alpha.at(1, 1), (4 * 4 + 3) / 255.0F);
}

TEST_F(ImageFileTest, AGifWithoutTransparencyHasNoAlpha) {
  // Its reader names a fourth channel of three.
  OIIO::ImageSpec spec(4, 3, 3, OIIO::TypeDesc::UINT8);
  const auto out = OIIO::ImageOutput::create(path("a.gif"));
  ASSERT_TRUE(out && out->open(path("a.gif"), spec)) << OIIO::geterror();
  const std::vector<float> white(4 * 3 * 3, 1.0F);
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, white.data()));
  ASSERT_TRUE(out->close());
  const ImageFile file = readImageFile(path("a.gif"));
  EXPECT_EQ(file.image.channels, 3);
  for (const float value : file.image.data) EXPECT_NEAR(value, 1.0F, 1.0F / 255.0F);
  for (const float value : file.alpha.data) EXPECT_EQ(value, 1.0F);
}

TEST_F(ImageFileTest, DataWindowIsSetIntoTheDisplayWindow) {
  // A 2 x 2 crop at (1, 1) of a picture of 4 x 3; and one that reaches beyond it to the left and above.
  OIIO::ImageSpec crop(2, 2, 1, OIIO::TypeDesc::FLOAT);
  crop.x = crop.y = 1;
  crop.full_width = 4;
  crop.full_height = 3;
  save("crop.exr", crop);
  const ImageFile inside = readImageFile(path("crop.exr"));
  EXPECT_EQ(inside.image.width, 4);
  EXPECT_EQ(inside.image.height, 3);
  const float one = 1.0F / 255.0F;
  EXPECT_THAT(inside.image.data, ElementsAre(0, 0, 0, 0, 0, 0, testing::FloatEq(one), 0, 0,
                                             testing::FloatEq(2 * one), testing::FloatEq(3 * one), 0));
  crop.x = crop.y = -1;
  save("beyond.exr", crop);
  const ImageFile beyond = readImageFile(path("beyond.exr"));
  EXPECT_EQ(beyond.image.width, 4);
  EXPECT_FLOAT_EQ(beyond.image.at(0, 0), 3 * one);
  EXPECT_EQ(beyond.image.at(1, 0), 0.0F);
}

TEST_F(ImageFileTest, ChannelsAreFoundByName) {
  OIIO::ImageSpec spec(2, 2, 6, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Z", "B", "normal.x", "G", "R", "A"};
  save("a.exr", spec);
  const ImageFile file = readImageFile(path("a.exr"));
  ASSERT_EQ(file.image.channels, 3);
  EXPECT_FLOAT_EQ(file.image.at(0, 0, 0), 4.0F / 255);
  EXPECT_FLOAT_EQ(file.image.at(0, 0, 1), 3.0F / 255);
  EXPECT_FLOAT_EQ(file.image.at(0, 0, 2), 1.0F / 255);
  EXPECT_FLOAT_EQ(file.alpha.at(0, 0), 5.0F / 255);
  ASSERT_EQ(file.remarks.size(), 1U);
  EXPECT_THAT(file.remarks.front(), HasSubstr("only the picture's"));
}

TEST_F(ImageFileTest, SeveralPicturesInOneFileAreRemarkedOn) {
  const OIIO::ImageSpec spec(2, 2, 3, OIIO::TypeDesc::UINT8);
  const std::vector<float> values(12, 0.5F);
  const auto out = OIIO::ImageOutput::create(path("a.tif"));
  ASSERT_TRUE(out->open(path("a.tif"), spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  ASSERT_TRUE(out->open(path("a.tif"), spec, OIIO::ImageOutput::AppendSubimage));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()) && out->close());
  ASSERT_EQ(readImageFile(path("a.tif")).remarks.size(), 1U);
}

TEST_F(ImageFileTest, OrientationsAreUndone) {
  // Exif names the sides at which the file's row 0 and column 0 lie. The file is 0 1 / 2 3.
  const std::pair<int, std::vector<int>> cases[] = {{1, {0, 1, 2, 3}},   // top, left
                                                    {2, {1, 0, 3, 2}},   // top, right
                                                    {3, {3, 2, 1, 0}},   // bottom, right
                                                    {4, {2, 3, 0, 1}},   // bottom, left
                                                    {5, {0, 2, 1, 3}},   // left, top
                                                    {6, {2, 0, 3, 1}},   // right, top
                                                    {7, {3, 1, 2, 0}},   // right, bottom
                                                    {8, {1, 3, 0, 2}}};  // left, bottom
  for (const auto& [orientation, order] : cases) {
    OIIO::ImageSpec spec(2, 2, 1, OIIO::TypeDesc::UINT8);
    spec.attribute("Orientation", orientation);
    save("a.tif", spec);
    const Image image = readImageFile(path("a.tif")).image;
    for (size_t i = 0; i < 4; ++i)
      EXPECT_FLOAT_EQ(image.data[i], static_cast<float>(order[i]) / 255.0F) << orientation;
  }
}

TEST_F(ImageFileTest, DescriptionsTravelWithWrittenFiles) {
  const Image image(2, 2, 3, 0.5F);
  writePng(path("a.png"), image, "what this is");
  writeExr(path("a.exr"), image, "what this is");
  for (const char* name : {"a.png", "a.exr"})
    EXPECT_EQ(OIIO::ImageInput::open(path(name))->spec().get_string_attribute("ImageDescription"),
              "what this is")
        << name;
}

TEST_F(ImageFileTest, RefusesWhatIsNoImage) {
  EXPECT_THROW(readImageFile(path("none.png")), Error);
  EXPECT_THROW(readImageFile(folder_.string()), Error);
  save("two.tif", {2, 2, 2, OIIO::TypeDesc::UINT8});
  EXPECT_THROW(readImageFile(path("two.tif")), Error);
}

TEST_F(ImageFileTest, AFullDiskLeavesNoPictureAndNamesTheFile) {
  Image noise(64, 64, 3);
  std::mt19937 random(1);
  for (float& value : noise.data) value = static_cast<float>(random() % 256U) / 255.0F;
  writePng(path("fits.png"), noise);
  ASSERT_EQ(readImage(path("fits.png")).data.size(), noise.data.size()) << "and the module is loaded";
  ASSERT_GT(std::filesystem::file_size(path("fits.png")), 8192U) << "too small to test anything";
  for (const char* name : {"a.png", "a.exr"}) {
    const std::string file = path(name);
    // Not in a child: the library's threads would be missing there.
    const FullDisk disk(4096);
    try {
      std::string(name) == "a.png" ? writePng(file, noise) : writeExr(file, noise);
      ADD_FAILURE() << name << " is written";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file + ": cannot be written"));
    }
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
}

/// Message of the refusal; reading takes next to no memory.
std::string refusalOf(const std::string& path) {
  std::string said;
  try {
    readImageFile(path);
    ADD_FAILURE() << path << " was read";
  } catch (const Error& error) {
    said = error.what();
  }
  EXPECT_THROW(readImage(path), Error);
  EXPECT_THAT(said, HasSubstr(path));
  return said;
}

TEST_F(ImageFileTest, AHeaderAloneTakesNoMemory) {
  // The first 69 bytes of a PNG of 16,000 x 16,000 pixels and 16 bits: a header and the beginning of its
  // data.
  const unsigned char head[] = {0x89, 'P', 'N', 'G',  13,   10, 26, 10,   0,    0,  0, 13, 'I', 'H', 'D',
                                'R',  0,   0,   0x3e, 0x80, 0,  0,  0x3e, 0x80, 16, 6, 0,  0,   0};
  uint32_t crc = 0xffffffffU;  // of chunk type and data (PNG specification, annex D)
  for (size_t i = 12; i < sizeof head; ++i) {
    crc ^= head[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? 0xedb88320U ^ (crc >> 1U) : crc >> 1U;
  }
  crc = ~crc;
  std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(crc >> static_cast<unsigned>(shift));
  bytes += std::string("\0\0\0\x18IDAT", 8) + std::string(28, 'x');
  std::ofstream(path("bomb.png"), std::ios::binary) << bytes;
  EXPECT_THAT(refusalOf(path("bomb.png")), HasSubstr("16000 x 16000"));
}

TEST_F(ImageFileTest, ComplaintsAboutEveryRowAreCutShort) {
  OIIO::ImageSpec spec(16, 4000, 1, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", "lzw");
  spec.attribute("tiff:RowsPerStrip", 1);
  save("rows.tif", spec);
  // The pictures' rows, which come last.
  std::filesystem::resize_file(path("rows.tif"), std::filesystem::file_size(path("rows.tif")) / 2);
  const std::string refusal = refusalOf(path("rows.tif"));
  EXPECT_THAT(refusal, HasSubstr("rows.tif"));
  EXPECT_LT(refusal.size(), 1000U);
}

TEST_F(ImageFileTest, WindowsOfAnExrAreLimited) {
  OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeDesc::HALF);
  spec.full_width = spec.full_height = 30000;
  save("display.exr", spec);
  EXPECT_THAT(refusalOf(path("display.exr")), HasSubstr("display window of 30000 x 30000"));
  spec.full_width = spec.full_height = 4;
  spec.full_x = spec.full_y = -1000000000;
  save("far.exr", spec);
  EXPECT_THAT(refusalOf(path("far.exr")), HasSubstr("begins at"));
}

TEST_F(ImageFileTest, AnEmptyPictureOfAUsualSizeIsNoBomb) {
  OIIO::ImageSpec spec(4096, 4096, 1, OIIO::TypeDesc::UINT8);
  const auto out = OIIO::ImageOutput::create(path("black.png"));
  spec.attribute("png:compressionLevel", 9);
  ASSERT_TRUE(out && out->open(path("black.png"), spec));
  const std::vector<uint8_t> black(size_t{4096} * 4096, 0);
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, black.data()));
  ASSERT_TRUE(out->close());
  EXPECT_EQ(readImageFile(path("black.png")).image.width, 4096);
}

TEST_F(ImageFileTest, LimitsCanBeRaised) {
  OIIO::ImageSpec spec(4, 4, 1, OIIO::TypeDesc::HALF);
  spec.full_width = spec.full_height = 5000;
  save("wide.exr", spec);
  refusalOf(path("wide.exr"));
  const ImageLimits usual = imageLimits();
  setImageLimits({.megapixels = 100.0, .alwaysMegapixels = 100.0});
  EXPECT_EQ(readImageFile(path("wide.exr")).image.width, 5000);
  setImageLimits(usual);
}

}  // namespace
}  // namespace limen
