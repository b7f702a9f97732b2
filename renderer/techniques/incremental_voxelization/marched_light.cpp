// SPDX-License-Identifier: BSD-3-Clause
// Light reflected once between surfaces, by rays through voxels that are kept from frame to frame or are
// those of one frame (IV-10, BL-07). Source: Gaitatzes 2012, sections 7.5 and 7.7, which marches rays or
// propagates light in such a volume; rays tell what the voxels are worth with nothing else in between. For
// the same picture with light propagated, see global_illumination/.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/techniques/incremental_voxelization/incremental_technique.h"
#include "renderer/techniques/incremental_voxelization/incremental_update.h"
#include "renderer/techniques/incremental_voxelization/marched_light_bindings.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::techniques {
namespace {

struct KeptVoxels {
  static constexpr const char *kKind = "kept", *kSummary = "cleaned up and filled in each frame";
  incremental_voxels::CleanUpSettings cleanUp;
  static const SettingsTable<KeptVoxels>& table() {
    static const SettingsTable<KeptVoxels> kTable = {
        {&KeptVoxels::cleanUp, "clean_up", "When a depth image disproves a voxel"}};
    return kTable;
  }
};
struct FrameVoxels {
  static constexpr const char *kKind = "frame", *kSummary = "of the current frame's depth images alone";
};

struct MarchedLightSettings {
  IncrementalSettings common;
  std::variant<KeptVoxels, FrameVoxels> voxels;
  incremental_voxels::PointSettings points;
  int directions = 128;
  double start = 1.5;
  static const SettingsTable<MarchedLightSettings>& table() {
    using S = MarchedLightSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        {&S::voxels, "voxels", "Which voxels light is taken from"},
        {&S::points, "points", "Points at which depth images are sampled"},
        {&S::directions,
         "directions",
         {8, 1024},
         "",
         "Directions over the whole sphere; half of them are a pixel's rays"},
        {&S::start,
         "start",
         {0.0, 4.0},
         "voxels",
         "Where rays start, before the surface along the axis that it faces most"}};
    return kTable;
  }
};

class MarchedLight : public IncrementalTechnique {
 public:
  using Settings = MarchedLightSettings;
  explicit MarchedLight(const Settings& settings)
      : IncrementalTechnique(settings.common, {.volume = true, .lit = true}), settings_(settings) {}

 protected:
  int64_t samplesPerView() const override { return settings_.points.perStep(); }
  int64_t prepareForm(frame::Frame& frame, const incremental_voxels::SampledVolume& volume, int views,
                      int used) override {
    IncrementalUpdate::Settings update{.kept = {}, .points = settings_.points};
    if (const auto* kept = std::get_if<KeptVoxels>(&settings_.voxels)) update.kept = kept->cleanUp;
    update_.emplace(frame.context(), update, volume, views, used);
    gl::ShaderDefines defines = volume.defines();
    defines["VIEWS"] = std::to_string(views);
    march_ = &frame.context().programs().compute(
        "renderer/techniques/incremental_voxelization/marched_light.comp.glsl", defines);
    return 0;
  }
  void update(const Step& step) override {
    update_->run(step.frame, step.volume, step.views, step.lighting, step.number);
  }
  void show(const Step& step, const gl::Texture& picture) override {
    step.volume.configure(*march_);
    incremental_voxels::configureViews(*march_, step.views, step.volume.grid(),
                                       step.frame.gpuScene().anchor());
    incremental_voxels::configureSampleLights(*march_, step.frame, step.lighting);
    step.volume.normal().bindTexture(voxels::kVolumeNormalUnit);
    step.volume.light().bindTexture(kMarchedVoxelLightUnit);
    march_->set("directions", settings_.directions);
    march_->set("startVoxels", static_cast<float>(settings_.start));
    picture.bindImage(kMarchedPictureImage, gl::Access::Write);
    march_->dispatch(picture.sizePx());
  }

 private:
  MarchedLightSettings settings_;
  std::optional<IncrementalUpdate> update_;
  const gl::Program* march_ = nullptr;
};

const RegisteredTechnique<MarchedLight> kMarchedLightRegistered{
    {.name = "incremental_voxelization/marched_light",
     .version = 4,
     .summary =
         "Light reflected once, by rays through voxels kept from frame to frame or through one frame's",
     .source = "Gaitatzes 2012, sections 7.5 and 7.7 (IV-10)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = IncrementalTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
