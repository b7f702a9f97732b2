// SPDX-License-Identifier: BSD-3-Clause
// Indirect light by cones through voxels (Crassin et al. 2011), a newer way with the same voxels, to compare
// voxel_propagation with: a dense pyramid in place of an octree; further bounces by cones from the voxels.
#include <optional>

#include "renderer/techniques/global_illumination/indirect_picture.h"
#include "renderer/techniques/global_illumination/voxel_cone_tracing/radiance_pyramid.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kGatherConesPass = "global_illumination/gather";

struct VoxelConeSettings {
  RadiancePyramidSettings pyramid;
  frame::SurfaceLightSettings surfaces;
  static const SettingsTable<VoxelConeSettings>& table() {
    using S = VoxelConeSettings;
    static const SettingsTable<S> kTable = {included(&S::pyramid), included(&S::surfaces)};
    return kTable;
  }
};

class VoxelConeTracing : public Technique {
 public:
  using Settings = VoxelConeSettings;
  explicit VoxelConeTracing(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    pyramid_.emplace(frame, settings_.pyramid, settings_.surfaces);
    picture_.emplace(frame,
                     "renderer/techniques/global_illumination/voxel_cone_tracing/gather_cones.comp.glsl",
                     pyramid_->defines(), settings_.surfaces, kGatherConesPass);
    frame.passes().setBytesHeld("global_illumination/pyramid", pyramid_->bytes());
  }

  void render(frame::Frame& frame) override {
    pyramid_->make(frame);
    picture_->render(
        frame, [&](const gl::Program& program) { pyramid_->configure(program); }, pyramid_->tree());
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"surface_samples", double(pyramid_->samples())}, {"pyramid_bytes", double(pyramid_->bytes())}};
  }

 private:
  Settings settings_;
  std::optional<RadiancePyramid> pyramid_;
  std::optional<IndirectPicture> picture_;
};

const RegisteredTechnique<VoxelConeTracing> kVoxelConeTracingRegistered{
    {.name = "global_illumination/voxel_cone_tracing",
     .version = 3,
     .summary = "Light gathered by six cones a point through a pyramid of voxels",
     .source = "Crassin et al. 2011; a comparator for Gaitatzes 2012, chapter 5",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = {
         {"surface_samples", "Points of surfaces that light is put in from", "", Direction::LowerIsBetter},
         {"pyramid_bytes", "Memory of the voxels and their pyramid", "B", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
