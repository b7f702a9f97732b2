// SPDX-License-Identifier: BSD-3-Clause
// Chooses among the soft-shadow methods what a scene is measured to need in its view (SS-45), and says why.
// Source: Schwarz 2009, section 5.1.1 and the advice of chapters 3 to 5. The thesis names signs by which to
// choose; here each is a comparison: what a feature changes in a small picture of the scene decides whether
// it is there in the large one.
#include <optional>

#include "renderer/techniques/soft_shadows/bitmask/bitmask.h"
#include "renderer/techniques/soft_shadows/scene_needs/decision.h"

namespace limen::techniques {
namespace {

class SceneNeeds : public Technique {
 public:
  explicit SceneNeeds(const ParameterValues& values)
      : divisor_(static_cast<int>(values.integer("probe_divisor"))),
        limits_{values.real("tolerance"), values.real("hard_penumbra"), values.real("coarse_share"),
                values.real("seam_share"), values.real("build_weight")},
        common_{{"resolution", values.text("resolution")},
                {"budget", values.integer("budget")},
                {"raster", values.text("raster")}} {}

  void prepare(frame::Frame& frame) override {
    ShadowProbe probe(frame, divisor_);
    decision_ = decideNeeds(frame, probe, common_, limits_);
    chosen_ = decision_.setting.make();
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
    std::vector<std::string> all = {"chosen: " + settingText()};
    all.insert(all.end(), decision_.remarks.begin(), decision_.remarks.end());
    return all;
  }
  std::map<std::string, Image> pictures() const override { return chosen_->pictures(); }

 private:
  std::string settingText() const {
    std::string text = decision_.setting.technique;
    for (const auto& [name, value] : decision_.setting.values)
      text += ", " + name + "=" + limen::toText(value);
    return text;
  }

  int divisor_;
  NeedThresholds limits_;
  std::map<std::string, ParameterValue> common_;
  Decision decision_;
  std::unique_ptr<Technique> chosen_;
};

std::vector<Parameter> sceneNeedsParameters() {
  std::vector<Parameter> all;
  for (const Parameter& parameter : OccluderSearch::searchParameters({"micropatches"}))
    if (parameter.name == "resolution" || parameter.name == "budget" || parameter.name == "raster")
      all.push_back(parameter);
  all.push_back(
      integerParameter("probe_divisor", 4, 1, 64, "",
                       "The picture that features are tried in has this part of the width and the height"));
  all.push_back(
      realParameter("tolerance", 1.0 / 256.0, 0.0, 1.0, "",
                    "Mean change of visibility where there is shadow, up to which a feature is left out"));
  all.push_back(realParameter("hard_penumbra", 1.0, 0.0, 64.0, "texel",
                              "Widest penumbra that is shown as a hard edge", "Schwarz 2009, section 3.2.1"));
  all.push_back(
      realParameter("coarse_share", 0.25, 0.0, 1.0, "",
                    "Share of pixels with coarse micro-occluders from which on these are microrects",
                    "Schwarz 2009, section 4.4.4"));
  all.push_back(realParameter("seam_share", 0.05, 0.0, 1.0, "",
                              "Share of neighbours with different levels from which on levels are blended",
                              "Schwarz 2009, section 5.2.1"));
  all.push_back(realParameter("build_weight", 1.0, 0.0, 1e6, "",
                              "Micro-occluders that must be saved for each texel of a Y shadow map",
                              "Schwarz 2009, section 4.3.2"));
  return all;
}

std::vector<Quantity> counters() {
  std::vector<Quantity> all = Bitmask::counterNames();
  const std::vector<std::string> evidence = evidenceNames();
  all.insert(all.end(), evidence.begin(), evidence.end());
  return all;
}

const Registered<TechniqueInfo> kSceneNeedsRegistered{
    {.name = "soft_shadows/scene_needs",
     .version = 1,
     .summary = "The cheapest soft shadows that a scene is measured to need, with the reasons on record",
     .source = "Schwarz 2009, section 5.1.1 (SS-45)",
     .product = ProductKind::Visibility,
     .parameters = sceneNeedsParameters(),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<SceneNeeds>(values); },
     .errorBound = {},
     .counters = counters()}};

}  // namespace
}  // namespace limen::techniques
