// SPDX-License-Identifier: BSD-3-Clause
// Voxels kept from frame to frame: those that a depth image disproves are emptied, then points of the images
// fill the voxels that they lie in (IV-01 to IV-07, IV-11, IV-12). Source: Gaitatzes 2012, section 7.4, whose
// formula for the depth has the wrong sign. Departures: in place, by compute shaders that visit occupied
// voxels alone; a voxel that its middle's pixel disproves stays if another pixel sees a surface in it, which
// else would be emptied and filled again in every frame; points move within their cells; attributes are means
// over a voxel's samples, light is stored as radiance instead of as harmonics, which follow from it and the
// normal; the light's samples count as their mean, not as a sum of fluxes, which would depend on the map.
#include <optional>
#include <vector>

#include "renderer/techniques/incremental_voxelization/incremental_technique.h"
#include "renderer/techniques/incremental_voxelization/incremental_update.h"

namespace limen::techniques {
namespace {

/// Where voxels are tested.
enum class CleanUpRegion {
  Everywhere,
  Moving  ///< where parts that move have been; voxels of what stands still are never stale
};
constexpr EnumNames<CleanUpRegion, 2> enumNames(CleanUpRegion) {
  return {{{{CleanUpRegion::Everywhere, "everywhere"}, {CleanUpRegion::Moving, "moving"}}}};
}

struct TwoStageSettings {
  IncrementalSettings common;
  bool attributes = true;
  incremental_voxels::CleanUpSettings cleanUp;
  CleanUpRegion region = CleanUpRegion::Everywhere;
  BrickDecision bricks = BrickDecision::None;
  incremental_voxels::PointSettings points;
  static const SettingsTable<TwoStageSettings>& table() {
    using S = TwoStageSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        {&S::attributes, "attributes", "Normal, reflectance and light of each voxel besides occupancy"},
        {&S::cleanUp, "clean_up", "When a depth image disproves a voxel"},
        {&S::region, "region", "Where voxels are tested", "Gaitatzes 2012, section 7.8"},
        {&S::bricks, "bricks", "How whole bricks of 32 x 8 x 8 voxels are decided at once; changes no voxel"},
        {&S::points, "points", "Points at which depth images are sampled"}};
    return kTable;
  }
};

class TwoStage : public IncrementalTechnique {
 public:
  using Settings = TwoStageSettings;
  explicit TwoStage(const Settings& settings)
      : IncrementalTechnique(settings.common, {.volume = settings.attributes, .lit = settings.attributes}),
        settings_(settings) {}

 protected:
  int64_t samplesPerView() const override { return settings_.points.perStep(); }
  int64_t prepareForm(frame::Frame& frame, const incremental_voxels::SampledVolume& volume, int views,
                      int used) override {
    update_.emplace(frame.context(),
                    IncrementalUpdate::Settings{.kept = settings_.cleanUp,
                                                .points = settings_.points,
                                                .tiledPx = settings_.bricks == BrickDecision::Tiles
                                                               ? viewSizesPx(frame, used)
                                                               : std::vector<glm::ivec2>()},
                    volume, views, used);
    if (settings_.region == CleanUpRegion::Moving) bricks_.emplace(frame.scene(), volume.grid());
    return update_->bytes() + (bricks_ ? bricks_->list().bytes() : 0);
  }
  void update(const Step& step) override {
    update_->run(step.frame, step.volume, step.views, step.lighting, step.number,
                 bricks_ ? &*bricks_ : nullptr);
  }

  void moved(const voxels::VoxelGrid& grid, glm::ivec3 by) override {
    if (bricks_) bricks_->moveTo(grid, by);
  }

 private:
  TwoStageSettings settings_;
  std::optional<incremental_voxels::MovingBricks> bricks_;
  std::optional<IncrementalUpdate> update_;
};

const RegisteredTechnique<TwoStage> kTwoStageRegistered{
    {.name = "incremental_voxelization/two_stage",
     .version = 3,
     .summary =
         "Voxels kept from frame to frame: what depth images disprove is emptied, what they show is filled",
     .source = "Gaitatzes 2012, section 7.4 (IV-02 to IV-07)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = IncrementalTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
