// SPDX-License-Identifier: BSD-3-Clause
// Visibility for some of the pixels, interpolated for the others: against surfaces whose visibility is known,
// and against the technique that did the work.
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

/// What a pixel sees, as upsampling gets it: in camera space, looking along -z.
struct SeenPixel {
  float depth;
  glm::vec3 normal;
  float visibility;
  bool receiver = true;
};

class SparseVisibility : public TechniqueTest {
 protected:
  static constexpr float kTolerance = 0.02F;

  struct Upsampled {
    Image visibility;
    std::vector<uint32_t> classes;
  };

  /// Samples every factor-th pixel of a made-up picture, upsamples.
  static Upsampled upsample(glm::ivec2 sizePx, int factor, const std::function<SeenPixel(glm::ivec2)>& seen) {
    const glm::ivec2 gridPx = (sizePx - 1 + factor - 1) / factor + 1;
    const Channels picture(sizePx, seen);
    const Channels grid(gridPx, [&](glm::ivec2 at) { return seen(glm::min(factor * at, sizePx - 1)); });
    const gl::Texture out(gl::Format::R32F, sizePx), classes(gl::Format::R32UI, sizePx);
    const gl::Program& program = context().programs().compute(
        "renderer/techniques/soft_shadows/sparse/upsample.comp.glsl", {{"COUNT", "1"}});
    program.set("sizePx", sizePx);
    program.set("gridSizePx", gridPx);
    program.set("firstPlace", glm::vec2(0.5F));
    program.set("placeStep", glm::vec2(static_cast<float>(factor)));
    program.set("lastPlace", glm::vec2(sizePx) - 0.5F);
    program.set("rayScale", rayScaleOf(sizePx));
    program.set("anchorToCamera", glm::mat4(1.0F));
    program.set("depthTolerance", kTolerance);
    program.set("normalPower", 4.0F);
    picture.bind(kSparseReceiversUnit);
    grid.bind(kSparseUpsampleGridReceiversUnit);
    grid.visibility.bindTexture(kSparseUpsampleGridVisibilityUnit);
    out.bindImage(kSparseReconstructVisibilityImage, gl::Access::Write);
    classes.bindImage(kSparseReconstructClassImage, gl::Access::Write);
    program.dispatch(sizePx);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    return {out.read(), classes.readUint()};
  }

  static glm::vec2 rayScaleOf(glm::ivec2 sizePx) {
    return {0.4F * static_cast<float>(sizePx.x) / static_cast<float>(sizePx.y), 0.4F};
  }

  /// Ray through a pixel's centre, at distance 1.
  static glm::vec3 rayOf(glm::ivec2 pixel, glm::ivec2 sizePx) {
    const glm::vec2 ndc =
        glm::vec2(2.0F, -2.0F) * (glm::vec2(pixel) + 0.5F) / glm::vec2(sizePx) + glm::vec2(-1.0F, 1.0F);
    return {ndc * rayScaleOf(sizePx), -1.0F};
  }

 private:
  struct Channels {
    gl::Texture receivers, depths, normals, visibility;
    Channels(glm::ivec2 sizePx, const std::function<SeenPixel(glm::ivec2)>& seen)
        : receivers(gl::Format::RGBA32F, sizePx),
          depths(gl::Format::R32F, sizePx),
          normals(gl::Format::RGBA32F, sizePx),
          visibility(gl::Format::R32F, sizePx) {
      Image r(sizePx.x, sizePx.y, 4), d(sizePx.x, sizePx.y, 1), n(sizePx.x, sizePx.y, 4),
          v(sizePx.x, sizePx.y, 1);
      for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x) {
          const auto i = static_cast<size_t>(y * sizePx.x + x);
          const SeenPixel pixel = seen({x, y});
          r.data[4 * i + 3] = pixel.receiver ? 0.0F : -1.0F;
          d.data[i] = pixel.depth;
          v.data[i] = pixel.visibility;
          for (int k = 0; k < 3; ++k) n.data[4 * i + static_cast<size_t>(k)] = pixel.normal[k];
        }
      receivers.write(r), depths.write(d), normals.write(n), visibility.write(v);
    }
    void bind(uint32_t unit) const {
      receivers.bindTexture(unit), depths.bindTexture(unit + 1), normals.bindTexture(unit + 2);
    }
  };
};

uint32_t scramble(uint32_t x) {
  x = (x ^ (x >> 16)) * 0x45d9f3bU;
  x = (x ^ (x >> 16)) * 0x45d9f3bU;
  return x ^ (x >> 16);
}
float randomOf(glm::ivec2 at, uint32_t salt) {
  return static_cast<float>(
             scramble(static_cast<uint32_t>(at.x) + 977U * static_cast<uint32_t>(at.y) + salt) >> 8) *
         0x1p-24F;
}

