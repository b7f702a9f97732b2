// SPDX-License-Identifier: BSD-3-Clause
// Clean-up and injection in one, at voxels' middles (IV-08). Source: Gaitatzes 2012, section 7.4.3.
#include "renderer/incremental_voxels/single_pass.h"

#include <optional>
#include <vector>

#include "renderer/techniques/incremental_voxelization/incremental_technique.h"

namespace limen::techniques {
namespace {

struct SinglePassSettings {
  IncrementalSettings common;
  bool attributes = true;
  incremental_voxels::CleanUpBias bias = incremental_voxels::RadiusBias{};
  bool sky = true;
  BrickDecision bricks = BrickDecision::None;
  static const SettingsTable<SinglePassSettings>& table() {
    using S = SinglePassSettings;
    static const SettingsTable<S> kTable = {
        included(&S::common),
        {&S::attributes, "attributes", "Normal, reflectance and light of each voxel besides occupancy"},
        {&S::bias, "bias", "How far a voxel's middle may lie from what is seen there to be filled",
         "Gaitatzes 2012, section 7.4.1"},
        {&S::sky, "sky", "Pixels that see nothing see through voxels"},
        {&S::bricks, "bricks",
         "How whole bricks of 32 x 8 x 8 voxels are decided at once; changes no voxel"}};
    return kTable;
  }
};

class SinglePassTechnique : public IncrementalTechnique {
 public:
  using Settings = SinglePassSettings;
  explicit SinglePassTechnique(const Settings& settings)
      : IncrementalTechnique(settings.common, {.volume = settings.attributes, .lit = settings.attributes}),
        cleanUp_{.bias = settings.bias, .proof = incremental_voxels::Proof::Centre, .sky = settings.sky},
        bricks_(settings.bricks) {}

 protected:
  int64_t samplesPerView() const override { return 1; }
  int64_t prepareForm(frame::Frame& frame, const incremental_voxels::SampledVolume& volume, int views,
                      int used) override {
    pass_.emplace(frame.context(), cleanUp_, volume, views, used,
                  bricks_ == BrickDecision::Tiles ? viewSizesPx(frame, used) : std::vector<glm::ivec2>());
    return pass_->bytes();
  }
  void update(const Step& step) override {
    const auto scope = step.frame.passes().open("incremental_voxelization/clean_up");
    pass_->run(step.frame, step.volume, step.views, step.lighting);
  }

 private:
  incremental_voxels::CleanUpSettings cleanUp_;
  BrickDecision bricks_;
  std::optional<incremental_voxels::SinglePass> pass_;
};

const RegisteredTechnique<SinglePassTechnique> kSinglePassRegistered{
    {.name = "incremental_voxelization/single_pass",
     .version = 3,
     .summary = "Clean-up and injection in one: each voxel takes what depth images show at its middle",
     .source = "Gaitatzes 2012, section 7.4.3 (IV-08)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = IncrementalTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
