// SPDX-License-Identifier: BSD-3-Clause
// The depths that texels of coarse levels hold: which finest texels they come from, and that they do not
// depend on the camera.
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/frame/sampled_pyramid.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class CoarseDepths : public TechniqueTest {
 protected:
  struct Levels {
    Image map, atlas;
  };
  static Levels levels(int side, frame::SampledTexel texel) {
    const scene::Scene scene = makeScene("sphere_grid");
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {8, 6});
    frame.begin();
    const frame::ShadowMapSettings settings{side};
    Levels out{frame.get<frame::ShadowMap>(settings).texture().read(),
               frame.get<frame::SampledPyramid>(settings, frame::SampledTexelSetting{texel}).atlas().read()};
    frame.end();
    return out;
  }
};

TEST_F(CoarseDepths, OfCentresAreThoseOfTheTexelsRightBelowTheCentres) {
  constexpr int kSide = 64;
  const Levels made = levels(kSide, frame::SampledTexel::Centre);
  for (int level = 1, row = 0; kSide >> level > 0; row += kSide >> level, ++level)
    for (int y = 0; y < kSide >> level; ++y)
      for (int x = 0; x < kSide >> level; ++x) {
        const int size = 1 << level;
        ASSERT_EQ(made.atlas.at(x, row + y), made.map.at(x * size + size / 2, y * size + size / 2))
            << level << ' ' << x << ' ' << y;
      }
}

/// At level 1 the four candidates are all there are; above, each quarter of a texel holds one at least as
/// near and one at least as far as the median.
TEST_F(CoarseDepths, OfMediansAreTheSecondNearestOfFour) {
  constexpr int kSide = 64;
  const Levels made = levels(kSide, frame::SampledTexel::Median);
  for (int y = 0; y < kSide / 2; ++y)
    for (int x = 0; x < kSide / 2; ++x) {
      std::array<float, 4> four = {made.map.at(2 * x, 2 * y), made.map.at(2 * x + 1, 2 * y),
                                   made.map.at(2 * x, 2 * y + 1), made.map.at(2 * x + 1, 2 * y + 1)};
      std::sort(four.begin(), four.end());
      ASSERT_EQ(made.atlas.at(x, y), four[1]) << x << ' ' << y;
    }
  for (int level = 2, row = kSide / 2; kSide >> level > 0; row += kSide >> level, ++level)
    for (int y = 0; y < kSide >> level; ++y)
      for (int x = 0; x < kSide >> level; ++x) {
        const float median = made.atlas.at(x, row + y);
        const int half = 1 << (level - 1);
        int withNearer = 0, withFarther = 0;
        bool found = false;
        for (int quarter = 0; quarter < 4; ++quarter) {
          bool nearer = false, farther = false;
          for (int j = 0; j < half; ++j)
            for (int i = 0; i < half; ++i) {
              const float z = made.map.at((2 * x + quarter % 2) * half + i, (2 * y + quarter / 2) * half + j);
              nearer = nearer || z <= median;
              farther = farther || z >= median;
              found = found || z == median;
            }
          withNearer += nearer;
          withFarther += farther;
        }
        ASSERT_TRUE(found && withNearer >= 2 && withFarther >= 3) << level << ' ' << x << ' ' << y;
      }
}

/// The same camera, upside down, sees each point in the opposite pixel. Rounding moves points by some 1e-7
/// of their distance, which can tip a sample of the light over an occluder's edge; a choice of texels that
/// depended on the picture would change most of the penumbra.
TEST_F(CoarseDepths, DoNotDependOnTheCamera) {
  scene::Scene scene = makeScene("columns_hall");
  const glm::ivec2 sizePx(64, 48);
  for (const char* depths : {"nearest", "sampled", "centre", "median"})
    for (const char* chosen : {"finest_within", "blend"}) {
      const Given given = withMaps("soft_shadows/bitmask", 512,
                                   {{"occluders.depths", std::string(depths)},
                                    {"occluders.division", std::string("levels")},
                                    {"levels", std::string(chosen)},
                                    {"budget.limit", int64_t{64}}});
      const Image upright = render(scene, "soft_shadows/bitmask", given, sizePx).product;
      scene::Scene turned = scene;
      for (auto& key : turned.camera.keys) key.camera.up = -key.camera.up;
      const Image upsideDown = render(turned, "soft_shadows/bitmask", given, sizePx).product;
      size_t penumbra = 0, differing = 0;
      for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x) {
          const float a = upright.at(x, y), b = upsideDown.at(sizePx.x - 1 - x, sizePx.y - 1 - y);
          penumbra += a > 0.0F && a < 1.0F;
          differing += std::abs(a - b) > 1.0F / 64.0F;
        }
      EXPECT_GT(penumbra, 200U);
      EXPECT_LT(static_cast<double>(differing), 0.02 * static_cast<double>(penumbra)) << depths << chosen;
    }
}

}  // namespace
}  // namespace limen::techniques
