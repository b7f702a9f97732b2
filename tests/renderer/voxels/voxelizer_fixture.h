// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/frame/scene_on_gpu.h"
#include "renderer/gl/context.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::voxels {

/// One context for the whole program. A driver message of medium or high severity fails the test.
class VoxelizerFixture : public testing::Test {
 protected:
  static gl::Context& context() {
    static const std::unique_ptr<gl::Context> kContext = gl::createHeadlessContext();
    return *kContext;
  }
  void SetUp() override { context().makeCurrent(); }
  void TearDown() override {
    for (const gl::DebugMessage& message : context().takeDebugMessages())
      if (!message.performance || context().device().software) ADD_FAILURE() << message.text;
  }

  /// Voxels of a scene; `with` is called with the volume.
  template <class With>
  static std::vector<uint8_t> voxelize(const scene::Scene& scene, const VoxelGrid& grid, Coverage coverage,
                                       const VolumeAttributes& attributes, With with,
                                       const VoxelLamps& lamps = {}, uint32_t queueCapacity = 65536) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {16, 16});
    const Volume volume(context(), grid, gpuScene.anchor(), attributes);
    const Voxelizer voxelizer(frame, coverage, volume, lamps, queueCapacity);
    frame.begin();
    voxelizer.run(frame, volume);
    frame.end();
    with(volume);
    EXPECT_EQ(voxelizer.cutShort(), 0U);
    return volume.readOccupied();
  }
  static std::vector<uint8_t> voxelize(const scene::Scene& scene, const VoxelGrid& grid, Coverage coverage) {
    return voxelize(scene, grid, coverage, {}, [](const Volume&) {});
  }
};

}  // namespace limen::voxels
