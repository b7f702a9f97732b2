// SPDX-License-Identifier: BSD-3-Clause
// Lights that show image files.
#include "renderer/scene/light_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "experiments/base/error.h"

namespace limen::scene {
namespace {

namespace fs = std::filesystem;

class LightPicture : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("light_picture_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static Scene lit(const std::string& file, int64_t cells) {
    const ParameterValues values(SceneRegistry::instance().get("two_boxes").allParameters(),
                                 {{"light_emission", std::string("picture")},
                                  {"light_emission.file", file},
                                  {"light_emission.cells", cells}});
    return buildScene("two_boxes", values);
  }

 private:
  fs::path folder_;
};

TEST_F(LightPicture, CellsKeepTheMeanOfAPictureOfAnySize) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(0.0F, 30.0F);
  Image picture(37, 23, 3);
  glm::dvec3 mean(0.0);
  for (size_t i = 0; i < picture.data.size(); ++i) {
    picture.data[i] = value(random);
    mean[int(i % 3)] += picture.data[i] / double(picture.pixels());
  }
  writeExr(path("random.exr"), picture);
  for (const int64_t cells : {1, 2, 7, 16, 64}) {
    const AreaLight light = lit(path("random.exr"), cells).lights[0];
    EXPECT_EQ(light.parts.size(), size_t(cells * cells));
    glm::dvec3 sum(0.0);
    for (const LightPart& part : light.parts) {
      const glm::dvec2 extent = part.outline[2] - part.outline[0];
      sum += glm::dvec3(part.radiance) * extent.x * extent.y;
    }
    // Parts hold floats.
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(sum[channel] / mean[channel], 1.0, 0x1p-23) << cells;
  }
}

TEST_F(LightPicture, IsUprightForThoseItLights) {
  // Red at the top left, green at the top right, blue at the bottom left, white at the bottom right.
  Image corners(2, 2, 3);
  corners.data = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  writePng(path("corners.png"), corners);
  const Scene scene = lit(path("corners.png"), 2);
  const AreaLight& light = scene.lights[0];
  // Whoever looks against the light's direction with its y axis upwards has this to the right.
  const glm::dvec3 right = glm::cross(-light.direction(), light.axisY), up = light.axisY;
  ASSERT_EQ(light.parts.size(), 4U);
  for (const LightPart& part : light.parts) {
    const glm::dvec3 from = light.point(0.5 * (part.outline[0] + part.outline[2])) - light.centre;
    const bool isRight = glm::dot(from, right) > 0.0, isUp = glm::dot(from, up) > 0.0;
    const glm::vec3 expected = isUp ? (isRight ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0))
                                    : (isRight ? glm::vec3(1, 1, 1) : glm::vec3(0, 0, 1));
    EXPECT_EQ(part.radiance, expected) << isRight << isUp;
  }
}

TEST_F(LightPicture, IntegersAreDisplayValuesAndFloatsAreRadiance) {
  // sRGB code 188 is half of white to three digits (188 / 255 -> 0.5029).
  writePng(path("grey.png"), Image(3, 3, 3, 188.0F / 255.0F));
  writeExr(path("grey.exr"), Image(3, 3, 3, 12.5F));
  EXPECT_NEAR(lit(path("grey.png"), 1).lights[0].parts.at(0).radiance.g, 0.5029, 5e-5);
  EXPECT_EQ(lit(path("grey.exr"), 1).lights[0].parts.at(0).radiance.g, 12.5F);
  // A Radiance file (Ward 1991) by hand: mantissas 128, 64, 0 and exponent 130 are 2, 1 and 0.
  std::ofstream hdr(path("dot.hdr"), std::ios::binary);
  hdr << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n";
  for (const int byte : {128, 64, 0, 130}) hdr.put(static_cast<char>(byte));
  hdr.close();
  const glm::vec3 dot = lit(path("dot.hdr"), 1).lights[0].parts.at(0).radiance;
  // Some readers put a mantissa in the middle of its step, of 2^-7 here.
  EXPECT_NEAR(dot.r, 2.0F, 0x1p-7F);
  EXPECT_NEAR(dot.g, 1.0F, 0x1p-7F);
}

TEST_F(LightPicture, BlackCellsAreLeftOut) {
  Image half(2, 1, 3, 0.0F);
  for (size_t i = 3; i < 6; ++i) half.data[i] = 1.0F;
  writePng(path("half.png"), half);
  const std::vector<LightPart> parts = lit(path("half.png"), 4).lights[0].parts;
  EXPECT_EQ(parts.size(), 8U);
  for (const LightPart& part : parts) {
    EXPECT_GE(part.outline[0].x, 0.5);
    EXPECT_EQ(part.radiance, glm::vec3(1.0F));
  }
}

TEST_F(LightPicture, WhatCannotBeEmittedIsRefusedWithTheFilesName) {
  const auto message = [&](const std::string& file) -> std::string {
    try {
      lit(path(file), 4);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return "no error";
  };
  const auto holds = [&](const std::string& file, const std::string& word) {
    const std::string found = message(file);
    EXPECT_NE(found.find(file), std::string::npos) << found;
    EXPECT_NE(found.find(word), std::string::npos) << found;
  };
  const auto exrWith = [&](const std::string& file, float value) {
    Image image(3, 2, 3, 1.0F);
    image.data[7] = value;
    writeExr(path(file), image);
  };
  exrWith("negative.exr", -0.5F);
  exrWith("nan.exr", std::numeric_limits<float>::quiet_NaN());
  exrWith("endless.exr", std::numeric_limits<float>::infinity());
  writePng(path("black.png"), Image(4, 4, 3, 0.0F));
  std::ofstream(path("text.png")) << "no picture";
  writePng(path("cut.png"), Image(64, 64, 3, 0.3F));
  fs::resize_file(path("cut.png"), fs::file_size(path("cut.png")) / 2);
  holds("negative.exr", "cannot emit");
  holds("nan.exr", "cannot emit");
  holds("endless.exr", "cannot emit");
  holds("black.png", "emits nothing");
  for (const char* file : {"absent.png", "text.png", "cut.png"}) holds(file, "");
}

TEST_F(LightPicture, AnotherContentIsAnotherScene) {
  writePng(path("light.png"), Image(2, 2, 3, 1.0F));
  const std::string before = lit(path("light.png"), 2).contentHash();
  Image other(2, 2, 3, 1.0F);
  other.data[0] = 0.0F;
  writePng(path("other.png"), other);
  fs::rename(path("other.png"), path("light.png"));
  EXPECT_NE(lit(path("light.png"), 2).contentHash(), before);
}

}  // namespace
}  // namespace limen::scene
