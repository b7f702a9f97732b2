// SPDX-License-Identifier: BSD-3-Clause
// The single-pass voxelizer against exact sets in double precision.
#include "renderer/voxels/voxelizer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/voxels/exact_voxels.h"
#include "renderer/voxels/voxel_bindings.h"
#include "tests/renderer/voxels/triangle_soup.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::voxels {
namespace {

class VoxelizerTest : public VoxelizerFixture {};

// Positions on the GPU are floats, and its tests allow for kVoxelSlack, both ways and where a plane is cut:
// what it adds lies within four of them of the mesh, what it lacks within two of the ends of a middle line.
const double kNear = 4.0 * kVoxelSlack, kEnds = 2.0 * kVoxelSlack;

TEST_F(VoxelizerTest, CoversASoupAsExactSetsSay) {
  for (const int64_t seed : {1, 2, 3}) {
    const scene::Scene scene = soup(seed);
    const VoxelGrid grid = tightGrid(scene.bounds(), 48);
    const std::vector<uint8_t> exact = exactVoxels(scene.mesh, grid);
    const std::vector<uint8_t> conservative = voxelize(scene, grid, Coverage::Conservative);
    EXPECT_EQ(compare(conservative, exact).missing, 0);
    EXPECT_EQ(beyond(conservative, scene.mesh, grid, kNear), 0);
    const std::vector<uint8_t> thin = voxelize(scene, grid, Coverage::Thin);
    EXPECT_EQ(compare(thin, separatingVoxels(scene.mesh, grid, kEnds)).missing, 0);
    EXPECT_EQ(beyond(thin, scene.mesh, grid, kNear), 0);
    EXPECT_EQ(compare(thin, conservative).extra, 0);
    const std::vector<uint8_t> dominant = voxelize(scene, grid, Coverage::Dominant);
    EXPECT_EQ(compare(dominant, thin).extra, 0);
    EXPECT_GT(countOf(dominant), countOf(exact) / 4);
    EXPECT_GT(countOf(exact), countOf(thin));
  }
}

// Far from the origin, where doubles still tell positions of a voxel apart but floats would not, and for
// grids of any size of voxel: the sets are those of the scene at rest, but for what lies within rounding.
TEST_F(VoxelizerTest, PlaceAndScaleDoNotMatter) {
  for (const double scale : {1e-4, 1.0, 1e4})
    for (const double offset : {0.0, 1e6}) {
      scene::Scene scene = soup(4);
      for (glm::dvec3& position : scene.mesh.positions) position = scale * (position + offset);
      const VoxelGrid grid = tightGrid(scene.bounds(), 40);
      const std::vector<uint8_t> conservative = voxelize(scene, grid, Coverage::Conservative);
      EXPECT_EQ(compare(conservative, exactVoxels(scene.mesh, grid)).missing, 0) << scale << " " << offset;
      EXPECT_EQ(beyond(conservative, scene.mesh, grid, kNear), 0) << scale << " " << offset;
      const std::vector<uint8_t> thin = voxelize(scene, grid, Coverage::Thin);
      EXPECT_EQ(compare(thin, separatingVoxels(scene.mesh, grid, kEnds)).missing, 0)
          << scale << " " << offset;
      EXPECT_EQ(beyond(thin, scene.mesh, grid, kNear), 0) << scale << " " << offset;
    }
}

// Triangles of a sphere whose normals have equal components keep their axes, and so their voxels, at any size
// and place. The bounds are off the sphere, so that no border of a voxel touches it.
TEST_F(VoxelizerTest, EqualComponentsDoNotTakeTurns) {
  std::vector<uint8_t> first;
  for (const double scale : {1.0, 1e-4, 0.37, 1e4})
    for (const double offset : {0.0, 777.7}) {
      scene::Scene scene;
      scene::Mesh mesh = scene::sphere(glm::dvec3(0.0), 1.0, 24);
      for (glm::dvec3& position : mesh.positions) position = scale * (position + offset);
      scene::addPart(scene, "sphere", mesh, glm::vec3(0.5F));
      VoxelGrid grid;
      grid.resolution = glm::ivec3(31, 33, 35);
      grid.voxelSize = scale * 0.0713;
      grid.origin = scale * (glm::dvec3(-1.093, -1.157, -1.219) + offset);
      const std::vector<uint8_t> now = voxelize(scene, grid, Coverage::Dominant);
      EXPECT_GT(countOf(now), 1000);
      if (first.empty()) first = now;
      EXPECT_EQ(compare(now, first).missing + compare(now, first).extra, 0) << scale << " " << offset;
    }
}

// A triangle of a hundredth of a voxel between all middle lines is in no thin set, and in the conservative
// one in its own voxel only.
TEST_F(VoxelizerTest, TinyTrianglesAreKeptByTheConservativeSetAlone) {
  scene::Scene scene;
  scene::Mesh mesh;
  mesh.positions = {{2.2, 3.3, 1.2}, {2.21, 3.3, 1.2}, {2.2, 3.31, 1.21}};
  mesh.triangles = {{0, 1, 2}};
  scene::addPart(scene, "speck", mesh, glm::vec3(0.5F));
  VoxelGrid grid;
  grid.resolution = glm::ivec3(5);
  EXPECT_EQ(countOf(voxelize(scene, grid, Coverage::Thin)), 0);
  const std::vector<uint8_t> conservative = voxelize(scene, grid, Coverage::Conservative);
  EXPECT_EQ(countOf(conservative), 1);
  EXPECT_EQ(conservative[static_cast<size_t>(grid.indexOf({2, 3, 1}))], 1);
}

/// Whether a path of empty voxels, face to face, leads from one voxel to another.
bool leadsTo(const std::vector<uint8_t>& occupied, const VoxelGrid& grid, glm::ivec3 from, glm::ivec3 to) {
  std::vector<uint8_t> seen = occupied;
  std::vector<glm::ivec3> open = {from};
  while (!open.empty()) {
    const glm::ivec3 at = open.back();
    open.pop_back();
    if (at == to) return true;
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        glm::ivec3 next = at;
        next[axis] += step;
        if (!grid.contains(next) || seen[static_cast<size_t>(grid.indexOf(next))]) continue;
        seen[static_cast<size_t>(grid.indexOf(next))] = 1;
        open.push_back(next);
      }
  }
  return false;
}