TEST_F(SparseVisibility, UpsamplingKeepsAConstantWhateverTheSurface) {
  for (const int factor : {1, 2, 3, 4, 8}) {
    const Upsampled out = upsample({37, 22}, factor, [](glm::ivec2 at) {
      return SeenPixel{1.0F + randomOf(at, 1),
                       glm::normalize(glm::vec3(randomOf(at, 2), randomOf(at, 3), 1.0F)), 0.3F,
                       randomOf(at, 4) > 0.2F};
    });
    for (size_t i = 0; i < out.visibility.data.size(); ++i) {
      // 0: no receiver; 3: no sample in reach. A mean of four equal values rounds three times each in the two
      // sums, and in the quotient.
      const bool known = out.classes[i] != 0 && out.classes[i] != 3;
      EXPECT_NEAR(out.visibility.data[i], known ? 0.3F : 1.0F, 0.3 * 8.0 * 0x1p-24) << factor;
    }
  }
}

TEST_F(SparseVisibility, UpsamplingIsExactForLinearVisibilityOnATiltedPlane) {
  const glm::ivec2 sizePx(45, 31);
  const glm::vec3 normal = glm::normalize(glm::vec3(0.2F, 0.5F, 0.8F));
  const auto seen = [&](glm::ivec2 at) {
    const float depth = -2.0F * normal.z / glm::dot(normal, rayOf(at, sizePx));
    return SeenPixel{
        depth, normal,
        0.1F + 0.8F * (0.6F * static_cast<float>(at.x) / 44.0F + 0.4F * static_cast<float>(at.y) / 30.0F)};
  };
  for (const int factor : {2, 3, 4, 8}) {
    const Upsampled out = upsample(sizePx, factor, seen);
    for (int y = 0; y < sizePx.y; ++y)
      for (int x = 0; x < sizePx.x; ++x) {
        const auto i = static_cast<size_t>(y * sizePx.x + x);
        EXPECT_TRUE(out.classes[i] == 1 || out.classes[i] == 4) << out.classes[i];
        // Distances from the plane are rounding, about 1e-6 of some 3 units, and the weight is 1 - 2 (d /
        // (0.02 z))^2: less than 1e-8 off. What remains is the rounding of places up to 45 in steps of at
        // least 2, 45
        // * 2^-24 each, times the difference between samples, at most 0.8, and of the sums.
        EXPECT_NEAR(out.visibility.data[i], seen({x, y}).visibility, 1e-5) << factor << " " << x << " " << y;
      }
  }
}

TEST_F(SparseVisibility, UpsamplingMixesNothingAcrossAnEdgeInDepth) {
  // 3 units against 2 are apart by 1, tolerated is 0.02 * 3 = 0.06: the weight is exactly 0. A pixel finds
  // its own surface among the samples around it, since the edge is straight. A quotient of equal numbers may
  // be off by the 2.5 units that GLSL grants a division.
  const glm::ivec2 sizePx(40, 30);
  const auto seen = [](glm::ivec2 at) {
    const bool near = 2 * at.x + at.y < 50;
    return SeenPixel{near ? 2.0F : 3.0F, {0.0F, 0.0F, 1.0F}, near ? 0.0F : 1.0F};
  };
  for (const int factor : {2, 4, 8}) {
    const Upsampled out = upsample(sizePx, factor, seen);
    for (int y = 0; y < sizePx.y; ++y)
      for (int x = 0; x < sizePx.x; ++x)
        EXPECT_NEAR(out.visibility.data[static_cast<size_t>(y * sizePx.x + x)], seen({x, y}).visibility,
                    2.5 * 0x1p-23)
            << factor << " " << x << " " << y;
  }
}

TEST_F(SparseVisibility, UpsamplingGivesASurfaceWithoutSamplesTheNearestInDepthAndSaysSo) {
  // A line one pixel wide between two columns of samples, nearer to the surface on its left.
  const glm::ivec2 sizePx(40, 30);
  const auto seen = [](glm::ivec2 at) {
    const float depth = at.x < 13 ? 2.0F : at.x == 13 ? 2.4F : 3.0F;
    return SeenPixel{depth, {0.0F, 0.0F, 1.0F}, at.x < 13 ? 0.25F : 1.0F};
  };
  const Upsampled out = upsample(sizePx, 4, seen);
  for (int y = 0; y < sizePx.y; ++y)
    for (int x = 0; x < sizePx.x; ++x) {
      const auto i = static_cast<size_t>(y * sizePx.x + x);
      EXPECT_EQ(out.classes[i] == 2, x == 13) << x << " " << y;
      if (x == 13) {
        EXPECT_EQ(out.visibility.data[i], 0.25F);
      }
    }
}

TEST_F(SparseVisibility, EveryPixelAskedForIsTheInnerTechniqueBitForBit) {
  const scene::Scene scene = makeScene("two_boxes");
  const glm::ivec2 sizePx(53, 38);
  for (const char* inner : {"backprojection", "bitmask"}) {
    const Rendered full = render(scene, std::string("soft_shadows/") + inner,
                                 withMaps(std::string("soft_shadows/") + inner, 256), sizePx);
    std::map<std::string, Given> cases = {
        {"subset", {{"mode.factor", int64_t{1}}}},
        {"rendered", {{"mode.factor", int64_t{1}}, {"mode.points", std::string("rendered")}}},
        {"adaptive", {{"mode", std::string("adaptive")}, {"mode.coarsest_level", int64_t{0}}}}};
    for (auto& [name, given] : cases) {
      given["inner"] = std::string(inner);
      const Rendered sparse =
          render(scene, "soft_shadows/sparse", withMaps("soft_shadows/sparse", 256, given), sizePx, true);
      EXPECT_EQ(sparse.product.data, full.product.data) << name << " " << inner;
      EXPECT_DOUBLE_EQ(sparse.counter("evaluated_share"), 1.0) << name << " " << inner;
      EXPECT_EQ(sparse.counter("fallback_share"), 0.0) << name << " " << inner;
    }
  }
}

