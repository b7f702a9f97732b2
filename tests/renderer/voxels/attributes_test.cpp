// SPDX-License-Identifier: BSD-3-Clause
// What voxels hold, against voxel_oracle.h.
#include <algorithm>
#include <cmath>
#include <string>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/voxels/exact_attributes.h"
#include "tests/renderer/voxels/lit_corner.h"
#include "tests/renderer/voxels/voxel_oracle.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::voxels {
namespace {

constexpr VolumeAttributes kAll{.albedo = true,
                                .normal = true,
                                .format = gl::Format::RGBA32F,
                                .occupancy = true,
                                .light = true,
                                .shGrey = true,
                                .shColour = true,
                                .pattern = true,
                                .mostEntries = 64,
                                .largestLight = 4.0F};

class VoxelAttributesTest : public VoxelizerFixture {
 protected:
  /// Number of occupied voxels compared.
  static int compareAll(const scene::Scene& scene, Coverage coverage, const VoxelLamps& lamps,
                        uint32_t queueCapacity = 65536) {
    const VoxelGrid grid = tightGrid(scene.bounds(), 24);
    const VoxelOracle oracle(scene, grid, lamps);
    int compared = 0;
    voxelize(
        scene, grid, coverage, kAll,
        [&](const Volume& volume) {
          // A sum is off by half a step an entry; light besides by how far floats are off in cosines.
          const double bound = 0.51 / volume.sumSteps() + 1e-6,
                       lightBound = 0.51 / volume.lightSteps() + 2e-3;
          for (int z = 0; z < grid.resolution.z; ++z) {
            std::array<Image, kVoxelAttributes> images;
            for (size_t i = 0; i < kVoxelAttributes; ++i)
              images[i] = volume.attachment(static_cast<VoxelAttribute>(i)).readLayer(z);
            for (int y = 0; y < grid.resolution.y; ++y)
              for (int x = 0; x < grid.resolution.x; ++x) {
                const OracleVoxel expected = oracle.at({x, y, z}, coverage, 4.0 / 1024.0);
                if (expected.close) continue;
                if (expected.entries > 0.0) ++compared;
                const double one = expected.entries > 0.0 ? 1.0 : 0.0;
                const glm::dvec4 values[kVoxelAttributes] = {{expected.opacity, expected.entries, 0.0, 0.0},
                                                             glm::dvec4(expected.albedo, one),
                                                             glm::dvec4(expected.normal, expected.opacity),
                                                             glm::dvec4(expected.light, one),
                                                             expected.grey,
                                                             expected.colour[0],
                                                             expected.colour[1],
                                                             expected.colour[2]};
                for (size_t i = 0; i < kVoxelAttributes; ++i)
                  for (int c = 0; c < 4; ++c)
                    ASSERT_NEAR(images[i].at(x, y, c), values[i][c], i < 3 ? bound : lightBound)
                        << toText(static_cast<VoxelAttribute>(i)) << " " << c << " at " << x << " " << y
                        << " " << z;
              }
          }
        },
        lamps, queueCapacity);
    return compared;
  }
};

// Opacity, albedo, normals of both signs, and light of the nearer lamp through glass and past walls.
TEST_F(VoxelAttributesTest, EachIsTheMeanOverEntriesInDoublePrecision) {
  for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
    EXPECT_GT(compareAll(litCorner(), coverage, {}), 400) << toText(coverage);
}

TEST_F(VoxelAttributesTest, LampsAddUp) {
  EXPECT_GT(compareAll(litCorner(), Coverage::Thin, {.strength = 0.5, .all = true}), 400);
  EXPECT_GT(compareAll(litCorner(), Coverage::Thin, {.all = true, .shadows = false}), 400);
}

// Large triangles end in the same sums if the queue holds none of their parts, or some.
TEST_F(VoxelAttributesTest, AFullQueueChangesNothing) {
  for (const uint32_t capacity : {0U, 3U})
    EXPECT_GT(compareAll(litCorner(), Coverage::Thin, {}, capacity), 400);
}

// Light, normals and lobes of a slanted surface that faces away from all axes are negative in part, and
// survive.
TEST_F(VoxelAttributesTest, NegativeComponentsSurvive) {
  scene::Scene scene;
  scene::addPart(scene, scene::card({0.0, 0.0, 0.0}, {0.5, -0.5, 0.0}, {0.5, 0.0, -0.5}),
                 plainMaterial(glm::vec3(0.5F), 0.0F, glm::vec3(1.0F)));
  const glm::dvec3 a = scene.mesh.positions[scene.mesh.triangles[0].x];
  const glm::dvec3 normal = glm::normalize(glm::cross(scene.mesh.positions[scene.mesh.triangles[0].y] - a,
                                                      scene.mesh.positions[scene.mesh.triangles[0].z] - a));
  const double sign = normal.x < 0.0 ? -1.0 : 1.0;
  if (sign > 0.0)
    for (glm::uvec3& triangle : scene.mesh.triangles) std::swap(triangle.y, triangle.z);
  voxelize(scene, tightGrid(scene.bounds(), 8), Coverage::Conservative, kAll, [&](const Volume& volume) {
    const Image normals = volume.normal().readLayer(2),
                lobes = volume.attachment(VoxelAttribute::ShRed).readLayer(2);
    int found = 0;
    for (int y = 0; y < normals.height; ++y)
      for (int x = 0; x < normals.width; ++x) {
        if (normals.at(x, y, 3) == 0.0F) continue;
        ++found;
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(normals.at(x, y, c), -std::sqrt(1.0 / 3.0), 1e-5);
          EXPECT_NEAR(lobes.at(x, y, c + 1), -1.023327 * std::sqrt(1.0 / 3.0), 1e-4);
        }
      }
    EXPECT_GT(found, 4);
  });
}

