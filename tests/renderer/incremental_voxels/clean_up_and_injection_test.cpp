// SPDX-License-Identifier: BSD-3-Clause
// Clean-up and injection of voxels against depths and sets worked out in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/incremental_voxels/depth_view.h"
#include "renderer/incremental_voxels/injection.h"
#include "renderer/incremental_voxels/sampled_volume.h"
#include "renderer/incremental_voxels/single_pass.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/voxels/exact_voxels.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::incremental_voxels {
namespace {

/// A slanted wall behind everything, in general position.
constexpr glm::dvec3 kWallAt{0.1, 0.2, -1.4};
glm::dvec3 wallNormal() { return glm::normalize(glm::dvec3(0.35, -0.2, 1.0)); }

class CleanUpAndInjectionTest : public voxels::VoxelizerFixture {
 protected:
  static scene::Scene wall() {
    scene::Scene scene;
    const glm::dvec3 n = wallNormal(), u = glm::normalize(glm::cross({0.0, 1.0, 0.0}, n)),
                     v = glm::cross(n, u);
    scene::addPart(scene, "wall", scene::card(kWallAt, 3.0 * u, 3.0 * v), glm::vec3(0.5F));
    scene.lights = {scene::lightTowards({1.3, 1.1, 1.9}, {0.0, 0.1, -1.0}, glm::dvec2(0.2))};
    scene::setStillCamera(scene, {{-0.4, 0.3, 2.6}, {0.05, 0.0, -0.4}, {0.1, 1.0, 0.0}, 42.0});
    return scene;
  }
  static voxels::VoxelGrid grid() {
    voxels::VoxelGrid grid;
    grid.origin = {-1.1, -0.9, -2.2};
    grid.voxelSize = 0.11;
    grid.resolution = {21, 17, 26};
    return grid;
  }
};

/// What a view says of a voxel of a scene that is the wall alone.
enum class Says { Nothing, Empty, Close, Undecided };

/// `eye`, unit axes right, down, along; tangents at the image's corners.
struct PlainView {
  glm::dvec3 eye, right, down, along;
  glm::dvec2 low, high;
  glm::ivec2 sizePx;
};

PlainView plainCamera(const scene::Camera& camera, glm::ivec2 sizePx) {
  PlainView view;
  view.eye = camera.eye;
  view.along = glm::normalize(camera.target - camera.eye);
  view.right = glm::normalize(glm::cross(view.along, camera.up));
  view.down = glm::cross(view.along, view.right);
  const double tangent = std::tan(0.5 * glm::radians(camera.verticalFovDeg));
  view.high = {tangent * sizePx.x / sizePx.y, tangent};
  view.low = -view.high;
  view.sizePx = sizePx;
  return view;
}

double wallDepth(const PlainView& view, glm::ivec2 pixel) {
  const glm::dvec2 t =
      view.low + (view.high - view.low) * (glm::dvec2(pixel) + 0.5) / glm::dvec2(view.sizePx);
  const glm::dvec3 ray = view.along + t.x * view.right + t.y * view.down;
  return glm::dot(wallNormal(), kWallAt - view.eye) / glm::dot(wallNormal(), ray);
}

Says says(const PlainView& view, glm::dvec3 middle, double bias) {
  const glm::dvec3 from = middle - view.eye;
  const double z = glm::dot(from, view.along);
  if (z < 0.05) return z > -0.01 ? Says::Undecided : Says::Nothing;
  const glm::dvec2 place =
      (glm::dvec2(glm::dot(from, view.right), glm::dot(from, view.down)) / z - view.low) /
      (view.high - view.low) * glm::dvec2(view.sizePx);
  constexpr double kPlaces = 1e-3;  // px, which floats may take otherwise
  const glm::dvec2 within = glm::fract(place);
  if (glm::any(glm::lessThan(place, glm::dvec2(-kPlaces))) ||
      glm::any(glm::greaterThan(place, glm::dvec2(view.sizePx) + kPlaces)))
    return Says::Nothing;
  if (glm::any(glm::lessThan(within, glm::dvec2(kPlaces))) ||
      glm::any(glm::greaterThan(within, glm::dvec2(1.0 - kPlaces))))
    return Says::Undecided;
  const double before = wallDepth(view, glm::ivec2(glm::floor(place))) - bias - z;
  if (std::abs(before) < 1e-4) return Says::Undecided;
  return before > 0.0 ? Says::Empty : Says::Close;
}

struct BiasCase {
  CleanUpBias bias;
  double camera, light;  // world units
};

// All voxels are filled; those are emptied whose middle lies before the wall that is seen there by more than
// the bias, and no others: neither beside the image nor behind the eye. With the light's image as well,
// either empties what it sees through.
TEST_F(CleanUpAndInjectionTest, ClearsWhatLiesBeforeTheSeenSurface) {
  const scene::Scene scene = wall();
  const voxels::VoxelGrid grid = this->grid();
  const double s = grid.voxelSize;
  const frame::GpuScene gpuScene(scene);
  const PlainView camera = plainCamera(scene.camera.at(0.0), {96, 80});
  const scene::AreaLight& light = scene.lights[0];
  const auto extent = [&](glm::dvec3 axis) {
    return 0.5 * s * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
  };
  const BiasCase cases[] = {{TightBias{}, extent(camera.along), extent(light.direction())},
                            {RadiusBias{}, std::sqrt(0.75) * s, std::sqrt(0.75) * s},
                            {ListingBias{}, 3.0 * s, 3.0 * s},
                            {FixedBias{0.25}, 0.25 * s, 0.25 * s}};
  for (const BiasCase& one : cases)
    for (const int used : {1, 2}) {
      frame::Frame frame(context(), scene, gpuScene, camera.sizePx);
      LightMap map(context(), 64, frame::Raster::Auto);
      SampledVolume volume(context(), grid, gpuScene.anchor(), false, used, 1);
      volume.occupancy().writeOccupied(std::vector<uint8_t>(static_cast<size_t>(grid.count()), 1));
      const CleanUpSettings settings{.bias = one.bias, .proof = Proof::Centre, .sky = true};
      const CleanUp cleanUp(context(), settings, volume, used, used);
      frame.begin();
      std::vector<DepthView> views = {cameraView(frame)};
      if (used == 2) {
        map.draw(frame, {grid.origin, grid.high()});
        views.push_back(map.view());
      }
      cleanUp.run(volume, views, gpuScene.anchor());
      frame.end();
      const frame::LightFrustum frustum = fitted(light, {grid.origin, grid.high()});
      const PlainView lightView{light.centre, light.axisX,  light.axisY, light.direction(),
                                frustum.low,  frustum.high, {64, 64}};
      const std::vector<uint8_t> left = volume.occupancy().readOccupied();
      int64_t emptied = 0, stayed = 0, byLight = 0;
      glm::ivec3 v;
      for (v.z = 0; v.z < grid.resolution.z; ++v.z)
        for (v.y = 0; v.y < grid.resolution.y; ++v.y)
          for (v.x = 0; v.x < grid.resolution.x; ++v.x) {
            const Says first = says(camera, grid.centre(v), one.camera);
            const Says second = used == 2 ? says(lightView, grid.centre(v), one.light) : Says::Nothing;
            const bool is = left[static_cast<size_t>(grid.indexOf(v))] != 0;
            if (first == Says::Empty || second == Says::Empty) {
              EXPECT_FALSE(is) << v.x << " " << v.y << " " << v.z;
              ++(first == Says::Empty ? emptied : byLight);
            } else if (first != Says::Undecided && second != Says::Undecided) {
              EXPECT_TRUE(is) << v.x << " " << v.y << " " << v.z;
              ++stayed;
            }
          }
      EXPECT_GT(emptied, 1000);
      EXPECT_GT(stayed, 500);
      if (used == 2) {
        EXPECT_GT(byLight, 100);
      }
      const SampleCounts counts = volume.counts();
      EXPECT_EQ(counts.kept + counts.cleared, grid.count());
      EXPECT_EQ(counts.kept, voxels::countOf(left));
    }
}

std::vector<uint8_t> injected(gl::Context& context, const scene::Scene& scene, const voxels::VoxelGrid& grid,
                              const PointSettings& points, int steps, glm::ivec2 sizePx,
                              SampleCounts* counts = nullptr) {
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context, scene, gpuScene, sizePx);
  SampledVolume volume(context, grid, gpuScene.anchor(), true, 1, points.perStep());
  const Injection injection(context, points, volume, 1, 1);
  const CleanUp cleanUp(context, {.bias = ListingBias{}}, volume, 1, 1);
  for (int step = 0; step < steps; ++step) {
    frame.begin();
    const std::vector<DepthView> views = {cameraView(frame)};
    volume.turn();
    cleanUp.run(volume, views, gpuScene.anchor());
    injection.run(frame, volume, views, {}, step);
    frame.end();
  }
  if (counts) *counts = volume.counts();
  return volume.occupancy().readOccupied();
}

