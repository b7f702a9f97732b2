// SPDX-License-Identifier: BSD-3-Clause
// One triangle at a time through each way of voxelizing along its axis, against a count in double precision.
#include "renderer/scene/stage.h"
#include "renderer/voxels/voxel_grid.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class SlicingTest : public TechniqueTest {
 protected:
  /// A triangle that faces along z most, of slopes below 1, in a grid of 16 voxels along x; `middle`: depth
  /// of its middle vertex, `deepest`: of its last, in voxels. `order`: which vertex comes first.
  static scene::Scene oneTriangle(double middle, double deepest, int order) {
    const glm::dvec3 corners[3] = {{0.0, 1.13, 0.0}, {16.0, 4.71, middle}, {7.3, 12.77, deepest}};
    scene::Mesh mesh;
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(corners[(order + i) % 3]);
    mesh.triangles.emplace_back(0, 1, 2);
    scene::Scene scene;
    scene::addPart(scene, "triangle", mesh, glm::vec3(0.5F));
    return scene;
  }

  /// Columns whose middles the triangle covers in slices below `slices`. None lies within a hundredth of a
  /// voxel of a border or of the end of a slice, farther than a rasteriser's 8 bits of a pixel.
  static int columnsOf(const scene::Scene& scene, int slices) {
    const voxels::VoxelGrid grid = voxels::tightGrid(scene.bounds(), 16);
    glm::dvec3 p[3];
    for (int i = 0; i < 3; ++i) p[i] = grid.toVoxels(scene.mesh.positions[static_cast<size_t>(i)]);
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    int count = 0;
    for (int y = 0; y < grid.resolution.y; ++y)
      for (int x = 0; x < grid.resolution.x; ++x) {
        const glm::dvec2 at{x + 0.5, y + 0.5};
        double inside = 1e9;
        for (int i = 0; i < 3; ++i) {
          const glm::dvec2 a(p[i]), edge = glm::dvec2(p[(i + 1) % 3]) - a;
          const glm::dvec2 inwards =
              glm::normalize(glm::dvec2(-edge.y, edge.x)) * (normal.z < 0.0 ? -1.0 : 1.0);
          inside = std::min(inside, glm::dot(at - a, inwards));
        }
        EXPECT_GT(std::abs(inside), 0.01) << "no sound test: " << x << ", " << y;
        if (inside < 0.0) continue;
        const double depth = p[0].z - (normal.x * (at.x - p[0].x) + normal.y * (at.y - p[0].y)) / normal.z;
        EXPECT_GT(std::min(depth - std::floor(depth), std::ceil(depth) - depth), 1e-4);
        if (depth < slices) ++count;
      }
    return count;
  }

  static double voxelsOf(const scene::Scene& scene, const char* technique, Given given) {
    given["resolution"] = int64_t{16};
    return render(scene, technique, given, {16, 16}, true).counter("voxels");
  }
};

/// Depths of the middle and the last vertex that lead through the cases of algorithm 5.
struct Depths {
  const char* cases;
  double middle, deepest;
};
constexpr Depths kDepths[] = {{"A", 0.31, 0.93},
                              {"start beyond, C", 1.43, 1.83},
                              {"start inside, D", 0.43, 1.87},
                              {"B, C", 4.37, 4.83},
                              {"E, D", 0.37, 4.87},
                              {"B, F, E, D", 2.41, 4.79},
                              {"F, D", 1.39, 2.81}};

TEST_F(SlicingTest, EachCaseFillsTheTrianglesColumns) {
  for (const Depths& depths : kDepths)
    for (int order = 0; order < 3; ++order) {
      const scene::Scene scene = oneTriangle(depths.middle, depths.deepest, order);
      const int expected = columnsOf(scene, 100);
      EXPECT_GT(expected, 50);
      EXPECT_EQ(voxelsOf(scene, "voxelization/slicing", {{"vertices", int64_t{128}}}), expected)
          << depths.cases;
      EXPECT_EQ(voxelsOf(scene, "voxelization/pixel_clip", {{"vertices", int64_t{128}}}), expected)
          << depths.cases;
      EXPECT_EQ(voxelsOf(scene, "voxelization/image_store", {{"coverage", std::string("dominant")}}),
                expected)
          << depths.cases;
    }
}

// Three vertices of clipped triangles serve a slice. Cut into slices, a triangle whose tip is its first slice
// takes 3 and then 4 a slice.
TEST_F(SlicingTest, ACapLosesTheSlicesBeyondIt) {
  const scene::Scene scene = oneTriangle(4.37, 4.83, 0);
  for (int slices = 1; slices <= 5; ++slices) {
    const int expected = columnsOf(scene, slices);
    EXPECT_EQ(voxelsOf(scene, "voxelization/pixel_clip", {{"vertices", int64_t{3} * slices}}), expected);
    EXPECT_EQ(voxelsOf(scene, "voxelization/slicing", {{"vertices", int64_t{4} * slices - 1}}), expected);
  }
}

}  // namespace
}  // namespace limen::techniques
