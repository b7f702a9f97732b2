// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/shaded.h"

#include <cmath>
#include <set>

#include "renderer/frame/g_buffer.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr glm::ivec2 kShadedSize{56, 40};

class ShadedTest : public gl::GlTest {
 protected:
  static Image render(const scene::Scene& scene, const ShadedSetting& setting,
                      glm::ivec2 sizePx = kShadedSize) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, sizePx);
    frame.begin();
    Image out = frame.get<Shaded>(setting).texture().read();
    frame.end();
    return out;
  }
};

/// Albedo x (ambient + diffuse cos) by brute force in double precision where the pixel's triangle is agreed.
TEST_F(ShadedTest, IsTheAlbedoByAmbientAndCosine) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const scene::Scene scene = builtScene("two_boxes", {{"scale", scale}});
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, kShadedSize);
    frame.begin();
    const Image ids = [&] {
      const std::vector<uint32_t> raw = frame.get<TriangleIds>().texture().readUint();
      Image image(kShadedSize.x, kShadedSize.y, 1);
      for (size_t i = 0; i < raw.size(); ++i) image.data[i] = static_cast<float>(raw[i]);
      return image;
    }();
    const Image position = frame.get<GBufferChannel>(ChannelSetting{Channel::Position}).texture().read();
    const Image colour = frame.get<Shaded>(ShadedSetting{}).texture().read();
    frame.end();
    const BruteForce truth(scene, gpuScene.anchor());
    const glm::dvec3 eye(glm::inverse(frame.anchorToCamera())[3]);
    size_t lit = 0;
    for (int y = 0; y < kShadedSize.y; ++y)
      for (int x = 0; x < kShadedSize.x; ++x) {
        const auto id = static_cast<uint32_t>(ids.at(x, y));
        EXPECT_EQ(colour.at(x, y, 3), 1.0F);
        if (position.at(x, y, 3) == 0.0F) {
          EXPECT_EQ(colour.at(x, y, 0), 0.05F);
          continue;
        }
        const glm::dvec3 p(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
        glm::dvec3 n = truth.normal(id);
        if (glm::dot(n, p - eye) > 0.0) n = -n;
        const glm::dvec3 toLight = glm::normalize(scene.lights[0].centre - gpuScene.anchor() - p);
        const double share = 0.2 + 0.8 * std::max(glm::dot(n, toLight), 0.0);
        lit += share > 0.2;
        for (const scene::Part& part : scene.parts) {
          if (id < part.firstTriangle || id >= part.firstTriangle + part.triangleCount) continue;
          for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(colour.at(x, y, c), scene.materials[part.material].albedo[c] * share, 2e-5);
          }
        }
      }
    EXPECT_GT(lit, 500U);
  }
}

TEST_F(ShadedTest, NeedsNoLight) {
  scene::Scene scene = builtScene("two_boxes");
  scene.lights.clear();
  ShadedSetting setting;
  setting.shadow = true;  // of no light
  const Image colour = render(scene, setting);
  std::set<float> levels;
  for (size_t i = 0; i < colour.pixels(); ++i) levels.insert(colour.data[4 * i]);
  std::set<float> expected{0.05F};
  for (const scene::Material& material : scene.materials) expected.insert(0.2F * material.albedo.x);
  for (const float level : levels) {
    bool known = false;
    for (const float e : expected) known = known || std::abs(e - level) < 1e-6F;
    EXPECT_TRUE(known) << level;
  }
}

/// A square facing the camera exactly, 1 x 1 at distance 1, filling the picture of a 90 degree view's middle.
scene::Scene square(const scene::Material& material) {
  scene::Scene scene;
  scene.mesh.positions = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.parts = {{"square", 0, 2, 0, false}};
  scene.materials = {material};
  scene::Camera camera;
  camera.eye = {0.0, 0.0, 1.0};
  camera.verticalFovDeg = 90.0;
  scene::setStillCamera(scene, camera);
  return scene;
}

