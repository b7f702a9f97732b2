// SPDX-License-Identifier: BSD-3-Clause
// A grid that scrolls, against one that is made anew at each place.
#include <algorithm>
#include <set>
#include <vector>

#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/incremental_voxels/injection.h"
#include "renderer/incremental_voxels/moving_bricks.h"
#include "renderer/incremental_voxels/single_pass.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/voxels/exact_voxels.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::incremental_voxels {
namespace {

class ScrollingTest : public voxels::VoxelizerFixture {
 protected:
  static voxels::VoxelGrid smallGrid() {
    voxels::VoxelGrid grid;
    grid.origin = {-1.1, -0.9, -2.2};
    grid.voxelSize = 0.11;
    grid.resolution = {37, 17, 26};
    return grid;
  }
  static scene::Scene boxes(bool both = true) {
    scene::Scene scene;
    scene::addPart(scene, "wall", scene::box({-1.9, -0.8, -1.9}, {2.9, 0.9, -1.7}),
                   glm::vec3(0.5F, 0.2F, 0.7F));
    if (both)
      scene::addPart(scene, "box", scene::box({-0.3, -0.4, -0.6}, {0.6, 0.3, 0.1}),
                     glm::vec3(0.1F, 0.8F, 0.3F));
    scene.lights = {scene::lightTowards({1.3, 1.1, 1.9}, {0.0, 0.1, -1.0}, glm::dvec2(0.2))};
    scene::setStillCamera(scene, {{-0.4, 0.3, 2.6}, {0.05, 0.0, -0.4}, {0.1, 1.0, 0.0}, 42.0});
    return scene;
  }
  /// Moves in voxels: to both sides along each axis, all at once, by more than half, and beyond the grid.
  static std::vector<glm::ivec3> moves() {
    return {{3, 0, 0}, {-1, 0, 0}, {0, 5, 0}, {0, -9, 2}, {-20, 7, -13}, {33, 3, 25}, {0, 0, 26}, {5, -5, 5}};
  }
};

// Voxels filled at random in the world: after each move the grid holds those that it has held without a
// break since they were filled, and no others.
TEST_F(ScrollingTest, WhatStaysInTheGridStaysInItsPlace) {
  const voxels::VoxelGrid start = smallGrid();
  const glm::ivec3 size = start.resolution;
  SampledVolume volume(context(), start, glm::dvec3(0.0), false, 1, 1, true);
  scene::Random random(3);
  std::vector<uint8_t> expected(static_cast<size_t>(start.count()));
  for (uint8_t& one : expected) one = random.uniform(0.0, 1.0) < 0.5 ? 1 : 0;
  volume.occupancy().writeOccupied(expected);
  glm::ivec3 at(0);
  for (const glm::ivec3 move : moves()) {
    at += move;
    volume.moveTo(start.origin + glm::dvec3(at) * start.voxelSize);
    std::vector<uint8_t> next(expected.size());
    glm::ivec3 v;
    for (v.z = 0; v.z < size.z; ++v.z)
      for (v.y = 0; v.y < size.y; ++v.y)
        for (v.x = 0; v.x < size.x; ++v.x)
          if (start.contains(v + move))
            next[static_cast<size_t>(start.indexOf(v))] =
                expected[static_cast<size_t>(start.indexOf(v + move))];
    ASSERT_EQ(volume.readOccupied(), next) << move.x << " " << move.y << " " << move.z;
    expected = next;
  }
}

// After any moves a step fills the same voxels with the same attributes as in a grid made at that place.
TEST_F(ScrollingTest, AStepFillsWhatItFillsInANewGrid) {
  const scene::Scene scene = boxes();
  const voxels::VoxelGrid start = smallGrid();
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {96, 80});
  const PointSettings points{.side = 96, .shift = false};
  glm::ivec3 at(0);
  SampledVolume scrolled(context(), start, gpuScene.anchor(), true, 1, points.perStep(), true);
  const Injection injection(context(), points, scrolled, 1, 1);
  for (const glm::ivec3 move : {glm::ivec3(5, -3, 4), glm::ivec3(-8, 5, 2), glm::ivec3(4, 1, -5)}) {
    at += move;
    voxels::VoxelGrid grid = start;
    grid.origin += glm::dvec3(at) * start.voxelSize;
    SampledVolume fresh(context(), grid, gpuScene.anchor(), true, 1, points.perStep());
    const Injection anew(context(), points, fresh, 1, 1);
    scrolled.moveTo(grid.origin);
    // What is left of it goes, so that both begin empty; its places stay where they are.
    scrolled.clear();
    frame.begin();
    const std::vector<DepthView> views = {cameraView(frame)};
    scrolled.turn();
    fresh.turn();
    injection.run(frame, scrolled, views, {}, 0);
    anew.run(frame, fresh, views, {}, 0);
    frame.end();
    EXPECT_EQ(scrolled.readOccupied(), fresh.readOccupied());
    EXPECT_GT(std::ranges::count(fresh.readOccupied(), uint8_t{1}), 50);
    std::vector<Image> albedos, normals;
    for (int z = 0; z < grid.resolution.z; ++z) {
      albedos.push_back(scrolled.albedo().readLayer(z));
      normals.push_back(scrolled.normal().readLayer(z));
    }
    glm::ivec3 v;
    for (v.z = 0; v.z < grid.resolution.z; ++v.z) {
      const Image albedo = fresh.albedo().readLayer(v.z), normal = fresh.normal().readLayer(v.z);
      for (v.y = 0; v.y < grid.resolution.y; ++v.y)
        for (v.x = 0; v.x < grid.resolution.x; ++v.x) {
          const glm::ivec3 stored = scrolled.storedVoxel(v);
          for (int c = 0; c < 4; ++c) {
            ASSERT_EQ(albedos[static_cast<size_t>(stored.z)].at(stored.x, stored.y, c),
                      albedo.at(v.x, v.y, c));
            ASSERT_EQ(normals[static_cast<size_t>(stored.z)].at(stored.x, stored.y, c),
                      normal.at(v.x, v.y, c));
          }
        }
    }
  }
}

