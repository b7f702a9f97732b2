// SPDX-License-Identifier: BSD-3-Clause
// Indirect light from a grid of voxels with occlusion and several bounces (Gaitatzes 2012, chapter 5; GI-03
// to GI-13). Light is the flux and vector of a voxel, which are harmonics of two bands. What departs from the
// thesis, each a choice of a parameter where it can be:
//
// - A voxel's light leaves it as the lobe of its flux and mean direction does (`transport: moments`): every
//   direction of the lobe goes on through the faces that it meets, as it is. The rule printed, and light
//   propagation volumes, turn what passes a face into a lobe about one of six axes at each step, so that
//   light is scattered in empty space; it stays near its source, and the picture is farther from the truth
//   than one without indirect light.
// - Sources last (`steps: {sources: steady}`), so that what arrives need not be summed over steps, and the
//   light of one frame is where that of the next begins.
// - Light is put in by samples of the surfaces with their areas and a ray to the lamp, in place of fragments
//   of voxels and a shadow map, into the empty voxel in front.
// - Occupied voxels hold no light but what passes transparent surfaces. What reaches one comes back in the
//   voxel that sent it.
// - Voxels that a pixel's light is interpolated between must be seen from it where walls meet: floors beside
//   a thin wall would else have the light of its other side.
// - What a voxel reflects is diffuse (`reflection`), and what arrives is kept for each of its faces.
#include <algorithm>
#include <optional>
#include <string>
#include <variant>

#include "renderer/techniques/frames_before.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/indirect_picture.h"
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "renderer/techniques/global_illumination/voxel_propagation/reconstruction_settings.h"
#include "renderer/techniques/global_illumination/voxel_propagation/seen_light.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kVoxelReconstructPass = "global_illumination/reconstruct";

struct VoxelPropagationSettings {
  LightGridSettings grid;
  ReconstructionSettings reconstruction;
  FramesBefore before;
  frame::SurfaceLightSettings surfaces;
  static const SettingsTable<VoxelPropagationSettings>& table() {
    using S = VoxelPropagationSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::reconstruction, "reconstruction", "How pixels get light from voxels"},
        {&S::before, "before", "Frames before the first picture"},
        included(&S::surfaces)};
    return kTable;
  }
};

class VoxelPropagation : public Technique {
 public:
  using Settings = VoxelPropagationSettings;
  explicit VoxelPropagation(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    light_.emplace(frame, settings_.grid, settings_.surfaces);
    gl::ShaderDefines defines = light_->volume().defines();
    settings_.reconstruction.define(defines);
    if (const auto* visible = std::get_if<VisibleWeights>(&settings_.reconstruction.weights))
      seen_.emplace(frame, defines, settings_.surfaces, kVoxelReconstructPass, visible->widest);
    else
      picture_.emplace(frame,
                       "renderer/techniques/global_illumination/voxel_propagation/reconstruct.comp.glsl",
                       defines, settings_.surfaces, kVoxelReconstructPass);
    settings_.before.renderAll(frame, [this](frame::Frame& before) { light_->update(before); });
  }

  void render(frame::Frame& frame) override {
    light_->update(frame);
    const auto gathers = [&](const gl::Program& program) {
      light_->volume().configure(program);
      light_->arrived().bindTexture(kReconstructArrivedUnit);
      light_->lightCells().bindTexture(kLightCellsUnit);
    };
    if (seen_)
      seen_->render(frame, gathers, light_->tree());
    else
      picture_->render(frame, gathers, light_->tree());
  }

  std::vector<Series> series() const override {
    return {
        {"flux_after_step",
         "Flux that was put in once, before the first step and after each, mean of the channels, radiance "
         "times area",
         fluxAfterStep_}};
  }

  const gl::Texture& product() const override { return seen_ ? seen_->texture() : picture_->texture(); }

  std::vector<std::string> remarks() const override {
    if (!light_ || light_->stepsRemark().empty()) return {};
    light_->checkSteps();  // asked for again after the last frame
    return {light_->stepsRemark()};
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    light_->checkSteps();
    const auto meanFlux = [&] {
      const glm::dvec3 flux = light_->flux();
      return (flux.r + flux.g + flux.b) / 3.0;
    };
    const SeenLight::Costs costs = seen_ ? seen_->costs() : SeenLight::Costs{};
    light_->start(frame);
    const double injected = meanFlux();
    fluxAfterStep_ = {injected};
    double largest = 0.0, last = 0.0;
    for (int step = 0; step < settings_.grid.iterations; ++step) {
      light_->propagate();
      const double before = fluxAfterStep_.back(), after = meanFlux();
      last = before > 0.0 ? after / before : 0.0;
      largest = std::max(largest, last);
      fluxAfterStep_.push_back(after);
    }
    const voxels::VoxelGrid& grid = light_->volume().grid();
    // Costs first: reports draw the first counter that differs.
    return {{"voxel_steps", double(grid.count()) * settings_.grid.iterations * settings_.grid.generations()},
            {"injected_flux", injected},
            {"largest_gain", largest},
            {"last_gain", last},
            {"remaining_flux", injected > 0.0 ? fluxAfterStep_.back() / injected : 0.0},
            {"homeless_samples", double(light_->homeless())},
            {"visibility_rays_per_px", costs.raysPerPx},
            {"searching_px_share", costs.searchingShare}};
  }

 private:
  Settings settings_;
  std::optional<LightGrid> light_;
  std::vector<double> fluxAfterStep_;
  std::optional<SeenLight> seen_;
  std::optional<IndirectPicture> picture_;
};

const RegisteredTechnique<VoxelPropagation> kVoxelPropagationRegistered{
    {.name = "global_illumination/voxel_propagation",
     .version = 5,
     .summary = "Light spread and reflected in a grid of voxels, as harmonics of two bands",
     .source = "Gaitatzes 2012, chapter 5 (GI-03 to GI-13)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = {
         {"injected_flux", "Flux put into the grid, mean of the channels, radiance times area", "",
          Direction::Neither},
         {"largest_gain", "Largest ratio of the flux after a step to that before, of light put in once", "",
          Direction::Neither},
         {"last_gain", "Ratio of the flux after the last step to that before, of light put in once", "",
          Direction::Neither},
         {"remaining_flux", "Flux still on its way after the last step, share of what was put in once", "",
          Direction::LowerIsBetter},
         {"homeless_samples", "Samples of surfaces whose light found no empty voxel", "",
          Direction::LowerIsBetter},
         {"visibility_rays_per_px",
          "Rays from pixels' points to voxels around them, where only rays tell which are seen", "1/px",
          Direction::LowerIsBetter},
         {"searching_px_share", "Pixels that see no lit voxel around them at some face, and look farther", "",
          Direction::LowerIsBetter},
         {"voxel_steps", "Voxels times steps, of all bounces that have fields of their own", "",
          Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