// One point a pixel: exactly the voxels that pixel centres' points of the wall lie in.
TEST_F(CleanUpAndInjectionTest, FillsTheVoxelsThatSeenPointsLieIn) {
  const scene::Scene scene = wall();
  const voxels::VoxelGrid grid = this->grid();
  constexpr int kSide = 64;
  SampleCounts counts;
  const std::vector<uint8_t> found =
      injected(context(), scene, grid, {.side = kSide}, 1, glm::ivec2(kSide), &counts);
  const PlainView camera = plainCamera(scene.camera.at(0.0), glm::ivec2(kSide));
  std::vector<uint8_t> expected(found.size()), possible(found.size());
  int64_t samples = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 t = camera.low + (camera.high - camera.low) * (glm::dvec2(x, y) + 0.5) / double(kSide);
      const glm::dvec3 at =
          camera.eye + wallDepth(camera, {x, y}) * (camera.along + t.x * camera.right + t.y * camera.down);
      const glm::dvec3 v = grid.toVoxels(at);
      // Rounding, and the nudge behind the surface.
      constexpr double kSlack = 0.004;
      if (grid.contains(glm::ivec3(glm::floor(v)))) ++samples;
      if (glm::floor(v - kSlack) == glm::floor(v + kSlack)) {
        if (grid.contains(glm::ivec3(glm::floor(v))))
          expected[static_cast<size_t>(grid.indexOf(glm::ivec3(glm::floor(v))))] = 1;
      }
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 off(corner & 1 ? kSlack : -kSlack, corner & 2 ? kSlack : -kSlack,
                             corner & 4 ? kSlack : -kSlack);
        const glm::ivec3 near(glm::floor(v + off));
        if (grid.contains(near)) possible[static_cast<size_t>(grid.indexOf(near))] = 1;
      }
    }
  EXPECT_EQ(voxels::compare(found, expected).missing, 0);
  EXPECT_EQ(voxels::compare(found, possible).extra, 0);
  EXPECT_GT(voxels::countOf(expected), 200);
  EXPECT_NEAR(counts.samples, double(samples), 0.02 * double(samples));
  EXPECT_EQ(counts.touched, voxels::countOf(found));
}

