// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/hausdorff.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/voxels/exact_voxels.h"

namespace limen::voxels {
namespace {

// A square in the middle of a layer of voxels: middles at heights 0.5, 1.5 and 2.5 voxels from it.
TEST(Hausdorff, DistancesOfLayersToAPlaneAreTheirHeights) {
  VoxelGrid grid;
  grid.voxelSize = 0.25;
  grid.resolution = {16, 16, 8};
  const scene::Mesh square = scene::card({2.0, 2.0, 0.5}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0});
  std::vector<uint8_t> occupied(static_cast<size_t>(grid.count()));
  const auto fill = [&](int z) {
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) occupied[static_cast<size_t>(grid.indexOf({x, y, z}))] = 1;
  };
  fill(2);
  const HausdorffDistances one = hausdorff(square, grid, occupied, 50000);
  EXPECT_NEAR(one.fromVoxels.largest, 0.125, 1e-12);
  EXPECT_NEAR(one.fromVoxels.mean, 0.125, 1e-12);
  // From a point of the square to the nearest middle: half a voxel up, and beside it what a point in a unit
  // square is from its middle, at most sqrt(1/2) voxels.
  EXPECT_NEAR(one.fromSurface.largest, 0.25 * std::sqrt(0.75), 0.002);
  double mean = 0.0, squares = 0.0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = (i + 0.5) / kSteps - 0.5, y = (j + 0.5) / kSteps - 0.5,
                   d2 = 0.0625 * (x * x + y * y + 0.25);
      mean += std::sqrt(d2) / (kSteps * kSteps), squares += d2 / (kSteps * kSteps);
    }
  EXPECT_NEAR(one.fromSurface.mean, mean, 2e-4);
  EXPECT_NEAR(one.fromSurface.rms, std::sqrt(squares), 2e-4);
  fill(4);
  const HausdorffDistances two = hausdorff(square, grid, occupied);
  EXPECT_NEAR(two.fromVoxels.largest, 0.625, 1e-12);
  EXPECT_NEAR(two.fromVoxels.mean, 0.5 * (0.125 + 0.625), 1e-12);
  EXPECT_NEAR(two.fromVoxels.rms, std::sqrt(0.5 * (0.125 * 0.125 + 0.625 * 0.625)), 1e-12);
  EXPECT_EQ(two.largest(), two.fromVoxels.largest);
}

// Against all pairs, of a ball and an arbitrary set of voxels.
TEST(Hausdorff, AgreesWithAllPairs) {
  const scene::Mesh ball = scene::sphere({0.1, 0.0, -0.1}, 0.7, 6);
  scene::Bounds bounds;
  for (const glm::dvec3& p : ball.positions) bounds.extend(p);
  const VoxelGrid grid = tightGrid(bounds, 12);
  scene::Random random(5);
  std::vector<uint8_t> occupied(static_cast<size_t>(grid.count()));
  for (uint8_t& voxel : occupied) voxel = random.uniform(0.0, 1.0) < 0.03;
  double largest = 0.0, sum = 0.0;
  int64_t count = 0;
  glm::ivec3 v;
  for (v.z = 0; v.z < grid.resolution.z; ++v.z)
    for (v.y = 0; v.y < grid.resolution.y; ++v.y)
      for (v.x = 0; v.x < grid.resolution.x; ++v.x) {
        if (!occupied[static_cast<size_t>(grid.indexOf(v))]) continue;
        double nearest = 1e9;
        for (const glm::uvec3& t : ball.triangles) {
          // A fine choice of points of the triangle stands in for it.
          constexpr int kFine = 60;
          for (int i = 0; i <= kFine; ++i)
            for (int j = 0; i + j <= kFine; ++j) {
              const double a = double(i) / kFine, b = double(j) / kFine;
              const glm::dvec3 p =
                  a * ball.positions[t.x] + b * ball.positions[t.y] + (1.0 - a - b) * ball.positions[t.z];
              nearest = std::min(nearest, glm::length(p - grid.centre(v)));
            }
        }
        largest = std::max(largest, nearest), sum += nearest, ++count;
      }
  const HausdorffDistances found = hausdorff(ball, grid, occupied);
  // Points of a triangle with sides of 0.2 lie within 0.2 / 60 of the fine ones.
  EXPECT_NEAR(found.fromVoxels.largest, largest, 0.0034);
  EXPECT_NEAR(found.fromVoxels.mean, sum / double(count), 0.0034);
}

TEST(Hausdorff, NothingIsInfinitelyFar) {
  VoxelGrid grid;
  grid.resolution = glm::ivec3(4);
  const scene::Mesh square = scene::card(glm::dvec3(2.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  EXPECT_TRUE(std::isinf(hausdorff(square, grid, std::vector<uint8_t>(64)).largest()));
  EXPECT_EQ(hausdorff({}, grid, std::vector<uint8_t>(64)).largest(), 0.0);
}

}  // namespace
}  // namespace limen::voxels