// Nothing leaks through a floor at any slant, nor out of a closed ball.
TEST_F(VoxelizerTest, LeavesNoHoles) {
  VoxelGrid grid;
  grid.origin = glm::dvec3(-1.0);
  grid.resolution = glm::ivec3(40, 37, 33);
  grid.voxelSize = 0.05;
  for (const double degrees : {0.0, 13.0, 44.0, 45.0, 46.0, 71.0, 90.0}) {
    const double angle = glm::radians(degrees);
    scene::Scene scene;
    const glm::dvec3 middle = 0.5 * (grid.origin + grid.high()) + 0.013;
    scene::addPart(scene, "floor",
                   scene::card(middle, 3.0 * glm::dvec3(std::cos(angle), std::sin(angle), 0.1),
                               3.0 * glm::dvec3(0.02, -0.1, 1.0)),
                   glm::vec3(0.5F));
    // On either side of the floor, along its normal from the middle.
    const glm::dvec3 up = 0.6 * glm::dvec3(-std::sin(angle), std::cos(angle), 0.0);
    const glm::ivec3 above(glm::floor(grid.toVoxels(middle + up))),
        below(glm::floor(grid.toVoxels(middle - up)));
    for (const Coverage coverage : {Coverage::Dominant, Coverage::Thin, Coverage::Conservative})
      EXPECT_FALSE(leadsTo(voxelize(scene, grid, coverage), grid, above, below)) << degrees;
  }
  scene::Scene ball;
  scene::addPart(ball, "ball", scene::sphere(glm::dvec3(-0.05, 0.0, -0.2), 0.6, 24), glm::vec3(0.5F));
  for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    EXPECT_FALSE(leadsTo(voxelize(ball, grid, coverage), grid, {0, 0, 0}, {19, 20, 16}));
}