// Where a grid that scrolls has been all the time it holds what a large one that stays holds, while a box
// comes and goes: the same voxels, with the same attributes.
TEST_F(ScrollingTest, WhatIsSeenAndClearedIsThatOfAGridThatStays) {
  voxels::VoxelGrid grid = smallGrid(), large = smallGrid();
  const glm::ivec3 around(8, 7, 9), size = grid.resolution;
  large.origin -= glm::dvec3(around) * grid.voxelSize;
  large.resolution += 2 * around;
  const scene::Scene scenes[] = {boxes(), boxes(false)};
  const frame::GpuScene with(scenes[0]), without(scenes[1]);
  const PointSettings points{.side = 64};
  SampledVolume scrolled(context(), grid, with.anchor(), true, 1, points.perStep(), true),
      still(context(), large, with.anchor(), true, 1, points.perStep());
  const CleanUp cleanScrolled(context(), {}, scrolled, 1, 1), cleanStill(context(), {}, still, 1, 1);
  const Injection intoScrolled(context(), points, scrolled, 1, 1), intoStill(context(), points, still, 1, 1);
  glm::ivec3 at(0), low(0), high(size);  // low and high: of what it has never left
  int64_t compared = 0, empty = 0;
  const std::vector<glm::ivec3> moves = {{0, 0, 0},  {3, -2, 1},  {-5, 4, 2},
                                         {7, 1, -6}, {-4, -5, 5}, {1, 3, -3}};
  for (size_t step = 0; step < moves.size(); ++step) {
    const frame::GpuScene& gpuScene = step % 2 == 0 ? with : without;
    frame::Frame frame(context(), scenes[step % 2], gpuScene, {96, 80});
    at += moves[step];
    low = glm::max(low, at), high = glm::min(high, at + size);
    scrolled.moveTo(grid.origin + glm::dvec3(at) * grid.voxelSize);
    frame.begin();
    const std::vector<DepthView> views = {cameraView(frame)};
    for (SampledVolume* volume : {&scrolled, &still}) {
      volume->turn();
      (volume == &still ? cleanStill : cleanScrolled).run(*volume, views, gpuScene.anchor());
      (volume == &still ? intoStill : intoScrolled).run(frame, *volume, views, {}, static_cast<int>(step));
    }
    frame.end();
    const std::vector<uint8_t> found = scrolled.readOccupied(), expected = still.readOccupied();
    std::vector<Image> albedos;
    for (int z = 0; z < size.z; ++z) albedos.push_back(scrolled.albedo().readLayer(z));
    glm::ivec3 v;
    for (v.z = low.z; v.z < high.z; ++v.z) {
      const Image albedo = still.albedo().readLayer(v.z + around.z);
      for (v.y = low.y; v.y < high.y; ++v.y)
        for (v.x = low.x; v.x < high.x; ++v.x) {
          const uint8_t is = found[static_cast<size_t>(grid.indexOf(v - at))];
          ASSERT_EQ(is, expected[static_cast<size_t>(large.indexOf(v + around))])
              << step << " at " << v.x << " " << v.y << " " << v.z;
          const glm::ivec3 stored = scrolled.storedVoxel(v - at);
          for (int c = 0; c < 4; ++c)
            ASSERT_EQ(albedos[static_cast<size_t>(stored.z)].at(stored.x, stored.y, c),
                      albedo.at(v.x + around.x, v.y + around.y, c));
          ++(is ? compared : empty);
        }
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(empty, 5000);
}

// Bricks that a part has been in are those that its voxels are stored in, however the grid's places are
// turned: around its end and on at its beginning, along each axis and along all. They stay as the grid
// scrolls, and go with all that is in it.
TEST_F(ScrollingTest, BricksOfPartsAreWhereTheirVoxelsAreStored) {
  const voxels::VoxelGrid grid = smallGrid();
  const glm::ivec3 size = grid.resolution, counts = brickCounts(grid);
  // In voxels; reaches beyond the grid's high side along z.
  const glm::dvec3 low(30.3, 3.4, 20.6), high(34.7, 11.2, 29.5);
  scene::Scene scene;
  scene::addPart(scene, "moves",
                 scene::box(grid.origin + low * grid.voxelSize, grid.origin + high * grid.voxelSize),
                 glm::vec3(0.5F));
  scene.motions.emplace_back();
  const auto bricksAt = [&](glm::ivec3 wrap) {
    std::set<uint32_t> out;
    const glm::ivec3 last = glm::min(glm::ivec3(high), size - 1);
    glm::ivec3 v;
    for (v.z = int(low.z); v.z <= last.z; ++v.z)
      for (v.y = int(low.y); v.y <= last.y; ++v.y)
        for (v.x = int(low.x); v.x <= last.x; ++v.x) {
          const glm::ivec3 brick = (v + wrap) % size / glm::ivec3(32, 8, 8);
          out.insert(uint32_t(brick.x + counts.x * (brick.y + counts.y * brick.z)));
        }
    return out;
  };
  const auto listed = [](const MovingBricks& bricks) {
    const std::vector<uint32_t> list = bricks.list().read<uint32_t>(0, bricks.count());
    return std::set<uint32_t>(list.begin(), list.end());
  };
  for (const glm::ivec3 wrap : {glm::ivec3(0), glm::ivec3(5, 0, 0), glm::ivec3(0, 9, 0), glm::ivec3(0, 0, 4),
                                glm::ivec3(2, 7, 3), glm::ivec3(36, 16, 25), glm::ivec3(11, 12, 13)}) {
    MovingBricks bricks(scene, grid);
    bricks.add(0.0, wrap);
    EXPECT_EQ(listed(bricks), bricksAt(wrap)) << wrap.x << " " << wrap.y << " " << wrap.z;
    EXPECT_EQ(bricks.count(), int(bricksAt(wrap).size()));
  }
  MovingBricks bricks(scene, grid);
  bricks.add(0.0, {0, 9, 0});
  bricks.moveTo(grid, {36, -16, 25});
  bricks.add(0.0, {5, 0, 0});
  std::set<uint32_t> both = bricksAt({0, 9, 0});
  both.merge(bricksAt({5, 0, 0}));
  EXPECT_EQ(listed(bricks), both);
  bricks.moveTo(grid, {0, -17, 0});
  EXPECT_EQ(bricks.count(), 0);
}

// As a new volume: the bits, and every texel of the attributes.
TEST_F(ScrollingTest, ClearingLeavesNothing) {
  const scene::Scene scene = boxes();
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {96, 80});
  const PointSettings points{.side = 96, .shift = false};
  for (const bool scrolls : {false, true}) {
    SampledVolume volume(context(), smallGrid(), gpuScene.anchor(), true, 1, points.perStep(), scrolls);
    const Injection injection(context(), points, volume, 1, 1);
    if (scrolls) volume.moveTo(smallGrid().origin + glm::dvec3(5.0, -3.0, 4.0) * smallGrid().voxelSize);
    frame.begin();
    injection.run(frame, volume, {cameraView(frame)}, {}, 0);
    frame.end();
    EXPECT_GT(voxels::countOf(volume.readOccupied()), 50);
    volume.clear();
    EXPECT_EQ(voxels::countOf(volume.readOccupied()), 0);
    for (const gl::Texture* texture : {&volume.normal(), &volume.albedo(), &volume.light()})
      for (int z = 0; z < smallGrid().resolution.z; ++z)
        for (const float value : texture->readLayer(z).data) ASSERT_EQ(value, 0.0F);
  }
}

// A clean-up, and a single pass, leave of a full grid that has scrolled what they leave of a full one made
// there, with bricks decided by tiles or not.
TEST_F(ScrollingTest, ACleanUpLeavesWhatItLeavesInANewGrid) {
  const scene::Scene scene = boxes();
  const voxels::VoxelGrid start = smallGrid();
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {96, 80});
  const std::vector<uint8_t> full(static_cast<size_t>(start.count()), 1);
  const CleanUpSettings settings{.bias = RadiusBias{}, .proof = Proof::Support, .sky = true},
      centre{.bias = RadiusBias{}, .proof = Proof::Centre, .sky = true};
  for (const std::vector<glm::ivec2>& tiled : {std::vector<glm::ivec2>{}, std::vector<glm::ivec2>{{96, 80}}})
    for (const bool single : {false, true}) {
      std::vector<std::vector<uint8_t>> left;
      for (const bool scrolls : {false, true}) {
        voxels::VoxelGrid grid = start;
        grid.origin += glm::dvec3(6, -4, 5) * start.voxelSize;
        SampledVolume volume(context(), scrolls ? start : grid, gpuScene.anchor(), false, 1, 1, scrolls);
        const CleanUp cleanUp(context(), settings, volume, 1, 1, tiled);
        const SinglePass pass(context(), centre, volume, 1, 1, tiled);
        if (scrolls) volume.moveTo(grid.origin);
        volume.occupancy().writeOccupied(full);
        frame.begin();
        const std::vector<DepthView> views = {cameraView(frame)};
        volume.turn();
        if (single)
          pass.run(frame, volume, views, {});
        else
          cleanUp.run(volume, views, gpuScene.anchor());
        frame.end();
        left.push_back(volume.readOccupied());
      }
      EXPECT_EQ(left[0], left[1]) << single;
      EXPECT_GT(std::ranges::count(left[0], uint8_t{0}), 1000);
      EXPECT_GT(std::ranges::count(left[0], uint8_t{1}), 1000);
    }
}

}  // namespace
}  // namespace limen::incremental_voxels
