// SPDX-License-Identifier: BSD-3-Clause
// What the rasterised forms blend into attachments, against voxel_oracle.h.
#include "renderer/techniques/voxelization/axis_volumes.h"

#include <array>
#include <optional>

#include "renderer/voxels/exact_voxels.h"
#include "tests/renderer/voxels/lit_corner.h"
#include "tests/renderer/voxels/voxel_oracle.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::techniques {
namespace {

using voxels::VoxelAttribute;

class AxisVolumesTest : public voxels::VoxelizerFixture {
 protected:
  static AxisVolumes::Form pixelClip(FragmentBlend blend, const voxels::VoxelLamps& lamps) {
    const std::string folder = "renderer/techniques/voxelization/";
    return {.stages = {folder + "slice.vert.glsl", folder + "pixel_clip.geom.glsl",
                       folder + "pixel_clip.frag.glsl"},
            .defines = {{"CAP", "84"}},
            .passPerSlice = false,
            .blend = blend,
            .refresh = AxisRefresh::All,
            .lamps = lamps};
  }

  static AxisVolumes::Form slicePasses(FragmentBlend blend, const voxels::VoxelLamps& lamps) {
    const std::string folder = "renderer/techniques/voxelization/";
    AxisVolumes::Form form = pixelClip(blend, lamps);
    form.stages = {folder + "slice_pass.vert.glsl", folder + "slice_pass.frag.glsl"};
    form.passPerSlice = true;
    return form;
  }

  static AxisVolumes::Form slicing() {
    const std::string folder = "renderer/techniques/voxelization/";
    AxisVolumes::Form form = pixelClip(FragmentBlend::Separate, {});
    form.stages = {folder + "slice.vert.glsl", folder + "slicing.geom.glsl", folder + "slice.frag.glsl"};
    return form;
  }

  /// Occupied voxels; without a form, of the image store, which assigns triangles to axes as well.
  static std::vector<uint8_t> occupied(const scene::Scene& scene, const voxels::VoxelGrid& grid,
                                       std::optional<AxisVolumes::Form> form) {
    if (!form) return voxelize(scene, grid, voxels::Coverage::Dominant);
    form->defines["CAP"] = "128";
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {16, 16});
    const voxels::Volume volume(context(), grid, gpuScene.anchor());
    AxisVolumes volumes(frame, volume, *form);
    frame.begin();
    volumes.fill(frame, volume);
    frame.end();
    return volume.readOccupied();
  }

  template <class With>
  static void fill(const scene::Scene& scene, const voxels::VoxelGrid& grid, const AxisVolumes::Form& form,
                   With with) {
    const voxels::VolumeAttributes attributes{.albedo = true,
                                              .normal = true,
                                              .format = gl::Format::RGBA32F,
                                              .occupancy = true,
                                              .light = true,
                                              .shGrey = true,
                                              .shColour = true,
                                              .summed = false,
                                              .largestLight = 4.0F};
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {16, 16});
    const voxels::Volume volume(context(), grid, gpuScene.anchor(), attributes);
    AxisVolumes volumes(frame, volume, form);
    frame.begin();
    volumes.fill(frame, volume);
    frame.end();
    std::vector<std::array<Image, voxels::kVoxelAttributes>> layers(static_cast<size_t>(grid.resolution.z));
    for (int z = 0; z < grid.resolution.z; ++z)
      for (size_t i = 0; i < voxels::kVoxelAttributes; ++i)
        layers[static_cast<size_t>(z)][i] = volume.attachment(static_cast<VoxelAttribute>(i)).readLayer(z);
    with(layers);
  }
};

// A rasteriser knows pixels to 1 / 256.
constexpr double kRasterSlack = 1.0 / 100.0;

// Triangles of all directions, of 3 to 25 voxels: three axes merged by either geometry shader, and one pass
// over an image, have voxel for voxel the set in double precision; of a smooth surface they share all but
// 0.2 %.
TEST_F(AxisVolumesTest, MergedAxesAreTheSetOfTheImageStore) {
  scene::Scene soup;
  scene::Mesh mesh;
  scene::Random random(11);
  for (int i = 0; i < 80; ++i) {
    const glm::dvec3 middle{random.uniform(-1, 1), random.uniform(-0.6, 0.6), random.uniform(-0.8, 0.8)};
    const glm::dvec3 u = random.direction(), v = glm::cross(u, random.direction());
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec3 corner : {u, -0.7 * u + v, -0.6 * u - v})
      mesh.positions.push_back(middle + (i % 2 == 0 ? 0.7 : 0.2) * corner);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  scene::addPart(soup, mesh, voxels::plainMaterial(glm::vec3(0.5F)));
  const voxels::VoxelGrid grid = voxels::tightGrid(soup.bounds(), 28);
  soup.lights = voxels::litCorner().lights;
  const voxels::VoxelOracle oracle(soup, grid, {.shadows = false});
  const std::vector<uint8_t> sets[] = {occupied(soup, grid, {}), occupied(soup, grid, slicing()),
                                       occupied(soup, grid, pixelClip(FragmentBlend::Separate, {}))};
  int filled = 0, close = 0;
  glm::ivec3 v;
  for (v.z = 0; v.z < grid.resolution.z; ++v.z)
    for (v.y = 0; v.y < grid.resolution.y; ++v.y)
      for (v.x = 0; v.x < grid.resolution.x; ++v.x) {
        const voxels::OracleVoxel expected = oracle.at(v, voxels::Coverage::Dominant, kRasterSlack);
        close += expected.close;
        if (expected.close) continue;
        filled += expected.entries > 0.0;
        for (const std::vector<uint8_t>& set : sets)
          ASSERT_EQ(set[static_cast<size_t>(grid.indexOf(v))], expected.entries > 0.0 ? 1 : 0)
              << &set - sets << " at " << v.x << " " << v.y << " " << v.z;
      }
  EXPECT_GT(filled, 800);
  EXPECT_LT(close, filled / 4) << filled;

  scene::Scene ball;
  scene::addPart(ball, scene::sphere({0.013, 0.027, -0.041}, 1.0, 48),
                 voxels::plainMaterial(glm::vec3(0.5F)));
  voxels::VoxelGrid around;
  around.origin = glm::dvec3(-1.13);
  around.resolution = glm::ivec3(70);
  around.voxelSize = 0.0331;
  const std::vector<uint8_t> stored = occupied(ball, around, {});
  for (const AxisVolumes::Form& form : {slicing(), pixelClip(FragmentBlend::Separate, {})}) {
    const voxels::SetDifference difference = voxels::compare(occupied(ball, around, form), stored);
    EXPECT_LE(double(difference.missing + difference.extra), 0.002 * double(voxels::countOf(stored)));
  }
}

