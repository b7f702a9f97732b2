// SPDX-License-Identifier: BSD-3-Clause
// Light propagation volumes (Kaplanyan and Dachsbacher 2010; BL-04): one bounce of the lamp's light, spread
// through a grid that knows no surfaces, or only as blockers. Departures: the lamp of this bench shines to
// all sides, so that rays from it take the place of a reflective shadow map; one volume over the scene, not
// cascades; no damping by the gradient of the light.
#include <epoxy/gl.h>

#include <optional>
#include <string>

#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/indirect_picture.h"
#include "renderer/techniques/global_illumination/surface_light.h"
#include "renderer/techniques/global_illumination/voxel_dispatch.h"
#include "renderer/techniques/technique.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {
namespace {

constexpr const char *kFreeInjectPass = "global_illumination/inject",
                     *kFreePropagatePass = "global_illumination/propagate",
                     *kFreeReconstructPass = "global_illumination/reconstruct";

enum class VolumeLookup {
  Intensity,  ///< the intensity against the normal, half a voxel away (Kaplanyan and Dachsbacher 2010)
  Cosine      ///< the intensity's product with the clamped cosine, exact for light along the normal
};
constexpr EnumNames<VolumeLookup, 2> enumNames(VolumeLookup) {
  return {{{{VolumeLookup::Intensity, "intensity"}, {VolumeLookup::Cosine, "cosine"}}}};
}

enum class VolumeBlockers {
  None,
  Fronts,  ///< surfaces block light towards their fronts, as published
  Sides    ///< and towards their backs: also what they reflect themselves, which starts in their voxels
};
constexpr EnumNames<VolumeBlockers, 3> enumNames(VolumeBlockers) {
  return {{{{VolumeBlockers::None, "none"},
            {VolumeBlockers::Fronts, "fronts"},
            {VolumeBlockers::Sides, "sides"}}}};
}

struct PropagationVolumeSettings {
  int resolution = 32, iterations = 16, rays = 16384;
  double shift = 0.5;
  VolumeBlockers blockers = VolumeBlockers::None;
  VolumeLookup lookup = VolumeLookup::Intensity;
  frame::SurfaceLightSettings surfaces;
  static const SettingsTable<PropagationVolumeSettings>& table() {
    using S = PropagationVolumeSettings;
    constexpr const char* kPaper = "Kaplanyan and Dachsbacher 2010";
    static const SettingsTable<S> kTable = {
        {&S::resolution,
         "resolution",
         {4, 128},
         "voxels",
         "Along the longest side of the scene's box",
         kPaper},
        {&S::iterations, "iterations", {0, 256}, "", "Steps of a voxel that light travels", kPaper},
        {&S::rays,
         "rays",
         {64, 1048576},
         "",
         "From the lamp, in place of texels of a map",
         "the bench's own"},
        {&S::shift,
         "shift",
         {0.0, 2.0},
         "voxels",
         "From surfaces, where light starts and is looked up",
         kPaper},
        {&S::blockers, "blockers", "Which light the surfaces in a voxel block, by their normals", kPaper},
        {&S::lookup, "lookup", "How pixels get light from voxels", kPaper},
        included(&S::surfaces)};
    return kTable;
  }
};

class LightPropagationVolumes : public Technique {
 public:
  using Settings = PropagationVolumeSettings;
  explicit LightPropagationVolumes(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const std::string folder = "renderer/techniques/global_illumination/";
    gl::Context& context = frame.context();
    gl::ProgramCache& programs = context.programs();
    voxels::VolumeAttributes attributes{false, settings_.blockers != VolumeBlockers::None,
                                        gl::Format::RGBA16F};
    volume_.emplace(context, voxels::tightGrid(frame.scene().bounds(), settings_.resolution),
                    frame.gpuScene().anchor(), attributes);
    if (attributes.normal) voxelizer_.emplace(frame, voxels::Coverage::Thin, *volume_);
    gl::ShaderDefines defines = surfaceLightDefines(settings_.surfaces, frame);
    defines.merge(volume_->defines());
    inject_ = &programs.compute(folder + "light_propagation_volumes/reflective_rays.comp.glsl", defines);
    gl::ShaderDefines lookup = volume_->defines();
    defineEnum(lookup, "LOOKUP", settings_.lookup);
    picture_.emplace(frame, folder + "light_propagation_volumes/reconstruct_free.comp.glsl", lookup,
                     settings_.surfaces, kFreeReconstructPass);
    defines = volume_->defines();
    defines["FIELD_FORMAT"] = "rgba16f";
    seed_ = &programs.compute(folder + "voxel_propagation/seed.comp.glsl", defines);
    defines["TRANSPORT"] = "1", defines["TRANSPORT_MOMENTS"] = "0", defines["TRANSPORT_FACES"] = "1";
    defineEnum(defines, "BLOCKERS", settings_.blockers);
    propagate_ = &programs.compute(folder + "light_propagation_volumes/propagate_free.comp.glsl", defines);
    const glm::ivec3 size = volume_->grid().resolution;
    sums_.emplace(gl::Format::R32UI, glm::ivec2(size), 1, 12 * size.z);
    for (std::optional<gl::Texture>* texture : {&field_, &next_, &light_})
      texture->emplace(gl::Format::RGBA16F, glm::ivec2(size), 1, 3 * size.z);
    frame.passes().setBytesHeld(kFreeInjectPass, sums_->bytes());
    frame.passes().setBytesHeld(kFreePropagatePass, field_->bytes() + next_->bytes() + light_->bytes());
  }