// The order of points changes nothing, nor does a split into subsets once each has had its turn.
TEST_F(CleanUpAndInjectionTest, OrderAndSubsetsOfPointsDoNotMatter) {
  const scene::Scene scene = wall();
  const voxels::VoxelGrid grid = this->grid();
  for (const int side : {37, 64}) {
    const std::vector<uint8_t> rows = injected(context(), scene, grid, {.side = side}, 1, {90, 70});
    EXPECT_GT(voxels::countOf(rows), 100);
    EXPECT_EQ(injected(context(), scene, grid, {.side = side, .pattern = PointPattern::Blocks}, 1, {90, 70}),
              rows);
    for (const int subsets : {2, 3, 8}) {
      const PointSettings points{.side = side, .subsets = subsets};
      EXPECT_EQ(injected(context(), scene, grid, points, subsets, {90, 70}), rows) << side << " " << subsets;
      const int64_t first = voxels::countOf(injected(context(), scene, grid, points, 1, {90, 70}));
      EXPECT_LT(first, voxels::countOf(rows));
    }
  }
}

// A point in each cell and never the same: a grid coarser than the image finds what one as fine as it finds.
TEST_F(CleanUpAndInjectionTest, ShiftedPointsFillHolesInTime) {
  const scene::Scene scene = wall();
  voxels::VoxelGrid grid = this->grid();
  grid.voxelSize *= 0.5, grid.resolution *= 2;
  const int64_t all = voxels::countOf(injected(context(), scene, grid, {.side = 128}, 1, glm::ivec2(128)));
  const PointSettings coarse{.side = 24, .shift = false}, shifted{.side = 24, .shift = true};
  const int64_t still = voxels::countOf(injected(context(), scene, grid, coarse, 32, glm::ivec2(128)));
  EXPECT_EQ(still, voxels::countOf(injected(context(), scene, grid, coarse, 1, glm::ivec2(128))));
  EXPECT_LT(still, 0.7 * double(all));
  EXPECT_GT(voxels::countOf(injected(context(), scene, grid, shifted, 32, glm::ivec2(128))),
            0.98 * double(all));
}