// Two lamps' light sums and is the mean of fragments, albedo and opacity are the largest, and normals of both
// signs are means.
TEST_F(AxisVolumesTest, EachAttachmentHasItsOwnBlending) {
  const scene::Scene scene = voxels::litCorner();
  const voxels::VoxelGrid grid = voxels::tightGrid(scene.bounds(), 20);
  const voxels::VoxelLamps lamps{.strength = 0.5, .all = true};
  const voxels::VoxelOracle oracle(scene, grid, lamps);
  struct Case {
    AxisVolumes::Form form;
    voxels::Coverage coverage;  // axes along which it draws a triangle
  };
  for (const Case& one : {Case{pixelClip(FragmentBlend::Separate, lamps), voxels::Coverage::Dominant},
                          Case{slicePasses(FragmentBlend::Separate, lamps), voxels::Coverage::Thin}})
    fill(scene, grid, one.form, [&](const auto& layers) {
      int compared = 0, several = 0;
      for (int z = 0; z < grid.resolution.z; ++z)
        for (int y = 0; y < grid.resolution.y; ++y)
          for (int x = 0; x < grid.resolution.x; ++x) {
            const voxels::OracleVoxel expected = oracle.at({x, y, z}, one.coverage, kRasterSlack);
            if (expected.close) continue;
            const double full = expected.entries > 0.0 ? 1.0 : 0.0;
            compared += expected.entries > 0.0;
            several += expected.entries > 1.0;
            const glm::dvec4 values[voxels::kVoxelAttributes] = {{expected.largestOpacity, full, 0.0, 0.0},
                                                                 glm::dvec4(expected.largestAlbedo, full),
                                                                 glm::dvec4(expected.normal, full),
                                                                 glm::dvec4(expected.light, full),
                                                                 expected.grey,
                                                                 expected.colour[0],
                                                                 expected.colour[1],
                                                                 expected.colour[2]};
            for (size_t i = 0; i < voxels::kVoxelAttributes; ++i)
              for (int c = 0; c < 4; ++c)
                ASSERT_NEAR(layers[static_cast<size_t>(z)][i].at(x, y, c), values[i][c], i < 3 ? 1e-5 : 2e-3)
                    << i << " " << c << " at " << x << " " << y << " " << z;
          }
      EXPECT_GT(compared, 300);
      EXPECT_GT(several, 3);
    });
}

// With one blend equation for all, what is negative survives by its scale; of surfaces that meet the largest
// channel remains, which is the thesis's flaw.
TEST_F(AxisVolumesTest, AMaximumKeepsNegativeComponents) {
  scene::Scene scene;
  scene::addPart(scene, scene::card({0.0, 0.0, 0.0}, {0.5, 0.02, -0.3}, {0.1, -0.6, -0.2}),
                 voxels::plainMaterial(glm::vec3(0.5F), 0.0F, glm::vec3(1.0F)));
  const voxels::VoxelGrid grid = voxels::tightGrid(scene.bounds(), 12);
  const glm::uvec3 corners = scene.mesh.triangles[0];
  const glm::dvec3 a = scene.mesh.positions[corners.x];
  const glm::dvec3 normal =
      glm::normalize(glm::cross(scene.mesh.positions[corners.y] - a, scene.mesh.positions[corners.z] - a));
  EXPECT_LT(std::min({normal.x, normal.y, normal.z}), -0.1);
  fill(scene, grid, pixelClip(FragmentBlend::Maximum, {}), [&](const auto& layers) {
    int found = 0;
    for (const auto& layer : layers)
      for (int y = 0; y < grid.resolution.y; ++y)
        for (int x = 0; x < grid.resolution.x; ++x) {
          if (layer[0].at(x, y, 1) < 0.5F) continue;
          ++found;
          for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(layer[2].at(x, y, c), normal[c], 1e-5);
            // Emission 1: (0,0) and then y, z and x of a clamped cosine.
            ASSERT_NEAR(layer[5].at(x, y, c + 1), 1.023327 * normal[(c + 1) % 3], 1e-4);
          }
        }
    EXPECT_GT(found, 30);
  });
}

}  // namespace
}  // namespace limen::techniques