// A voxel that one plane alone passes has that plane's normal and colour; the edge between two of them has a
// mean that depends on what counts, within the angle between both.
TEST_F(VoxelAttributesTest, ASurfaceAloneHasItsOwnNormalAndAlbedo) {
  scene::Scene scene;
  scene::addPart(scene, scene::card({0.0, 0.0, 0.0}, {0.5, 0.11, 0.2}, {0.13, -0.6, 0.07}),
                 plainMaterial({0.8F, 0.3F, 0.6F}));
  voxelize(scene, tightGrid(scene.bounds(), 24), Coverage::Thin, kAll, [&](const Volume& volume) {
    const AttributeError error = compare(volume, exactAttributes(scene, scene.mesh, volume.grid()));
    EXPECT_GT(error.normals, 200);
    EXPECT_LT(error.albedo, 1e-5);
    EXPECT_LT(error.normalDeg, 1e-2);
  });
  const scene::Scene corner = litCorner();
  voxelize(corner, tightGrid(corner.bounds(), 24), Coverage::Thin, kAll, [&](const Volume& volume) {
    const AttributeError error = compare(volume, exactAttributes(corner, corner.mesh, volume.grid()));
    EXPECT_GT(error.normals, 400);
    EXPECT_GT(error.normalDeg, 0.5);
    EXPECT_LT(error.normalDeg, 15.0);
    EXPECT_LT(error.albedo, 0.1);
  });
}

