// SPDX-License-Identifier: BSD-3-Clause
// Clears by compute, on any device: every format, level and layer, and nothing else.
#include "renderer/gl/fills.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/fill_bindings.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::gl {
namespace {

using testing::Each;

class FillsTest : public GlTest {
 protected:
  static Fills::Level levelOf(const Texture& texture, int level, int layers) {
    return {texture.id(), level, glm::max(texture.sizePx() >> level, glm::ivec2(1)), layers,
            internalFormat(texture.format())};
  }
  /// Of all layers, one after another.
  static std::vector<float> floats(const Texture& texture, int layers, int level) {
    if (layers == 0) return texture.read(level).data;
    std::vector<float> out;
    for (int i = 0; i < layers; ++i) {
      const Image image = texture.readLayer(i, level);
      out.insert(out.end(), image.data.begin(), image.data.end());
    }
    return out;
  }
  /// From here on clears take the way of GPUs, or the driver's; on any device.
  static void fillByCompute(bool is) {
    Fills::useOnSoftware(is);
    context().makeCurrent();
  }
  void TearDown() override {
    fillByCompute(false);
    GlTest::TearDown();
  }
  static std::vector<uint32_t> words(const Texture& texture, int layers, int level) {
    if (layers == 0) return texture.readUint(level);
    std::vector<uint32_t> out;
    for (int i = 0; i < layers; ++i) {
      const std::vector<uint32_t> layer = texture.readUintLayer(i, level);
      out.insert(out.end(), layer.begin(), layer.end());
    }
    return out;
  }
};

// Sizes that are no multiples of a group's. Each value is one that the format holds exactly.
TEST_F(FillsTest, EveryFloatFormatIsFilledInOneLevel) {
  const Fills fills;
  const glm::vec4 value(0.0F, 1.0F, 0.0F, 1.0F), other(1.0F, 0.0F, 1.0F, 0.0F);
  for (const Format format : {Format::R8, Format::R16F, Format::R32F, Format::RG16F, Format::RG32F,
                              Format::RGBA8, Format::RGBA16F, Format::RGBA32F})
    for (const int layers : {0, 5}) {
      const Texture texture(format, {19, 11}, 2, layers);
      fills.fill(levelOf(texture, 0, layers), other);
      fills.fill(levelOf(texture, 1, layers), value);
      const int channels = channelCount(format);
      const std::vector<float> fine = floats(texture, layers, 0), coarse = floats(texture, layers, 1);
      ASSERT_EQ(fine.size(), size_t(19 * 11 * std::max(layers, 1) * channels));
      ASSERT_EQ(coarse.size(), size_t(9 * 5 * std::max(layers, 1) * channels));
      for (size_t i = 0; i < fine.size(); ++i) ASSERT_EQ(fine[i], other[int(i) % channels]) << int(format);
      for (size_t i = 0; i < coarse.size(); ++i)
        ASSERT_EQ(coarse[i], value[int(i) % channels]) << int(format);
    }
}

TEST_F(FillsTest, EveryUnsignedFormatIsFilledInOneLevel) {
  const Fills fills;
  const glm::uvec4 value(250U, 3U, 0U, 77U), other(1U, 2U, 3U, 4U);
  for (const Format format :
       {Format::R8UI, Format::R32UI, Format::RG32UI, Format::RGBA16UI, Format::RGBA32UI})
    for (const int layers : {0, 5}) {
      const Texture texture(format, {19, 11}, 2, layers);
      fills.fill(levelOf(texture, 0, layers), value);
      fills.fill(levelOf(texture, 1, layers), other);
      const int channels = channelCount(format);
      const std::vector<uint32_t> fine = words(texture, layers, 0), coarse = words(texture, layers, 1);
      ASSERT_EQ(fine.size(), size_t(19 * 11 * std::max(layers, 1) * channels));
      for (size_t i = 0; i < fine.size(); ++i) ASSERT_EQ(fine[i], value[int(i) % channels]) << int(format);
      for (size_t i = 0; i < coarse.size(); ++i)
        ASSERT_EQ(coarse[i], other[int(i) % channels]) << int(format);
    }
  const Texture whole(Format::RG32UI, {4, 4});
  fills.fill(levelOf(whole, 0, 0), glm::uvec4(0xffffffffU));
  EXPECT_THAT(whole.readUint(), Each(0xffffffffU));
}

// Less than a group, whole groups, and a last one that is not full.
TEST_F(FillsTest, AllWordsOfABufferAreFilled) {
  const Fills fills;
  for (const int64_t count : {1, 255, 1024, 300001}) {
    const Buffer buffer(4 * count, nullptr);
    fills.fillBuffer(buffer.id(), buffer.bytes(), 0x89abcdefU);
    EXPECT_THAT(buffer.read<uint32_t>(), Each(0x89abcdefU)) << count;
  }
}

TEST_F(FillsTest, BindingsAndTheProgramStay) {
  const Fills fills;
  const Texture bound(Format::R32UI, {8, 8}, 2, 3), filled(Format::RGBA16F, {8, 8});
  const Buffer storage(1024, nullptr), other(64, nullptr);
  GLint program = -1, now = -1;
  glUseProgram(0);
  bound.bindImage(kFilledImage, Access::ReadWrite, 1);
  storage.bindStorage(kFilledBuffer, 256, 512);
  glGetIntegerv(GL_CURRENT_PROGRAM, &program);
  fills.fill(levelOf(filled, 0, 0), glm::vec4(1.0F));
  fills.fillBuffer(other.id(), other.bytes(), 5);
  glGetIntegerv(GL_CURRENT_PROGRAM, &now);
  EXPECT_EQ(now, program);
  const auto image = [](GLenum name) {
    GLint value = -1;
    glGetIntegeri_v(name, kFilledImage, &value);
    return value;
  };
  EXPECT_EQ(image(GL_IMAGE_BINDING_NAME), GLint(bound.id()));
  EXPECT_EQ(image(GL_IMAGE_BINDING_LEVEL), 1);
  EXPECT_EQ(image(GL_IMAGE_BINDING_LAYERED), GL_TRUE);
  EXPECT_EQ(image(GL_IMAGE_BINDING_ACCESS), GL_READ_WRITE);
  EXPECT_EQ(image(GL_IMAGE_BINDING_FORMAT), GL_R32UI);
  GLint buffer = 0;
  GLint64 start = 0, size = 0;
  glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, kFilledBuffer, &buffer);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, kFilledBuffer, &start);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, kFilledBuffer, &size);
  EXPECT_EQ(buffer, GLint(storage.id()));
  EXPECT_EQ(start, 256);
  EXPECT_EQ(size, 512);
}

