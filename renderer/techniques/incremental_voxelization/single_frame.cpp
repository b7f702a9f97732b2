// SPDX-License-Identifier: BSD-3-Clause
// Voxels of one frame's depth images, nothing kept (BL-07): what incremental voxelization is compared with.
// Source: Gaitatzes 2012, section 7.7.
#include <optional>

#include "renderer/techniques/incremental_voxelization/incremental_technique.h"
#include "renderer/techniques/incremental_voxelization/incremental_update.h"

namespace limen::techniques {
namespace {

struct SingleFrameSettings {
  IncrementalSettings common;
  bool attributes = true;
  incremental_voxels::PointSettings points{.shift = false};
  static const SettingsTable<SingleFrameSettings>& table() {
    using S = SingleFrameSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        {&S::attributes, "attributes", "Normal, reflectance and light of each voxel besides occupancy"},
        {&S::points, "points", "Points at which depth images are sampled"}};
    return kTable;
  }
};

class SingleFrame : public IncrementalTechnique {
 public:
  using Settings = SingleFrameSettings;
  explicit SingleFrame(const Settings& settings)
      : IncrementalTechnique(settings.common, {.volume = settings.attributes, .lit = settings.attributes}),
        settings_(settings) {}

 protected:
  int64_t samplesPerView() const override { return settings_.points.perStep(); }
  int64_t prepareForm(frame::Frame& frame, const incremental_voxels::SampledVolume& volume, int views,
                      int used) override {
    update_.emplace(frame.context(), IncrementalUpdate::Settings{.kept = {}, .points = settings_.points},
                    volume, views, used);
    return 0;
  }
  void update(const Step& step) override {
    update_->run(step.frame, step.volume, step.views, step.lighting, step.number);
  }

 private:
  SingleFrameSettings settings_;
  std::optional<IncrementalUpdate> update_;
};

const RegisteredTechnique<SingleFrame> kSingleFrameRegistered{
    {.name = "incremental_voxelization/single_frame",
     .version = 3,
     .summary = "Voxels of what the current frame's depth images show; nothing is kept",
     .source = "Gaitatzes 2012, section 7.7 (BL-07)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = IncrementalTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
