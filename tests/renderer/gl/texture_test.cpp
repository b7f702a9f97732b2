// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/texture.h"

#include <epoxy/gl.h>

#include <optional>

#include "renderer/gl/buffer.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::gl {
namespace {

class TextureTest : public GlTest {};

TEST_F(TextureTest, FloatTexturesGiveBackWhatWasWrittenRowByRowFromTheTop) {
  // Odd sizes: rows are not padded.
  for (const Format format : {Format::R32F, Format::RG32F, Format::RGBA32F}) {
    const Texture texture(format, {5, 3});
    Image image(5, 3, channelCount(format));
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.1F * static_cast<float>(i) - 1e-30F;
    texture.write(image);
    EXPECT_EQ(texture.read().data, image.data);
  }
}

TEST_F(TextureTest, NormalisedBytesRoundToTheNearestOf256) {
  const Texture texture(Format::RGBA8, {2, 2});
  Image image(2, 2, 4);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<float>(i) / 15.0F;
  texture.write(image);
  const Image back = texture.read();
  for (size_t i = 0; i < image.data.size(); ++i) EXPECT_NEAR(back.data[i], image.data[i], 0.5 / 255.0 + 1e-6);
}

TEST_F(TextureTest, ClearingReachesOneLevelOnly) {
  const Texture texture(Format::R32F, {8, 8}, 4);
  for (int level = 0; level < 4; ++level) texture.clear(glm::vec4(float(level)), level);
  for (int level = 0; level < 4; ++level) {
    const Image image = texture.read(level);
    EXPECT_EQ(image.width, 8 >> level);
    for (const float value : image.data) EXPECT_EQ(value, float(level));
  }
}

TEST_F(TextureTest, ClearingAnArrayReachesAllLayersOfOneLevel) {
  const Texture floats(Format::RGBA16F, {6, 4}, 2, 5), bits(Format::RG32UI, {3, 2}, 1, 300);
  floats.clear(glm::vec4(0.25F, -2.0F, 3.0F, 0.5F));
  floats.clear(glm::vec4(7.0F), 1);
  bits.clearUint({0xffffffffU, 0x80000001U, 0U, 0U});
  for (int layer = 0; layer < 5; ++layer) {
    const Image fine = floats.readLayer(layer), coarse = floats.readLayer(layer, 1);
    for (size_t i = 0; i < fine.data.size(); i += 4)
      EXPECT_THAT(std::vector<float>(fine.data.begin() + static_cast<long>(i),
                                     fine.data.begin() + static_cast<long>(i) + 4),
                  testing::ElementsAre(0.25F, -2.0F, 3.0F, 0.5F));
    for (const float value : coarse.data) EXPECT_EQ(value, 7.0F);
  }
  for (const int layer : {0, 1, 299}) {
    const std::vector<uint32_t> texels = bits.readUintLayer(layer);
    ASSERT_EQ(texels.size(), 12U);
    for (size_t i = 0; i < texels.size(); ++i) EXPECT_EQ(texels[i], i % 2 ? 0x80000001U : 0xffffffffU);
  }
}

TEST_F(TextureTest, IntegerTexturesKeepAllBits) {
  const Texture texture(Format::RGBA32UI, {3, 2});
  texture.clearUint({0xffffffffU, 0x80000001U, 0U, 1U});
  const std::vector<uint32_t> back = texture.readUint();
  ASSERT_EQ(back.size(), 24U);
  for (size_t i = 0; i < back.size(); i += 4) {
    EXPECT_EQ(back[i], 0xffffffffU);
    EXPECT_EQ(back[i + 1], 0x80000001U);
    EXPECT_EQ(back[i + 3], 1U);
  }
}

TEST_F(TextureTest, BytesCountAllLevelsAndLayers) {
  EXPECT_EQ(Texture(Format::R32F, {4, 4}, 3).bytes(), 4 * (16 + 4 + 1));
  EXPECT_EQ(Texture(Format::RG16F, {3, 5}, 1, 7).bytes(), 4 * 15 * 7);
}

TEST_F(TextureTest, ViewsShareTheMemoryOfTheirLayersAndOutliveTheArray) {
  std::optional<Texture> array(std::in_place, Format::R32F, glm::ivec2(4, 2), 2, 3);
  array->clear(glm::vec4(1.0F));
  Texture middle = array->view(1);
  const Texture last = array->view(1, 2).view(1);
  EXPECT_EQ(middle.levels(), 2);
  EXPECT_EQ(3 * middle.bytes(), array->bytes());
  middle.clear(glm::vec4(2.0F));
  EXPECT_EQ(array->readLayer(0).at(3, 1), 1.0F);
  EXPECT_EQ(array->readLayer(1).at(3, 1), 2.0F);
  EXPECT_EQ(array->readLayer(2).at(3, 1), 1.0F);
  Image image(4, 2, 1);
  image.at(2, 1) = 5.0F;
  last.write(image);
  EXPECT_EQ(array->readLayer(2).at(2, 1), 5.0F);
  array.reset();
  EXPECT_EQ(middle.read().at(0, 0), 2.0F);
}

TEST_F(TextureTest, AFramebufferOfDifferentKindsIsRefused) {
  const Texture colour(Format::R32F, {4, 4});
  EXPECT_THROW(Framebuffer({&colour}, &colour), std::runtime_error);
  context().takeDebugMessages();  // the attachment is a mistake on purpose
}

TEST_F(TextureTest, BuffersGiveBackWhatWasWritten) {
  const std::vector<uint32_t> data = {1, 2, 3, 4, 5};
  const Buffer buffer(data);
  EXPECT_EQ(buffer.read<uint32_t>(), data);
  const uint32_t other = 9;
  buffer.write(8, 4, &other);
  EXPECT_EQ(buffer.read<uint32_t>(8, 1)[0], 9U);
  buffer.clearUint(7);
  for (const uint32_t value : buffer.read<uint32_t>()) EXPECT_EQ(value, 7U);
  EXPECT_GT(Buffer(std::vector<uint32_t>{}).bytes(), 0);
}

}  // namespace
}  // namespace limen::gl
