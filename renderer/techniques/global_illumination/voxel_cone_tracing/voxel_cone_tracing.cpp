// SPDX-License-Identifier: BSD-3-Clause
// Indirect light by cones through voxels (Crassin et al. 2011), a newer way with the same voxels, to compare
// voxel_propagation with: a dense pyramid in place of an octree; further bounces by cones from the voxels.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/surface_light.h"
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
    gl::ShaderDefines defines = surfaceLightDefines(settings_.surfaces, frame);
    defines.merge(pyramid_->defines());
    gather_ = &frame.context().programs().compute(
        "renderer/techniques/global_illumination/voxel_cone_tracing/gather_cones.comp.glsl", defines);
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("global_illumination/pyramid", pyramid_->bytes());
    frame.passes().setBytesHeld(kGatherConesPass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    pyramid_->make(frame);
    const auto scope = frame.passes().open(kGatherConesPass);
    configureSurfaceLight(*gather_, frame, settings_.surfaces);
    pyramid_->configure(*gather_);
    gather_->set("withDirect", settings_.surfaces.light != frame::LightPart::Indirect ? 1 : 0);
    gather_->set("withIndirect", settings_.surfaces.light != frame::LightPart::Direct ? 1 : 0);
    ids.bindTexture(kReconstructIdsUnit);
    picture_->bindImage(kReconstructOutImage, gl::Access::Write);
    gather_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"surface_samples", double(pyramid_->samples())}, {"pyramid_bytes", double(pyramid_->bytes())}};
  }

 private:
  Settings settings_;
  std::optional<RadiancePyramid> pyramid_;
  const gl::Program* gather_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<VoxelConeTracing> kVoxelConeTracingRegistered{
    {.name = "global_illumination/voxel_cone_tracing",
     .version = 1,
     .summary = "Light gathered by six cones a point through a pyramid of voxels",
     .source = "Crassin et al. 2011; a comparator for Gaitatzes 2012, chapter 5",
     .product = ProductKind::Colour,
     .counters = {
         {"surface_samples", "Points of surfaces that light is put in from", "", Direction::LowerIsBetter},
         {"pyramid_bytes", "Memory of the voxels and their pyramid", "B", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