TEST_F(SparseVisibility, AdaptiveSamplesAreTheInnerTechniquesAndOthersLieBetweenThem) {
  const glm::ivec2 sizePx(96, 72);
  const scene::Scene scene = makeScene("half_plane");
  const Given map = withMaps("soft_shadows/backprojection", 256);
  const Rendered full = render(scene, "soft_shadows/backprojection", map, sizePx);
  const Given given = withMaps(
      "soft_shadows/sparse", 256,
      {{"mode", std::string("adaptive")}, {"mode.min_samples", 4.0}, {"mode.coarsest_level", int64_t{2}}});
  const Rendered sparse = render(scene, "soft_shadows/sparse", given, sizePx, true);
  EXPECT_LT(sparse.counter("evaluated_share"), 0.7);
  EXPECT_EQ(sparse.counter("unreached_share"), 0.0);
  int same = 0;
  double worst = 0.0;
  for (int y = 0; y < sizePx.y; ++y)
    for (int x = 0; x < sizePx.x; ++x) {
      const auto i = static_cast<size_t>(y * sizePx.x + x);
      same += sparse.product.data[i] == full.product.data[i];
      worst = std::max(worst, std::abs(double(sparse.product.data[i]) - full.product.data[i]));
      // Three levels of texels up to 8 pixels wide, of which one and its neighbours are read: at most 16
      // pixels away. A mean of what is there lies within its range; rounding of the weights is 8 units.
      constexpr int kReach = 16;
      float low = 1.0F, high = 0.0F;
      for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, sizePx.y - 1); ++v)
        for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, sizePx.x - 1); ++u) {
          const float value = full.product.data[static_cast<size_t>(v * sizePx.x + u)];
          low = std::min(low, value), high = std::max(high, value);
        }
      ASSERT_GE(sparse.product.data[i], low - 1e-6F);
      ASSERT_LE(sparse.product.data[i], high + 1e-6F);
    }
  EXPECT_GE(same,
            static_cast<int>(sparse.counter("evaluated_share") * static_cast<double>(full.product.pixels())));
  // Samples are at most a quarter of the penumbra apart, over which visibility changes by 1/4; the estimate
  // of its width is off by at most the texel that the edge falls into, and coarser levels look twice as far.
  EXPECT_LT(worst, 0.5);
}

TEST_F(SparseVisibility, MoreSamplesAcrossAPenumbraCostMoreAndErrLess) {
  const glm::ivec2 sizePx(96, 72);
  const scene::Scene scene = makeScene("box_under_light");
  const Given map = withMaps("soft_shadows/backprojection", 256);
  const Rendered full = render(scene, "soft_shadows/backprojection", map, sizePx);
  double evaluatedBefore = 0.0, errorBefore = 1.0;
  for (const double samples : {2.0, 8.0, 32.0}) {
    const Given given = withMaps("soft_shadows/sparse", 256,
                                 {{"mode", std::string("adaptive")},
                                  {"mode.min_samples", samples},
                                  {"mode.coarsest_level", int64_t{3}}});
    const Rendered sparse = render(scene, "soft_shadows/sparse", given, sizePx, true);
    double error = 0.0;
    for (size_t i = 0; i < full.product.data.size(); ++i)
      error += std::abs(double(sparse.product.data[i]) - full.product.data[i]);
    const double evaluated = sparse.counter("evaluated_share");
    EXPECT_GT(evaluated, evaluatedBefore) << samples;
    EXPECT_LT(error / static_cast<double>(full.product.pixels()), errorBefore) << samples;
    evaluatedBefore = evaluated, errorBefore = error / static_cast<double>(full.product.pixels());
  }
}

TEST_F(SparseVisibility, ValuesOfTheOtherModeCannotBeWritten) {
  const auto accepted = [](const Given& given) { return !refusal("soft_shadows/sparse", given); };
  EXPECT_TRUE(accepted({}));
  EXPECT_TRUE(accepted({{"mode", std::string("adaptive")}, {"mode.min_samples", 4.0}}));
  EXPECT_FALSE(accepted({{"mode.min_samples", 4.0}}));
  EXPECT_FALSE(accepted({{"mode.coarsest_level", int64_t{1}}}));
  for (const char* name : {"mode.factor", "mode.points", "mode.normal_power"}) {
    const Given defaults = {
        {"mode", std::string("adaptive")},
        {name, *ParameterValues(TechniqueRegistry::instance().get("soft_shadows/sparse").parameters, {})
                    .find(name)}};
    EXPECT_FALSE(accepted(defaults)) << name;
  }
}

}  // namespace
}  // namespace limen::techniques