// Refilled by a scene that lies elsewhere, a volume keeps nothing of what it held.
TEST_F(VoxelAttributesTest, NothingIsLeftOfAnEarlierFill) {
  scene::Scene both, second;
  const scene::Mesh low = scene::box({-0.9, -0.9, -0.9}, {-0.3, -0.2, -0.4}),
                    high = scene::box({0.1, 0.2, 0.1}, {0.8, 0.9, 0.7});
  scene::addPart(both, low, plainMaterial({0.9F, 0.2F, 0.1F}, 0.0F, {1.0F, 1.0F, 1.0F}));
  scene::addPart(both, high, plainMaterial({0.2F, 0.5F, 0.7F}));
  const VoxelGrid grid = tightGrid(both.bounds(), 16);
  const frame::GpuScene gpuScene(both);
  frame::Frame frame(context(), both, gpuScene, {16, 16});
  const Volume volume(context(), grid, gpuScene.anchor(), kAll),
      fresh(context(), grid, gpuScene.anchor(), kAll);
  const Voxelizer voxelizer(frame, Coverage::Thin, volume);
  const uint32_t half = both.parts[1].firstTriangle;
  frame.begin();
  const VoxelizedPart later{.spans = {{.first = half}}};
  voxelizer.run(frame, volume);
  voxelizer.run(frame, volume, later);
  voxelizer.run(frame, fresh, later);
  frame.end();
  EXPECT_EQ(volume.readOccupied(), fresh.readOccupied());
  for (size_t i = 0; i < kVoxelAttributes; ++i)
    for (int z = 0; z < grid.resolution.z; ++z)
      EXPECT_EQ(volume.attachment(static_cast<VoxelAttribute>(i)).readLayer(z).data,
                fresh.attachment(static_cast<VoxelAttribute>(i)).readLayer(z).data);
  for (const uint32_t sum : volume.sums()->read<uint32_t>()) ASSERT_EQ(sum, 0U);
}

/// Every bit of all attachments, one after another.
void expectEqual(const Volume& a, const Volume& b) {
  EXPECT_EQ(a.readOccupied(), b.readOccupied());
  EXPECT_EQ(a.attributes().count(), b.attributes().count());
  for (const auto& [attribute, name] : enumNames(VoxelAttribute{}).entries)
    for (int z = 0; z < a.grid().resolution.z && a.attributes().has(attribute); ++z)
      EXPECT_EQ(a.attachment(attribute).readLayer(z).data, b.attachment(attribute).readLayer(z).data) << name;
}

// What rests in one volume and what moves in another are, joined, what one volume has of all: to the last
// bit, as sums are whole numbers. Twice, since the second time something has to go.
TEST_F(VoxelAttributesTest, TwoVolumesJoinAsOne) {
  const scene::Scene scene = litCorner();
  const VoxelGrid grid = tightGrid(scene.bounds(), 20);
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {16, 16});
  for (const VoxelSums sums : {VoxelSums::Occupied, VoxelSums::All}) {
    VolumeAttributes attributes = kAll, rest = kAll;
    attributes.sums = rest.sums = sums;
    rest.joined = true;
    const Volume resting(context(), grid, gpuScene.anchor(), rest),
        joined(context(), grid, gpuScene.anchor(), attributes),
        whole(context(), grid, gpuScene.anchor(), attributes);
    const Voxelizer voxelizer(frame, Coverage::Thin, whole);
    const VoxelizedPart first{.spans = {{.first = 0, .end = scene.parts[2].firstTriangle}}},
        second{.spans = {{.first = scene.parts[2].firstTriangle}}, .base = &resting};
    frame.begin();
    voxelizer.gather(frame, resting, first);
    voxelizer.run(frame, joined);
    for (int i = 0; i < 2; ++i) voxelizer.run(frame, joined, second);
    voxelizer.run(frame, whole);
    frame.end();
    expectEqual(joined, whole);
  }
}

