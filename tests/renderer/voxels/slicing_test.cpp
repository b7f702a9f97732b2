// SPDX-License-Identifier: BSD-3-Clause
// One triangle at a time through each way of voxelizing along its axis, against a count in double precision.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/part_motion.h"
#include "renderer/scene/shapes.h"
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
      EXPECT_EQ(voxelsOf(scene, "voxelization/slice_lists", {}), expected) << depths.cases;
      EXPECT_EQ(voxelsOf(scene, "voxelization/bit_masks", {{"views", std::string("z")}}), expected)
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
    EXPECT_EQ(voxelsOf(scene, "voxelization/slice_lists", {{"slices", int64_t{slices}}}), expected);
  }
}

// Two large triangles through every slice; at 44.49 degrees they face two axes nearly as much. Along the axis
// that it faces most a floor has one voxel in each column whose middle it covers: a list of slices holds them
// all, what a geometry shader may emit does not.
TEST_F(SlicingTest, ASlantedFloorHasHolesByACapAlone) {
  for (const double degrees : {13.0, 44.0, 44.49, 71.0}) {
    const double angle = glm::radians(degrees);
    const glm::dvec3 middle(0.013), along{std::cos(angle), std::sin(angle), 0.1}, across{0.02, -0.1, 1.0};
    scene::Scene scene;
    scene::addPart(scene, "floor", scene::card(middle, along, across), glm::vec3(0.5F));
    const voxels::VoxelGrid grid = voxels::tightGrid(scene.bounds(), 96);
    const int facing = degrees < 45.0 ? 1 : 0, u = (facing + 1) % 3, v = (facing + 2) % 3;
    int covered = 0, close = 0;
    for (int y = 0; y < grid.resolution[v]; ++y)
      for (int x = 0; x < grid.resolution[u]; ++x) {
        // In shares of the two half sides: within 1 of the middle.
        const glm::dvec2 at = grid.voxelSize * (glm::dvec2(x, y) + 0.5) +
                              glm::dvec2(grid.origin[u] - middle[u], grid.origin[v] - middle[v]);
        const double whole = along[u] * across[v] - along[v] * across[u];
        const double s = (at.x * across[v] - at.y * across[u]) / whole,
                     t = (along[u] * at.y - along[v] * at.x) / whole;
        const double most = std::max(std::abs(s), std::abs(t));
        covered += most < 1.0;
        close += std::abs(most - 1.0) < 1e-4;
      }
    const auto voxelsBy = [&](const char* technique, Given given) {
      given["resolution"] = int64_t{96};
      return render(scene, technique, given, {16, 16}, true).counter("voxels");
    };
    EXPECT_LE(close, 2) << "no sound test";
    EXPECT_GT(covered, 5000);
    EXPECT_NEAR(voxelsBy("voxelization/slice_lists", {}), covered, close) << degrees;
    EXPECT_LT(voxelsBy("voxelization/pixel_clip", {{"vertices", int64_t{15}}}), 0.5 * covered) << degrees;
  }
}

// Everything drawn for each slice, or three masks of bits, are three rasterisations of everything: within 0.2
// %, for what a rasteriser's 8 bits of a pixel decide, what one pass over all middle lines finds.
TEST_F(SlicingTest, ThreeViewsAreTheThinSet) {
  const scene::Scene scene = makeScene("sphere_grid");
  const Given at40 = {{"resolution", int64_t{40}}};
  const double thin = render(scene, "voxelization/image_store", at40, {16, 16}, true).counter("voxels");
  for (const char* technique : {"voxelization/slice_passes", "voxelization/bit_masks"}) {
    const Rendered rendered = render(scene, technique, at40, {16, 16}, true);
    EXPECT_NEAR(rendered.counter("voxels"), thin, 0.002 * thin) << technique;
    EXPECT_EQ(rendered.counter("extra_voxels"), 0.0) << technique;
    EXPECT_LT(rendered.counter("hole_voxels"), 0.002 * thin) << technique;
  }
}

