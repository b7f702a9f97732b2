// SPDX-License-Identifier: BSD-3-Clause
// Instant radiosity with a shadow map for each virtual point light, all of them drawn from cuts of one tree
// of points (ManyLoDs). Source: Holländer 2013, sections 3.5 and 3.6.1. Projection (stereographic
// hemispheres), bias, nearest distance and bound of the light are parameters that the thesis leaves open.
#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/scene_tree.h"

namespace limen::techniques {
namespace {

struct InstantRadiositySettings {
  VirtualLightSettings lights;
  TreeSettings tree;
  CutSettings cut{{}, 2.0, 16384};
  int tilePx = 64;
  double bias = 3.0;
  double slopeBias = 1.0;
  double nearest = 8.0;
  static const SettingsTable<InstantRadiositySettings>& table() {
    using S = InstantRadiositySettings;
    static const SettingsTable<S> kTable = {
        included(&S::lights),
        included(&S::tree),
        included(&S::cut),
        {&S::tilePx,
         "tile",
         {4, 512},
         "px",
         "Side of a light's shadow map",
         "Holländer 2013, table 3.3 (32)"},
        {&S::bias,
         "bias",
         {0.0, 64.0},
         "",
         "How much nearer to a light than a point its occluders are, radii of leaves"},
        {&S::slopeBias,
         "slope_bias",
         {0.0, 16.0},
         "px",
         "And by as many pixels, or nodes of the size allowed if that is more, times 1 + the surface's "
         "slope"},
        {&S::nearest,
         "nearest",
         {0.0, 64.0},
         "",
         "Nodes nearer to a light than this do not occlude, radii of leaves"}};
    return kTable;
  }
};

class InstantRadiosity : public Technique {
 public:
  using Settings = InstantRadiositySettings;
  explicit InstantRadiosity(const InstantRadiositySettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    tree_.emplace(frame, settings_.tree);
    lights_.emplace(frame, settings_.lights);
    cut_.emplace(frame.context(), lights_->count(), tree_->tree().depth(),
                 settings_.cut.capacity(lights_->count()), settings_.cut.mode);
    atlas_.emplace(frame.context(), lights_->count(), glm::ivec2(settings_.tilePx),
                   many_lods::AtlasForm::Depth);
    radiosity_.emplace(frame, false);
    frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    frame.passes().setBytesHeld(kSplatPass, atlas_->bytes());
  }

  void render(frame::Frame& frame) override {
    if (step_ == 0)
      for (int before = settings_.lights.framesBefore; before > 0; --before) findCuts(frame, -before, false);
    findCuts(frame, step_++, false);
    const auto radius = static_cast<float>(tree_->tree().leafRadius());
    {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), lights_->views(),
                   {.nearest = static_cast<float>(settings_.nearest) * radius});
    }
    // Pixels as they are on average over the directions (many_lods::hemisphereView()).
    const double pixel = std::sqrt(8.0) / settings_.tilePx * std::max(settings_.cut.epsilonPx, 1.0);
    radiosity_->shade(frame, *lights_, &*atlas_,
                      {settings_.bias * double(radius), settings_.slopeBias * pixel});
  }

  const gl::Texture& product() const override { return radiosity_->texture(); }

  /// Of one further step of the light's motion.
  std::vector<Counter> count(frame::Frame& frame) override {
    findCuts(frame, step_++, true);
    return cutCounters(cut_->control(), lights_->count(), *tree_);
  }

 private:
  void findCuts(frame::Frame& frame, int step, bool counting) {
    tree_->update(frame);
    lights_->make(frame, step, settings_.tilePx, settings_.cut.epsilonPx, double(tree_->tree().leafRadius()));
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), lights_->views(), counting);
  }

  InstantRadiositySettings settings_;
  int step_ = 0;
  std::optional<SceneTree> tree_;
  std::optional<VirtualLights> lights_;
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<Radiosity> radiosity_;
};

const RegisteredTechnique<InstantRadiosity> kInstantRadiosityRegistered{
    {.name = "many_lods/instant_radiosity",
     .version = 1,
     .summary =
         "One bounce of light by virtual point lights, their shadow maps drawn from cuts for all of them",
     .source = "Holländer 2013, sections 3.5 and 3.6.1 (HOL-25)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .counters = cutQuantities(),
     .effort = "levels"}};

}  // namespace
}  // namespace limen::techniques