// Reflectance, normal turned to the viewer, and radiance of a lit wall, in the voxel of a point of it.
TEST_F(CleanUpAndInjectionTest, AttributesAreThoseOfTheSeenSurface) {
  scene::Scene scene = wall();
  scene.materials[0].albedo = {0.2F, 0.4F, 0.8F};
  scene.materials[0].emission = {0.0F, 0.5F, 0.0F};
  const voxels::VoxelGrid grid = this->grid();
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {128, 128});
  LightMap map(context(), 256, frame::Raster::Auto);
  const PointSettings points{.side = 128};
  SampledVolume volume(context(), grid, gpuScene.anchor(), true, 2, 2 * points.perStep());
  const Injection injection(context(), points, volume, 2, 2);
  frame.begin();
  map.draw(frame, {grid.origin, grid.high()});
  injection.run(frame, volume, {cameraView(frame), map.view()}, {.strength = 0.7, .brightest = 1.3}, 0);
  frame.end();
  const std::vector<uint8_t> found = volume.occupancy().readOccupied();
  int64_t compared = 0;
  const glm::dvec3 n = wallNormal(), albedo(0.2, 0.4, 0.8);
  for (int z = 0; z < grid.resolution.z; ++z) {
    const Image normals = volume.normal().readLayer(z), albedos = volume.albedo().readLayer(z),
                lights = volume.light().readLayer(z);
    for (int y = 0; y < grid.resolution.y; ++y)
      for (int x = 0; x < grid.resolution.x; ++x) {
        if (!found[static_cast<size_t>(grid.indexOf({x, y, z}))]) {
          for (int c = 0; c < 4; ++c) ASSERT_EQ(lights.at(x, y, c), 0.0F);
          continue;
        }
        // Of the wall's point nearest to the middle; over a voxel the cosine changes by less than its
        // diagonal over the light's distance, and half floats hold 11 bits.
        const glm::dvec3 middle = grid.centre({x, y, z}), at = middle - glm::dot(middle - kWallAt, n) * n;
        const glm::dvec3 away = scene.lights[0].centre - at;
        const double cosine = glm::dot(n, away) / glm::length(away),
                     varies = 1.8 * grid.voxelSize / glm::length(away);
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(normals.at(x, y, c), n[c], 1e-3);
          ASSERT_NEAR(albedos.at(x, y, c), albedo[c], 1e-3);
          const double emitted = c == 1 ? 0.5 : 0.0;
          ASSERT_NEAR(lights.at(x, y, c), emitted + 0.7 * cosine * albedo[c],
                      0.7 * albedo[c] * varies + 2e-3);
        }
        ++compared;
      }
  }
  EXPECT_GT(compared, 200);
}

// What the single pass fills lies within the bias of the wall, and nothing that is closer than that and seen
// is left out.
TEST_F(CleanUpAndInjectionTest, SinglePassFillsWhatLiesWithinTheBias) {
  const scene::Scene scene = wall();
  const voxels::VoxelGrid grid = this->grid();
  const frame::GpuScene gpuScene(scene);
  const PlainView camera = plainCamera(scene.camera.at(0.0), {96, 80});
  frame::Frame frame(context(), scene, gpuScene, camera.sizePx);
  const SampledVolume volume(context(), grid, gpuScene.anchor(), false, 1, 1);
  const CleanUpSettings settings{.bias = RadiusBias{}, .proof = Proof::Centre};
  frame.begin();
  SinglePass(context(), settings, volume, 1, 1).run(frame, volume, {cameraView(frame)}, {});
  frame.end();
  const std::vector<uint8_t> found = volume.occupancy().readOccupied();
  const double bias = std::sqrt(0.75) * grid.voxelSize;
  int64_t close = 0;
  glm::ivec3 v;
  for (v.z = 0; v.z < grid.resolution.z; ++v.z)
    for (v.y = 0; v.y < grid.resolution.y; ++v.y)
      for (v.x = 0; v.x < grid.resolution.x; ++v.x) {
        const Says before = says(camera, grid.centre(v), bias), behind = says(camera, grid.centre(v), -bias);
        if (before == Says::Undecided || behind == Says::Undecided) continue;
        const bool expected = before == Says::Close && behind == Says::Empty;
        EXPECT_EQ(found[static_cast<size_t>(grid.indexOf(v))] != 0, expected)
            << v.x << " " << v.y << " " << v.z;
        if (expected) ++close;
      }
  EXPECT_GT(close, 300);
}

}  // namespace
}  // namespace limen::incremental_voxels