// A program that was deleted while in use stays until another one is used: it cannot be taken again.
TEST_F(FillsTest, AProgramDeletedInUseIsLeft) {
  const Fills fills;
  const Texture filled(Format::RGBA16F, {8, 8});
  const Buffer buffer(64, nullptr);
  for (const bool image : {false, true}) {
    {
      const Program gone({"renderer/gl/fill_buffer.comp.glsl"}, {});
      gone.use();
    }
    if (image)
      fills.fill(levelOf(filled, 0, 0), glm::vec4(1.0F));
    else
      fills.fillBuffer(buffer.id(), buffer.bytes(), 7);
    GLint now = -1;
    glGetIntegerv(GL_CURRENT_PROGRAM, &now);
    EXPECT_EQ(now, 0);
  }
  EXPECT_THAT(buffer.read<uint32_t>(), Each(7U));
}

// 128 MiB are what a storage block may have on every device.
TEST_F(FillsTest, ABufferLargerThanAStorageBlockIsFilled) {
  const Fills fills;
  const int64_t part = int64_t{1} << 27, bytes = part + 8196;
  const Buffer buffer(bytes, nullptr);
  fills.fillBuffer(buffer.id(), bytes, 0x89abcdefU);
  EXPECT_THAT(buffer.read<uint32_t>(0, 1024), Each(0x89abcdefU));
  EXPECT_THAT(buffer.read<uint32_t>(part - 4096), Each(0x89abcdefU));
}