// Nor through floors of nearly 45 degrees in a grid of many voxels: along an axis that the floor faces a
// little less than another, its columns are more than a voxel apart, and one voxel in between would be left
// out.
TEST_F(VoxelizerTest, LeavesNoHolesInFloorsOfNearly45Degrees) {
  VoxelGrid grid;
  grid.resolution = glm::ivec3(320, 2, 320);
  for (const double less : {1.0 / 512.0, 1.0 / 1100.0, 1.0 / 2048.0, 1.0 / 5000.0})
    for (const double offset : {0.26, 0.49, 0.61, 0.87}) {
      const glm::dvec3 middle(160.0 + offset, 1.0, 160.0), along(1.0, 0.0, 1.0 - less);
      scene::Scene scene;
      scene::addPart(scene, "floor", scene::card(middle, 400.0 * along, {0.0, 9.0, 0.0}), glm::vec3(0.5F));
      for (const Coverage coverage : {Coverage::Dominant, Coverage::Thin})
        EXPECT_FALSE(leadsTo(voxelize(scene, grid, coverage), grid, {300, 0, 20}, {20, 0, 300}))
            << less << " " << offset << " " << toText(coverage);
    }
}

// Whether few triangles share all groups or each is one invocation's: a box, alone and among many small balls
// elsewhere.
TEST_F(VoxelizerTest, SharingChangesNothing) {
  scene::Scene alone, among;
  const scene::Mesh box = scene::box({-0.91, -0.83, -0.77}, {0.07, 0.19, 0.11});
  scene::addPart(alone, "box", box, glm::vec3(0.5F));
  scene::addPart(among, "box", box, glm::vec3(0.5F));
  scene::addPart(among, "ball", scene::sphere(glm::dvec3(0.7), 0.2, 64), glm::vec3(0.5F));
  const VoxelGrid grid = tightGrid(among.bounds(), 64);
  const auto few = voxelize(alone, grid, Coverage::Conservative),
             many = voxelize(among, grid, Coverage::Conservative);
  EXPECT_EQ(compare(many, few).missing, 0);
  for (int x = 0; x < 32; ++x)
    EXPECT_EQ(few[static_cast<size_t>(grid.indexOf({x, 20, 20}))],
              many[static_cast<size_t>(grid.indexOf({x, 20, 20}))]);
}

TEST_F(VoxelizerTest, TriangleThatIsNotFiniteIsLeftOut) {
  scene::Scene scene;
  scene::Mesh mesh = scene::box(glm::dvec3(-0.4), glm::dvec3(0.3));
  const std::vector<glm::uvec3> sound = mesh.triangles;
  mesh.positions.emplace_back(NAN, 0.0, 0.0);
  mesh.positions.emplace_back(0.0, INFINITY, 0.0);
  mesh.triangles.emplace_back(0, 1, mesh.positions.size() - 1);
  mesh.triangles.emplace_back(0, 1, mesh.positions.size() - 2);
  scene::addPart(scene, "box", mesh, glm::vec3(0.5F));
  VoxelGrid grid;
  grid.origin = glm::dvec3(-0.5);
  grid.voxelSize = 1.0 / 16.3;
  grid.resolution = glm::ivec3(17);
  for (const Coverage coverage : {Coverage::Dominant, Coverage::Thin, Coverage::Conservative})
    EXPECT_EQ(
        beyond(voxelize(scene, grid, coverage), scene::box(glm::dvec3(-0.4), glm::dvec3(0.3)), grid, kNear),
        0);
}

}  // namespace
}  // namespace limen::voxels