// Sums of occupied voxels alone are those of all, to the last bit, in as much room as there are such voxels.
// Without rays, which TwoVolumesJoinAsOne has, and light by one coverage alone: of twelve programs these
// would make up most.
TEST_F(VoxelAttributesTest, SumsOfOccupiedVoxelsAreThoseOfAll) {
  const scene::Scene scene = litCorner();
  const VoxelGrid grid = tightGrid(scene.bounds(), 24);
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {16, 16});
  const VoxelLamps lamps{.all = true, .shadows = false};
  for (const Coverage coverage : {Coverage::Dominant, Coverage::Thin, Coverage::Conservative}) {
    VolumeAttributes all = kAll;
    if (coverage != Coverage::Thin) all.light = all.shGrey = all.shColour = false;
    VolumeAttributes occupied = all;
    occupied.sums = VoxelSums::Occupied;
    occupied.mostOccupied = countOccupied(frame, grid, coverage);
    const Volume dense(context(), grid, gpuScene.anchor(), all),
        compact(context(), grid, gpuScene.anchor(), occupied);
    frame.begin();
    Voxelizer(frame, coverage, dense, lamps).run(frame, dense);
    const Voxelizer voxelizer(frame, coverage, compact, lamps);
    for (int i = 0; i < 2; ++i) voxelizer.run(frame, compact);
    frame.end();
    expectEqual(compact, dense);
    EXPECT_EQ(compact.withoutSums(), 0);
    EXPECT_EQ(compact.sums()->bytes() * grid.count(), dense.sums()->bytes() * occupied.mostOccupied);
    EXPECT_LT(compact.bytes(), dense.bytes());
  }
}

// Without room for all voxels' sums some have no attributes: their number is told, the others are right.
TEST_F(VoxelAttributesTest, VoxelsBeyondTheRoomForSumsAreCounted) {
  const scene::Scene scene = litCorner();
  const VoxelGrid grid = tightGrid(scene.bounds(), 24);
  VolumeAttributes tight = kAll;
  tight.sums = VoxelSums::Occupied;
  tight.mostOccupied = 300;
  voxelize(scene, grid, Coverage::Thin, tight, [&](const Volume& volume) {
    const int64_t all = std::ranges::count(volume.readOccupied(), uint8_t{1});
    EXPECT_GT(all, 400);
    EXPECT_EQ(volume.withoutSums(), all - 300);
    int64_t with = 0;
    for (int z = 0; z < grid.resolution.z; ++z) {
      const Image image = volume.attachment(VoxelAttribute::Occupancy).readLayer(z);
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) with += image.at(x, y, 1) > 0.0F ? 1 : 0;
    }
    EXPECT_EQ(with, 300);
  });
}

// 1,024 bits a voxel: eight attachments of four floats (Gaitatzes 2012, section 6.2); half of that in 16
// bits.
TEST_F(VoxelAttributesTest, AVolumeHasUpTo1024BitsAVoxel) {
  VoxelGrid grid;
  grid.resolution = {16, 12, 8};
  const Volume full(context(), grid, glm::dvec3(0.0), kAll);
  EXPECT_EQ(full.attributes().count(), 8);
  EXPECT_EQ(full.attributes().bitsPerVoxel(), 1024);
  VolumeAttributes half = kAll;
  half.format = gl::Format::RGBA16F;
  EXPECT_EQ(Volume(context(), grid, glm::dvec3(0.0), half).attributes().bitsPerVoxel(), 512);
}

// 128^3 at 1,024 bits are 256 MiB, and sums come to that.
TEST_F(VoxelAttributesTest, AVolumeBeyondItsBudgetIsRefusedOrHalved) {
  VoxelGrid grid;
  grid.resolution = glm::ivec3(32);
  VolumeAttributes attributes = kAll;
  attributes.budgetBytes = 6 << 20;  // of 4 MiB in 32-bit floats, 2 in 16-bit ones; and 3.1 of sums
  try {
    const Volume refused(context(), grid, glm::dvec3(0.0), attributes);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("budget"), std::string::npos) << error.what();
  }
  attributes.mayHalve = true;
  const Volume halved(context(), grid, glm::dvec3(0.0), attributes);
  EXPECT_EQ(halved.attributes().format, gl::Format::RGBA16F);
  EXPECT_LE(halved.bytes(), attributes.budgetBytes);
  attributes.budgetBytes = 4 << 20;
  EXPECT_THROW(Volume(context(), grid, glm::dvec3(0.0), attributes), Error);
}

}  // namespace
}  // namespace limen::voxels
