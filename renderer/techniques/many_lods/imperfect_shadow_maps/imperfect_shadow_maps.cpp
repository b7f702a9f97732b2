// SPDX-License-Identifier: BSD-3-Clause
// Instant radiosity with imperfect shadow maps: the rival whose points do not adapt to the view. Source:
// Ritschel and others 2008; Holländer 2013, sections 3.5.1 and 3.6.2. Lights, their sum, points and discs are
// those of many_lods/instant_radiosity, so that the choice of points alone differs.
#include <optional>

#include "renderer/many_lods/fixed_points.h"
#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/scene_tree.h"
#include "renderer/techniques/many_lods/shadow_bias.h"
#include "renderer/techniques/many_lods/virtual_lights.h"

namespace limen::techniques {
namespace {

constexpr const char* kFillPass = "many_lods/fill";

struct ImperfectSettings {
  VirtualLightSettings lights;
  TreeSettings tree;
  int64_t points = 8192;
  int tilePx = 64;
  int fillLevels = 3;
  double fillTolerance = 0.1;
  ShadowBias bias;
  ReceiverSurface receivers;
  static const SettingsTable<ImperfectSettings>& table() {
    using S = ImperfectSettings;
    static const SettingsTable<S> kTable = {
        included(&S::lights),
        included(&S::tree),
        {&S::points,
         "points",
         {16, 1048576},
         "",
         "Points of each shadow map",
         "Holländer 2013, table 3.1 (8 k)"},
        {&S::tilePx, "tile", oneOf({8, 16, 32, 64}), "px", "Side of a light's shadow map"},
        {&S::fillLevels,
         "fill_levels",
         {0, 3},
         "",
         "Levels from which holes are closed",
         "Ritschel and others 2008"},
        {&S::fillTolerance,
         "fill_tolerance",
         {0.0, 10.0},
         "",
         "Share of the depth by which depths of one surface differ when holes are closed",
         "Ritschel and others 2008 (no value)"},
        {&S::bias, "bias", kShadowBiasText},
        {&S::receivers, "receivers", kReceiverText}};
    return kTable;
  }
};

class ImperfectShadowMaps : public Technique {
 public:
  using Settings = ImperfectSettings;
  explicit ImperfectShadowMaps(const ImperfectSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    tree_.emplace(frame, settings_.tree);
    lights_.emplace(frame, settings_.lights);
    points_.emplace(frame.context(), lights_->count(), static_cast<uint32_t>(settings_.points),
                    tree_->tree().depth(), settings_.tilePx, static_cast<uint32_t>(settings_.tree.seed));
    atlas_.emplace(frame.context(), lights_->count(), glm::ivec2(settings_.tilePx),
                   many_lods::AtlasForm::Depth, settings_.tree.discs);
    radiosity_.emplace(frame, Radiosity::Sight::Atlas, settings_.receivers);
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes() + points_->bytes());
  }

  void render(frame::Frame& frame) override {
    tree_->update(frame);
    const double radius = tree_->tree().leafRadius();
    lights_->make(frame, step_++, settings_.tilePx, 1.0, radius);
    {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(points_->drawList(), tree_->tree().nodes(), lights_->views(),
                   tree_->discs(settings_.bias.nearest, points_->radiusScale()));
    }
    {
      const auto scope = frame.passes().open(kFillPass);
      points_->fill(*atlas_, settings_.fillLevels, static_cast<float>(settings_.fillTolerance));
    }
    // Discs are larger than leaves, and so is what they are off by.
    radiosity_->shade(frame, lights_->set(), &*atlas_,
                      settings_.bias.of(radius * double(points_->radiusScale()),
                                        hemispherePixelSlope(settings_.tilePx), settings_.tree.discs, 1.0));
  }

  const gl::Texture& product() const override { return radiosity_->texture(); }
  std::vector<Counter> count(frame::Frame&) override {
    return {{"cut_nodes", double(settings_.points * settings_.lights.count)},
            {"cut_nodes_per_view", double(settings_.points)},
            {"tree_build_ms", tree_->buildMs()}};
  }

 private:
  ImperfectSettings settings_;
  int step_ = 0;
  std::optional<SceneTree> tree_;
  std::optional<VirtualLights> lights_;
  std::optional<many_lods::FixedPoints> points_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<Radiosity> radiosity_;
};

const RegisteredTechnique<ImperfectShadowMaps> kImperfectRegistered{
    {.name = "many_lods/imperfect_shadow_maps",
     .version = 2,
     .summary =
         "One bounce of light by virtual point lights, their shadow maps drawn from fixed random points",
     .source = "Ritschel and others 2008; Holländer 2013, section 3.5.1 (HOL-26)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .counters = cutQuantities(),
     .effort = "points"}};

}  // namespace
}  // namespace limen::techniques