TEST_F(ShadedTest, CheckerHasItsCellsAndContrast) {
  scene::Material material{"checker", glm::vec3(0.5F)};
  material.pattern = {scene::Pattern::Kind::Checker, 0.5, 0.4, 1, {0.0, 0.0, -0.25}};
  ShadedSetting setting;
  setting.ambient = 1.0;
  const Image colour = render(square(material), setting, {32, 32});
  // 32 pixels see 2 units: 8 pixels a cell. Cell (0,0,0) is +1; row 0 is at y = +1.
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const int i = x / 8 - 2, j = (31 - y) / 8 - 2;
      const double s = ((i + j) & 1) == 0 ? 1.0 : -1.0;
      EXPECT_NEAR(colour.at(x, y), 0.5 * (1.0 + 0.4 * s), 1e-6) << x << ' ' << y;
    }
}

TEST_F(ShadedTest, NoiseStaysWithinItsContrastAndIsSmooth) {
  scene::Material material{"noise", glm::vec3(0.5F)};
  material.pattern = {scene::Pattern::Kind::ValueNoise, 0.25, 1.0, 1, {0.1, 0.2, 0.3}};
  ShadedSetting setting;
  setting.ambient = 1.0;
  const Image colour = render(square(material), setting, {64, 64});
  float low = 1.0F, high = 0.0F, step = 0.0F;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      low = std::min(low, colour.at(x, y)), high = std::max(high, colour.at(x, y));
      if (x > 0) step = std::max(step, std::abs(colour.at(x, y) - colour.at(x - 1, y)));
    }
  EXPECT_GE(low, 0.0F);
  EXPECT_LE(high, 1.0F);
  EXPECT_GT(high - low, 0.5F);  // 64 lattice values in [0, 1]: both ends are near with certainty for practice
  // The quintic's slope is at most 15/8 a cell of 8 pixels, between values at most 1 apart.
  EXPECT_LE(step, 15.0 / 8.0 / 8.0 + 1e-5);
}

TEST_F(ShadedTest, VertexNormalsAreInterpolatedAndCanBeSwitchedOff) {
  scene::Scene scene = square({"plain", glm::vec3(1.0F)});
  scene.lights = {scene::lightTowards({0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}, glm::dvec2(1.0))};
  // Normals lean to -x on the left and +x on the right: at x the sum is (x, 0, 1) up to length.
  const float root = 1.0F / std::sqrt(2.0F);
  scene.mesh.normals = {{-root, 0, root}, {root, 0, root}, {root, 0, root}, {-root, 0, root}};
  ShadedSetting setting;
  setting.ambient = 0.0;
  setting.diffuse = 1.0;
  const Image smooth = render(scene, setting, {32, 32});
  setting.smoothNormals = false;
  const Image flat = render(scene, setting, {32, 32});
  for (int i = 0; i < 32; ++i) {
    const double x = (i + 0.5) / 16.0 - 1.0, y = 1.0 - 8.5 / 16.0;
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(-x, -y, 100.0));
    EXPECT_NEAR(smooth.at(i, 8), glm::dot(glm::normalize(glm::dvec3(x, 0.0, 1.0)), toLight), 1e-5);
    EXPECT_NEAR(flat.at(i, 8), toLight.z, 1e-5);
  }
}

TEST_F(ShadedTest, ShadowTakesTheLightAwayAndLeavesTheAmbient) {
  const scene::Scene scene = builtScene("two_boxes");
  ShadedSetting setting;
  const Image open = render(scene, setting);
  setting.shadow = true;
  const Image shadowed = render(scene, setting);
  setting.diffuse = 0.0;
  const Image ambient = render(scene, setting);
  size_t dark = 0;
  for (size_t i = 0; i < 4 * open.pixels(); ++i) {
    const bool lit = shadowed.data[i] == open.data[i], inShadow = shadowed.data[i] == ambient.data[i];
    EXPECT_TRUE(lit || inShadow);
    dark += !lit;
  }
  EXPECT_GT(dark, 4U * 20);
}

TEST_F(ShadedTest, OnePixelAndDegenerateTrianglesStayFinite) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 17), glm::ivec2(33, 20)}) {
    ShadedSetting setting;
    setting.specular = 1.0;
    setting.shadow = true;
    for (const float value : render(builtScene("degenerate_soup"), setting, size).data)
      EXPECT_TRUE(std::isfinite(value) && value >= 0.0F);
  }
}

}  // namespace
}  // namespace limen::frame