// Every face in a plane between two voxels: in the one behind it, or in the last one. Of the frame that are
// 16^3
// - 14^3 voxels; of the block, whose faces have 4 x 8, 6 x 8 and 6 x 4 voxels, twice as many each, less those
// that two or three faces on its low sides share: 2 (32 + 48 + 24) - (8 + 4 + 6) + 1. By conservative
// coverage it is in both: of the block 8 x 6 x 10 voxels less the 4 x 2 x 6 within that it does not touch.
TEST_F(SlicingTest, AFaceBetweenTwoSlicesIsInOneOfThem) {
  scene::Scene scene;
  scene::addPart(scene, "frame", scene::box(glm::dvec3(0.0), glm::dvec3(16.0)), glm::vec3(0.5F));
  scene::addPart(scene, "block", scene::box({4.0, 4.0, 6.0}, {10.0, 8.0, 14.0}), glm::vec3(0.5F));
  const Given full{{"vertices", int64_t{128}}};
  for (const auto& [technique, given] : {std::pair<const char*, Given>{"slicing", full},
                                         {"pixel_clip", full},
                                         {"slice_passes", {}},
                                         {"slice_lists", {}},
                                         {"bit_masks", {{"views", std::string("all")}}},
                                         {"binned", {}},
                                         {"image_store", {{"coverage", std::string("dominant")}}},
                                         {"image_store", {{"coverage", std::string("thin")}}}})
    EXPECT_EQ(voxelsOf(scene, (std::string("voxelization/") + technique).c_str(), given), 1352 + 191)
        << technique;
  Given conservative = full;
  conservative["coverage"] = std::string("conservative");
  EXPECT_EQ(voxelsOf(scene, "voxelization/slicing", conservative), 1352 + 432);
  EXPECT_EQ(voxelsOf(scene, "voxelization/pixel_clip", conservative), 1352 + 432);
  EXPECT_EQ(voxelsOf(scene, "voxelization/image_store", {{"coverage", std::string("conservative")}}),
            1352 + 432);
}

// Among 512 voxels, where the ends of slices are rounded: no column of a large triangle that passes through
// 39 slices is in no slice or in two. Only what lies within a hundredth of a voxel of its border is
// undecided.
TEST_F(SlicingTest, SlicesOf512VoxelsHaveNoGapsOrDoubles) {
  const glm::dvec3 corners[3] = {{0.0, 30.13, 0.0}, {512.0, 150.71, 17.37}, {233.3, 408.77, 28.83}};
  scene::Mesh mesh;
  mesh.positions.assign(corners, corners + 3);
  mesh.triangles.emplace_back(0, 1, 2);
  scene::Scene scene;
  scene::addPart(scene, "triangle", mesh, glm::vec3(0.5F));
  const voxels::VoxelGrid grid = voxels::tightGrid(scene.bounds(), 512);
  glm::dvec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = glm::dvec2(grid.toVoxels(corners[i]));
  int covered = 0, close = 0;
  for (int y = 0; y < grid.resolution.y; ++y)
    for (int x = 0; x < 512; ++x) {
      double inside = 1e9;
      for (int i = 0; i < 3; ++i) {
        const glm::dvec2 edge = p[(i + 1) % 3] - p[i];
        inside = std::min(
            inside, glm::dot(glm::dvec2(x, y) + 0.5 - p[i], glm::normalize(glm::dvec2(-edge.y, edge.x))));
      }
      covered += inside > 0.0;
      close += std::abs(inside) < 0.01;
    }
  EXPECT_GT(covered, 70000);
  EXPECT_LT(close, 60);
  const auto found = [&](const char* technique, Given given) {
    given["resolution"] = int64_t{512};
    const Rendered rendered = render(scene, technique, given, {16, 16}, true);
    EXPECT_EQ(rendered.counter("extra_voxels"), 0.0) << technique;
    return rendered.counter("voxels");
  };
  EXPECT_NEAR(found("voxelization/pixel_clip", {{"vertices", int64_t{128}}}), covered, close);
  EXPECT_NEAR(found("voxelization/slicing", {{"vertices", int64_t{128}}}), covered, close);
  EXPECT_NEAR(found("voxelization/slice_lists", {}), covered, close);
  EXPECT_NEAR(found("voxelization/image_store", {{"coverage", std::string("dominant")}}), covered, close);
}

// Bricks that share a grid of odd sizes, and triangles of a few and of hundreds of bricks.
TEST_F(SlicingTest, BricksHoldTheThinSet) {
  for (const char* name : {"sphere_grid", "cornell_box", "foliage", "degenerate_soup"})
    for (const int side : {1, 37, 90}) {
      const scene::Scene scene = makeScene(name);
      const Rendered binned =
          render(scene, "voxelization/binned", {{"resolution", int64_t{side}}}, {16, 16}, true);
      EXPECT_EQ(binned.counter("extra_voxels"), 0.0) << name;
      EXPECT_EQ(binned.counter("hole_voxels"), 0.0) << name;
      EXPECT_EQ(binned.counter("pairs_lost"), 0.0) << name;
      EXPECT_GT(binned.counter("voxels"), 0.0) << name;
    }
}

