// SPDX-License-Identifier: BSD-3-Clause
// Instant radiosity with imperfect shadow maps: the rival whose points do not adapt to the view. Source:
// Ritschel and others 2008; Holländer 2013, sections 3.5.1 and 3.6.2. Lights, their sum, points and discs are
// those of many_lods/instant_radiosity, so that the choice of points alone differs.
#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/many_lods/fixed_points.h"
#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/scene_tree.h"

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
  double bias = 3.0;
  double slopeBias = 1.0;
  double nearest = 8.0;
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
        {&S::bias,
         "bias",
         {0.0, 64.0},
         "",
         "How much nearer to a light than a point its occluders are, radii of leaves"},
        {&S::slopeBias,
         "slope_bias",
         {0.0, 16.0},
         "px",
         "And by as many pixels, times 1 + the surface's slope"},
        {&S::nearest,
         "nearest",
         {0.0, 64.0},
         "",
         "Points nearer to a light than this do not occlude, radii of leaves"}};
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
                   many_lods::AtlasForm::Depth);
    radiosity_.emplace(frame, Radiosity::Sight::Atlas);
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes() + points_->bytes());
  }

  void render(frame::Frame& frame) override {
    tree_->update(frame);
    const double radius = tree_->tree().leafRadius();
    lights_->make(frame, step_++, settings_.tilePx, 1.0, radius);
    {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(
          points_->drawList(), tree_->tree().nodes(), lights_->views(),
          {.nearest = static_cast<float>(settings_.nearest * radius), .radiusScale = points_->radiusScale()});
    }
    {
      const auto scope = frame.passes().open(kFillPass);
      points_->fill(*atlas_, settings_.fillLevels, static_cast<float>(settings_.fillTolerance));
    }
    // Discs are larger than leaves, and so is what they are off by.
    const double pixel = std::sqrt(8.0) / settings_.tilePx;
    radiosity_->shade(
        frame, *lights_, &*atlas_,
        {settings_.bias * radius * double(points_->radiusScale()), settings_.slopeBias * pixel});
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
     .version = 1,
     .summary =
         "One bounce of light by virtual point lights, their shadow maps drawn from fixed random points",
     .source = "Ritschel and others 2008; Holländer 2013, section 3.5.1 (HOL-26)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .counters = cutQuantities(),
     .effort = "points"}};

}  // namespace
}  // namespace limen::techniques
