// SPDX-License-Identifier: BSD-3-Clause
// Indirect light from a grid of voxels with occlusion and several bounces (Gaitatzes 2012, chapter 5; GI-03
// to GI-11). Choices of the bench's own, each a parameter where it can be: light is put in by samples of the
// surfaces with their areas and a ray to the lamp, in place of fragments of voxels and a shadow map; what
// leaves a voxel is scaled to what it holds (`shares`), as cutting negative cones off creates energy;
// occupied voxels light empty ones alone (`exchange`), as a wall would light itself; what they reflect is
// diffuse.
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/surface_light.h"
#include "renderer/techniques/global_illumination/voxel_grid/light_grid.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kPropagatePass = "global_illumination/propagate",
                     *kReconstructPass = "global_illumination/reconstruct";

enum class GatherWeights { Occupied, All };
constexpr EnumNames<GatherWeights, 2> enumNames(GatherWeights) {
  return {{{{GatherWeights::Occupied, "occupied"}, {GatherWeights::All, "all"}}}};
}

struct VoxelGridSettings {
  LightGridSettings grid;
  GatherWeights interpolation = GatherWeights::Occupied;
  frame::SurfaceLightSettings surfaces;
  static const SettingsTable<VoxelGridSettings>& table() {
    using S = VoxelGridSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::interpolation, "interpolation", "Which voxels a pixel's light is interpolated between",
         "Gaitatzes 2012, section 5.5.3 (occupied)"},
        included(&S::surfaces)};
    return kTable;
  }
};

class VoxelGridLight : public Technique {
 public:
  using Settings = VoxelGridSettings;
  explicit VoxelGridLight(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    light_.emplace(frame, settings_.grid, settings_.surfaces);
    gl::ShaderDefines defines = surfaceLightDefines(settings_.surfaces, frame);
    defines.merge(light_->volume().defines());
    reconstruct_ = &frame.context().programs().compute(
        "renderer/techniques/global_illumination/voxel_grid/reconstruct.comp.glsl", defines);
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kPropagatePass, light_->bytes());
    frame.passes().setBytesHeld(kReconstructPass, picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    light_->start(frame);
    {
      const auto scope = frame.passes().open(kPropagatePass);
      for (int step = 0; step < settings_.grid.iterations; ++step) light_->propagate();
    }
    const auto scope = frame.passes().open(kReconstructPass);
    configureSurfaceLight(*reconstruct_, frame, settings_.surfaces);
    light_->volume().configure(*reconstruct_);
    reconstruct_->set("withDirect", settings_.surfaces.light != frame::LightPart::Indirect ? 1 : 0);
    reconstruct_->set("withIndirect", settings_.surfaces.light != frame::LightPart::Direct ? 1 : 0);
    reconstruct_->set("occupiedOnly", settings_.interpolation == GatherWeights::Occupied ? 1 : 0);
    ids.bindTexture(kReconstructIdsUnit);
    light_->gathered().bindTexture(kReconstructGatheredUnit);
    picture_->bindImage(kReconstructOutImage, gl::Access::Write);
    reconstruct_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    const auto meanFlux = [&] {
      const glm::dvec3 flux = light_->flux();
      return (flux.r + flux.g + flux.b) / 3.0;
    };
    light_->start(frame);
    const double injected = meanFlux();
    double before = injected, largest = 0.0, last = 0.0;
    for (int step = 0; step < settings_.grid.iterations; ++step) {
      light_->propagate();
      const double after = meanFlux();
      last = before > 0.0 ? after / before : 0.0;
      largest = std::max(largest, last);
      before = after;
    }
    const voxels::VoxelGrid& grid = light_->volume().grid();
    return {{"injected_flux", injected},
            {"largest_gain", largest},
            {"last_gain", last},
            {"remaining_flux", injected > 0.0 ? before / injected : 0.0},
            {"voxel_steps", double(grid.count()) * settings_.grid.iterations}};
  }

 private:
  Settings settings_;
  std::optional<LightGrid> light_;
  const gl::Program* reconstruct_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<VoxelGridLight> kVoxelGridRegistered{
    {.name = "global_illumination/voxel_grid",
     .version = 1,
     .summary = "Light spread and reflected in a grid of voxels, as harmonics of two bands",
     .source = "Gaitatzes 2012, chapter 5 (GI-03 to GI-11)",
     .product = ProductKind::Colour,
     .counters = {
         {"injected_flux", "Flux put into the grid, mean of the channels, radiance times area", "",
          Direction::Neither},
         {"largest_gain", "Largest ratio of the flux after a step to that before", "", Direction::Neither},
         {"last_gain", "Ratio of the flux after the last step to that before", "", Direction::Neither},
         {"remaining_flux", "Flux still on its way after the last step, share of the injected", "",
          Direction::LowerIsBetter},
         {"voxel_steps", "Voxels times steps", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