// Large enough for a GPU to take them, whatever the device; then by compute, if it is not one.
TEST_F(FillsTest, LargeTexturesAndBuffersAreCleared) {
  for (const bool compute : {false, true}) {
    fillByCompute(compute);
    EXPECT_EQ(Fills::forBytes(65535), nullptr);
    if (compute) {
      EXPECT_NE(Fills::forBytes(65536), nullptr);
    }
    // Twice the size of the level that is cleared, odd, and more than one group wide, high and deep.
    const Texture floats(Format::RGBA32F, {257, 261}, 2, 3), flat(Format::R16F, {331, 317}),
        bits(Format::R32UI, {129, 131}, 1, 9), small(Format::R8UI, {513, 515}, 3);
    floats.clear(glm::vec4(3.0F));
    floats.clear(glm::vec4(0.5F, -1.0F, 0.0F, 2.0F), 1);
    flat.clear(glm::vec4(-0.25F));
    bits.clearUint(glm::uvec4(0xfffffff0U));
    small.clearUint(glm::uvec4(1U));
    small.clearUint(glm::uvec4(254U), 1);
    small.clearUint(glm::uvec4(3U), 2);
    for (int layer = 0; layer < 3; ++layer) {
      EXPECT_THAT(floats.readLayer(layer).data, Each(3.0F));
      const std::vector<float> coarse = floats.readLayer(layer, 1).data;
      for (size_t i = 0; i < coarse.size(); i += 4)
        ASSERT_THAT(std::vector<float>(coarse.begin() + long(i), coarse.begin() + long(i) + 4),
                    testing::ElementsAre(0.5F, -1.0F, 0.0F, 2.0F));
    }
    EXPECT_THAT(flat.read().data, Each(-0.25F));
    for (int layer = 0; layer < 9; ++layer) EXPECT_THAT(bits.readUintLayer(layer), Each(0xfffffff0U));
    EXPECT_THAT(small.readUint(0), Each(1U));
    EXPECT_THAT(small.readUint(1), Each(254U));
    EXPECT_THAT(small.readUint(2), Each(3U));
    // Of no whole number of 16 bytes; a buffer, and a view of some layers.
    const Buffer buffer((1 << 20) + 4, nullptr);
    buffer.clearUint(0xfffffff1U);
    EXPECT_THAT(buffer.read<uint32_t>(), Each(0xfffffff1U));
    bits.view(2, 3).clearUint(glm::uvec4(5U));
    for (int layer = 0; layer < 9; ++layer)
      EXPECT_THAT(bits.readUintLayer(layer), Each(layer >= 2 && layer < 5 ? 5U : 0xfffffff0U));
  }
}

// Between a program's use and its dispatch, and between dispatches, a clear changes what it clears alone.
TEST_F(FillsTest, AClearAmongDispatchesKeepsTheirProgramAndBindings) {
  for (const bool compute : {false, true}) {
    fillByCompute(compute);
    const Program write({"renderer/gl/fill_image.comp.glsl"}, {{"IMAGE", "image2D"}});
    const Texture written(Format::RGBA32F, {96, 96}), cleared(Format::RGBA32F, {96, 96});
    const Buffer buffer(1 << 17, nullptr);
    write.set("value", glm::vec4(0.75F));
    written.bindImage(kFilledImage, Access::Write);
    write.use();
    written.clear(glm::vec4(3.0F));
    cleared.clear(glm::vec4(2.0F));
    buffer.clearUint(9);
    glDispatchCompute(12, 12, 1);
    cleared.clear(glm::vec4(4.0F));
    EXPECT_THAT(written.read().data, Each(0.75F)) << compute;
    written.clear(glm::vec4(5.0F));
    EXPECT_THAT(written.read().data, Each(5.0F)) << compute;
    EXPECT_THAT(cleared.read().data, Each(4.0F));
    EXPECT_THAT(buffer.read<uint32_t>(), Each(9U));
    glUseProgram(0);
  }
}

// Each context has fills of its own, which go with it.
TEST_F(FillsTest, ContextsComeAndGo) {
  Fills::useOnSoftware(true);
  for (int round = 0; round < 3; ++round) {
    std::unique_ptr<Context> first = createHeadlessContext(), second = createHeadlessContext();
    const Fills* const ofSecond = Fills::forBytes(1 << 20);
    ASSERT_NE(ofSecond, nullptr);
    first->makeCurrent();
    const Fills* const ofFirst = Fills::forBytes(1 << 20);
    EXPECT_NE(ofFirst, ofSecond);
    for (int turn = 0; turn < 2; ++turn) {
      (turn == 0 ? first : second)->makeCurrent();
      const Texture texture(Format::R32UI, {256, 256});
      texture.clearUint(glm::uvec4(uint32_t(7 + round)));
      EXPECT_THAT(texture.readUint(), Each(uint32_t(7 + round)));
    }
    for (Context* of : {first.get(), second.get()})
      for (const DebugMessage& message : of->takeDebugMessages()) ADD_FAILURE() << message.text;
    first.reset();
    EXPECT_EQ(Fills::forBytes(1 << 20), nullptr);
    second->makeCurrent();
    EXPECT_EQ(Fills::forBytes(1 << 20), ofSecond);
  }
}

}  // namespace
}  // namespace limen::gl
