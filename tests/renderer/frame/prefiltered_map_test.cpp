// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/prefiltered_map.h"

#include <cmath>

#include "renderer/frame/occlusion_slices.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

class PrefilteredMapTest : public gl::GlTest {};

TEST_F(PrefilteredMapTest, DeepestIsTheFarthestPointThatTheFrustumSees) {
  // The light looks straight down from 2 m on a ground that reaches much farther than the map.
  for (const char* name : {"parallel_rectangle", "half_plane", "card_stack"}) {
    const scene::Scene scene = builtScene(name);
    EXPECT_NEAR(deepestSeen(scene, LightCasters(scene).fit({}, 64)), 2.0, 1e-12) << name;
  }
  // A slanted light: rays through a fine grid over the frustum, its corners included.
  const scene::Scene scene = builtScene("pole");
  const LightFrustum frustum = LightCasters(scene).fit({}, 64);
  const BruteForce rays(scene, scene.lights[0].centre);
  const glm::dmat3 fromLight(glm::inverse(scene.lights[0].toLightSpace()));
  double farthest = 0.0;
  constexpr int kCells = 16;
  for (int y = 0; y <= kCells; ++y)
    for (int x = 0; x <= kCells; ++x) {
      const glm::dvec2 at = frustum.low + (frustum.high - frustum.low) * (glm::dvec2(x, y) / double(kCells));
      // The direction's z is 1: a distance along it is a depth. Vertices are floats: nearly the same ground.
      const Hit hit = rays.trace(glm::dvec3(0.0), fromLight * glm::dvec3(at, 1.0), frustum.near);
      if (std::isfinite(hit.t)) farthest = std::max(farthest, hit.t);
    }
  const double deepest = deepestSeen(scene, frustum);
  EXPECT_GE(deepest, farthest * (1.0 - 1e-6));
  // The ground is a plane, so the farthest point is at a corner, unless the ground ends before it.
  EXPECT_LE(deepest, farthest * 1.1);
}

TEST_F(PrefilteredMapTest, EveryLevelOfThePyramidAveragesTheFirst) {
  const scene::Scene scene = builtScene("sphere_grid");
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  frame.begin();
  constexpr int kSide = 32;
  PrefilterSettings settings{{kSide}};
  settings.prefilter = Prefilter::Mips;
  const auto& made = frame.get<PrefilteredMap>(settings);
  const Image map = frame.get<ShadowMap>(settings.map).texture().read();
  const double near = made.frustum().near, range = made.deepest() - near;
  for (int level = 0; level <= 5; ++level) {
    const Image averages = made.texture().readLayer(0, level);
    const int side = kSide >> level, cell = 1 << level;
    ASSERT_EQ(averages.width, side);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        glm::dvec2 moments(0.0);
        for (int j = 0; j < cell; ++j)
          for (int i = 0; i < cell; ++i) {
            const double d = std::clamp((map.at(x * cell + i, y * cell + j) - near) / range, 0.0, 1.0);
            moments += glm::dvec2(d, d * d) / double(cell * cell);
          }
        // Depth, scale and near plane are floats, 2^-24 each of numbers up to 3, and five levels of averages
        // add half a unit each.
        ASSERT_NEAR(averages.at(x, y, 0), moments.x, 2e-6) << level;
        ASSERT_NEAR(averages.at(x, y, 1), moments.y, 4e-6) << level;
      }
  }
  frame.end();
}

TEST_F(PrefilteredMapTest, SlicesHoldWhatLiesBetweenTheirPlanes) {
  // Rays through texels' centres, through everything, in double precision, against the bits of one raster
  // pass. Texels that an edge passes within the rasteriser's snapping, or where a hit lies at a plane between
  // slices, may go either way: rays around the centre say where.
  const scene::Scene scene = builtScene("two_boxes");
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, {8, 8});
  frame.begin();
  constexpr int kSide = 32, kSlices = 5;
  const auto& slices = frame.get<OcclusionSlices>(OcclusionSliceSettings{kSide, kSlices, Prefilter::Sums});
  const std::vector<uint32_t> bits = slices.bits().readUint();
  frame.end();
  const LightFrustum& frustum = slices.frustum();
  const glm::dvec3 light = scene.lights[0].centre;
  const BruteForce rays(scene, light);
  const glm::dmat3 fromLight(glm::inverse(scene.lights[0].toLightSpace()));
  const auto bitsAlong = [&](glm::dvec2 texel, double slack) {
    uint32_t found = 0;
    const glm::dvec3 direction =
        fromLight * glm::dvec3(frustum.low + (frustum.high - frustum.low) * (texel / double(kSide)), 1.0);
    double from = frustum.near;
    for (Hit hit = rays.trace(glm::dvec3(0.0), direction, from); std::isfinite(hit.t);
         hit = rays.trace(glm::dvec3(0.0), direction, from)) {
      const double slice = (hit.t - slices.begin()) / slices.depth() + slack;
      if (slice < kSlices) found |= 1U << static_cast<unsigned>(std::max(slice, 0.0));
      from = hit.t * (1.0 + 1e-12);
    }
    return found;
  };
  int compared = 0, covered = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      const uint32_t expected = bitsAlong(centre, 0.0);
      bool certain = bitsAlong(centre, 1e-4) == expected && bitsAlong(centre, -1e-4) == expected;
      for (const glm::dvec2& offset : snappingOffsets())
        certain = certain && bitsAlong(centre + offset, 0.0) == expected;
      if (!certain) continue;
      ++compared;
      covered += expected != 0 ? 1 : 0;
      EXPECT_EQ(bits[static_cast<size_t>(y * kSide + x)], expected) << x << ' ' << y;
    }
  EXPECT_GT(compared, kSide * kSide * 3 / 4);
  EXPECT_GT(covered, kSide * kSide / 3);
}

}  // namespace
}  // namespace limen::frame