  void render(frame::Frame& frame) override {
    if (voxelizer_) {
      const auto scope = frame.passes().open("global_illumination/voxelize");
      voxelizer_->run(frame, *volume_);
    }
    inject(frame);
    propagate(frame);
    picture_->render(frame, [&](const gl::Program& program) {
      volume_->configure(program);
      program.set("shift", static_cast<float>(settings_.shift));
      (settings_.iterations > 0 ? light_ : field_)->bindTexture(kReconstructArrivedUnit);
    });
  }

  const gl::Texture& product() const override { return picture_->texture(); }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"voxel_steps", double(volume_->grid().count()) * settings_.iterations},
            {"lamp_rays", double(settings_.rays)}};
  }

 private:
  void overField() const {
    const glm::ivec3 size = volume_->grid().resolution;
    dispatchVoxels({size.x, size.y, 3 * size.z});
  }

  void inject(frame::Frame& frame) {
    const auto scope = frame.passes().open(kFreeInjectPass);
    sums_->clearUint(glm::uvec4(0));
    configureSurfaceLight(*inject_, frame, settings_.surfaces);
    volume_->configure(*inject_);
    inject_->set("rayCount", settings_.rays);
    inject_->set("shift", static_cast<float>(settings_.shift));
    sums_->bindImage(kInjectSumsImage, gl::Access::ReadWrite);
    inject_->dispatch({settings_.rays, 1}, {kReflectiveRayGroup, 1});
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    volume_->configure(*seed_);
    seed_->set("sumSets", 1);
    field_->bindImage(kPropagateOutImage, gl::Access::Write);
    seed_->use();
    overField();
  }

  void propagate(frame::Frame& frame) {
    const auto scope = frame.passes().open(kFreePropagatePass);
    volume_->configure(*propagate_);
    light_->bindImage(kPropagateSumImage, gl::Access::ReadWrite);
    for (int step = 0; step < settings_.iterations; ++step) {
      field_->bindTexture(kPropagateFieldUnit);
      next_->bindImage(kPropagateOutImage, gl::Access::Write);
      propagate_->set("first", step == 0 ? 1 : 0);
      propagate_->use();
      overField();
      std::swap(field_, next_);
    }
  }

  Settings settings_;
  std::optional<voxels::Volume> volume_;
  std::optional<voxels::Voxelizer> voxelizer_;
  const gl::Program *inject_ = nullptr, *seed_ = nullptr, *propagate_ = nullptr;
  std::optional<gl::Texture> sums_, field_, next_, light_;
  std::optional<IndirectPicture> picture_;
};

const RegisteredTechnique<LightPropagationVolumes> kLightPropagationVolumesRegistered{
    {.name = "global_illumination/light_propagation_volumes",
     .version = 2,
     .summary = "One bounce of the lamp's light spread in a grid without surfaces, or with blockers",
     .source = "Kaplanyan and Dachsbacher 2010; Gaitatzes 2012, section 5.6 (BL-04)",
     .product = ProductKind::Colour,
     .counters = {{"voxel_steps", "Voxels times steps", "", Direction::LowerIsBetter},
                  {"lamp_rays", "Rays from the lamp", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
