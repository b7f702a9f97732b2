// SPDX-License-Identifier: BSD-3-Clause
// Chooses the soft-shadow method that measurements show a scene's view to need (SS-45), and says why. Source:
// Schwarz 2009, section 5.1.1 and the advice of chapters 3 to 5. The thesis names criteria for the choice;
// here each is a comparison: the effect of a feature in a small picture of the scene decides whether it is
// used in the large one.
#include <optional>

#include "renderer/techniques/soft_shadows/bitmask/mask_gathering.h"
#include "renderer/techniques/soft_shadows/scene_needs/decision.h"
#include "renderer/techniques/soft_shadows/search_technique.h"

namespace limen::techniques {
namespace {

struct SceneNeedsSettings {
  CommonNeeds common;
  int probeDivisor = 4;
  NeedThresholds limits;
  static const SettingsTable<SceneNeedsSettings>& table();
};

class SceneNeeds : public Technique {
 public:
  using Settings = SceneNeedsSettings;
  explicit SceneNeeds(const SceneNeedsSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    ShadowProbe probe(frame, settings_.probeDivisor);
    decision_ = decideNeeds(frame, probe, settings_.common, settings_.limits);
    chosen_ = makeTechnique(decision_.setting);
    chosen_->prepare(frame);
  }
  void render(frame::Frame& frame) override { chosen_->render(frame); }
  const gl::Texture& product() const override { return chosen_->product(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = chosen_->count(frame);
    all.insert(all.end(), decision_.evidence.begin(), decision_.evidence.end());
    return all;
  }
  std::vector<std::string> remarks() const override {
    std::vector<std::string> all = {"chosen: " + describe(decision_.setting)};
    all.insert(all.end(), decision_.remarks.begin(), decision_.remarks.end());
    return all;
  }
  std::map<std::string, PictureMaker> pictures() const override { return chosen_->pictures(); }

 private:
  SceneNeedsSettings settings_;
  Decision decision_;
  std::unique_ptr<Technique> chosen_;
};

const SettingsTable<SceneNeedsSettings>& SceneNeedsSettings::table() {
  static const SettingsTable<SceneNeedsSettings> kTable = {
      included(&SceneNeedsSettings::common),
      {&SceneNeedsSettings::probeDivisor,
       "probe_divisor",
       {1, 64},
       "",
       "Factor by which width and height of the picture in which features are tried are smaller"},
      included(&SceneNeedsSettings::limits)};
  return kTable;
}

std::vector<Quantity> sceneNeedsQuantities() {
  std::vector<Quantity> all = SearchTechnique::quantities();
  for (Quantity& quantity : MaskGathering::quantities()) all.push_back(std::move(quantity));
  for (Quantity& quantity : evidenceQuantities()) all.push_back(std::move(quantity));
  return all;
}

const RegisteredTechnique<SceneNeeds> kSceneNeedsRegistered{
    {.name = "soft_shadows/scene_needs",
     .version = 1,
     .summary =
         "The cheapest soft shadows that measurements show a scene to need, with the reasons on record",
     .source = "Schwarz 2009, section 5.1.1 (SS-45)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = sceneNeedsQuantities()}};

}  // namespace
}  // namespace limen::techniques