class VoxelsInMotion : public TechniqueTest {
 protected:
  /// A box that turns and travels past one that rests.
  static scene::Scene movingBoxes() {
    scene::Scene scene;
    scene::addPart(scene, "rests", scene::box({-0.6, 0.0, 0.1}, {0.3, 0.5, 0.2}),
                   glm::vec3(0.8F, 0.2F, 0.1F));
    scene::addPart(scene, "moves", scene::box({0.2, 0.1, -0.1}, {0.5, 0.45, 0.3}),
                   glm::vec3(0.1F, 0.3F, 0.9F));
    scene::addPart(scene, "rests_too", scene::sphere({0.4, -0.5, 0.0}, 0.25, 12), glm::vec3(0.4F));
    scene::PartMotion motion;
    motion.part = 1;
    motion.pivot = {0.5, 0.1, -0.1};
    motion.turnDegS = 37.0;
    motion.travel = {0.9, 0.1, 0.0};
    motion.periodS = 4.0;
    scene.motions.push_back(motion);
    return scene;
  }

  struct Shown {
    Image picture;
    double voxels, missing, extra;
    double resting;
  };
  /// Frames at these times by one instance of a technique.
  static std::vector<Shown> film(const scene::Scene& scene, const char* technique, Given given,
                                 const std::vector<double>& timesS) {
    given["resolution"] = int64_t{32};
    const TechniqueInfo& info = TechniqueRegistry::instance().get(technique);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {32, 24});
    const auto made = info.make(ParameterValues(info.parameters, given));
    made->prepare(frame);
    std::vector<Shown> out;
    for (const double timeS : timesS) {
      frame.setTime(timeS);
      frame.begin();
      made->render(frame);
      frame.end();
      Rendered counted;
      counted.counters = made->count(frame);
      double resting = 0.0;
      for (const Counter& counter : counted.counters)
        if (counter.name == "resting_fills") resting = counter.value;
      out.push_back({made->product().read(), counted.counter("voxels"), counted.counter("missing_voxels"),
                     counted.counter("extra_voxels"), resting});
    }
    return out;
  }
};

// What rests is filled once, and every picture is that of all at once, to the last bit.
TEST_F(VoxelsInMotion, ASplitVolumeShowsTheSame) {
  const scene::Scene scene = movingBoxes();
  const std::vector<double> times = {0.0, 0.4, 1.3, 0.4};
  for (const char* attributes : {"none", "surface"}) {
    const std::vector<Shown> whole =
        film(scene, "voxelization/image_store", {{"attributes", std::string(attributes)}}, times);
    const std::vector<Shown> split = film(scene, "voxelization/image_store",
                                          {{"attributes", std::string(attributes)}, {"split", true}}, times);
    for (size_t i = 0; i < times.size(); ++i) {
      EXPECT_EQ(split[i].picture.data, whole[i].picture.data) << attributes << " " << i;
      EXPECT_EQ(split[i].voxels, whole[i].voxels);
      EXPECT_EQ(split[i].extra, 0.0);
      EXPECT_EQ(split[i].resting, 1.0);
    }
    EXPECT_NE(whole[0].picture.data, whole[2].picture.data);
  }
}

// An axis a frame: after a jump stale voxels remain for two frames, and none in the third.
TEST_F(VoxelsInMotion, AxesInTurnAreCompleteAfterThreeFrames) {
  const scene::Scene scene = movingBoxes();
  const std::vector<double> times = {0.0, 0.0, 0.0, 1.3, 1.3, 1.3};
  for (const char* technique :
       {"voxelization/slicing", "voxelization/pixel_clip", "voxelization/slice_passes"}) {
    Given given;
    if (std::string(technique) != "voxelization/slice_passes") given["vertices"] = int64_t{128};
    const std::vector<Shown> all = film(scene, technique, given, times);
    given["refresh"] = std::string("one");
    const std::vector<Shown> inTurn = film(scene, technique, given, times);
    for (const size_t complete : {0, 1, 2, 5})
      EXPECT_EQ(inTurn[complete].picture.data, all[complete].picture.data);
    EXPECT_GT(inTurn[3].extra, 0.0) << technique;
    EXPECT_GT(inTurn[4].extra, 0.0) << technique;
    EXPECT_EQ(inTurn[5].extra, 0.0) << technique;
    EXPECT_EQ(inTurn[5].voxels, all[5].voxels) << technique;
    EXPECT_EQ(all[3].extra, 0.0);
  }
}

}  // namespace
}  // namespace limen::techniques
