// SPDX-License-Identifier: BSD-3-Clause
// Instant radiosity with a shadow map for each virtual point light, all of them drawn from cuts of one tree
// of points (ManyLoDs). Source: Holländer 2013, sections 3.5 and 3.6.1. Projection (stereographic
// hemispheres), bias, nearest distance and bound of the light are parameters that the thesis leaves open.
#include <algorithm>
#include <optional>
#include <type_traits>
#include <variant>

#include "renderer/many_lods/in_place_cuts.h"
#include "renderer/many_lods/sequential_cuts.h"
#include "renderer/techniques/many_lods/radiosity.h"
#include "renderer/techniques/many_lods/receiver_surface.h"
#include "renderer/techniques/many_lods/scene_tree.h"
#include "renderer/techniques/many_lods/shadow_bias.h"
#include "renderer/techniques/many_lods/virtual_lights.h"

namespace limen::techniques {
namespace {

constexpr const char* kInPlacePass = "many_lods/in_place";

using ViewCuts =
    std::variant<many_lods::IncrementalCuts, many_lods::LazyCuts, many_lods::BasicCuts,
                 many_lods::LiteralCuts, many_lods::InPlaceSettings, many_lods::SequentialSettings,
                 many_lods::GeometryShaderCuts, many_lods::HybridSettings>;

/// Of cuts that are kept in a list.
many_lods::CutMode listed(const ViewCuts& cuts) {
  return std::visit(
      [](const auto& form) -> many_lods::CutMode {
        if constexpr (std::is_convertible_v<decltype(form), many_lods::CutMode>)
          return form;
        else
          return many_lods::BasicCuts{};
      },
      cuts);
}

std::vector<Quantity> radiosityQuantities() {
  std::vector<Quantity> out = cutQuantities();
  out.push_back({"stack_entries", "Most nodes on a stack", "", Direction::LowerIsBetter});
  out.push_back({"stack_bound", "Bound on the nodes on a stack", "", Direction::Neither});
  out.push_back({"unfinished_groups", "Groups stopped by a software renderer's limit on loops", "",
                 Direction::LowerIsBetter});
  return out;
}

struct InstantRadiositySettings {
  VirtualLightSettings lights;
  TreeSettings tree;
  ViewCuts cuts;
  CutLimits limits{2.0, 16384};
  int tilePx = 64;
  ShadowBias bias;
  ReceiverSurface receivers;
  static const SettingsTable<InstantRadiositySettings>& table() {
    using S = InstantRadiositySettings;
    static const SettingsTable<S> kTable = {included(&S::lights),
                                            included(&S::tree),
                                            {&S::cuts, "cuts", kCutsText, kCutsSource},
                                            included(&S::limits),
                                            {&S::tilePx,
                                             "tile",
                                             {4, 512},
                                             "px",
                                             "Side of a light's shadow map",
                                             "Holländer 2013, table 3.3 (32)"},
                                            {&S::bias, "bias", kShadowBiasText},
                                            {&S::receivers, "receivers", kReceiverText}};
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
    const int depth = tree_->tree().depth();
    if (const auto* inPlace = std::get_if<many_lods::InPlaceSettings>(&settings_.cuts)) {
      inPlace_.emplace(frame.context(), lights_->count(), depth, *inPlace, settings_.tree.discs);
    } else if (std::holds_alternative<many_lods::SequentialSettings>(settings_.cuts)) {
      sequential_.emplace(frame.context(), lights_->count(), depth, settings_.tree.discs);
    } else {
      cut_.emplace(tree_->cutsFor(frame, lights_->count(), settings_.limits, listed(settings_.cuts)));
      frame.passes().setBytesHeld(kCutsPass, cut_->bytes());
    }
    atlas_.emplace(frame.context(), lights_->count(), glm::ivec2(settings_.tilePx),
                   many_lods::AtlasForm::Depth, settings_.tree.discs);
    radiosity_.emplace(frame, cut_ ? Radiosity::Sight::Atlas : Radiosity::Sight::InPlaceAtlas,
                       settings_.receivers);
    frame.passes().setBytesHeld(cut_ ? kSplatPass : kInPlacePass, atlas_->bytes());
  }

  void render(frame::Frame& frame) override {
    if (step_ == 0)
      for (int before = settings_.lights.framesBefore; before > 0; --before) findCuts(frame, -before, false);
    findCuts(frame, step_++, false);
    const many_lods::ViewAtlas::Settings discs = tree_->discs(settings_.bias.nearest);
    if (inPlace_) {
      const auto scope = frame.passes().open(kInPlacePass);
      inPlace_->draw(tree_->tree().nodes(), lights_->views(), *atlas_, discs);
    } else if (sequential_) {
      const auto scope = frame.passes().open(kInPlacePass);
      sequential_->draw(tree_->tree().nodes(), lights_->views(), *atlas_, discs);
    } else {
      const auto scope = frame.passes().open(kSplatPass);
      atlas_->draw(*cut_, tree_->tree().nodes(), lights_->views(), discs);
    }
    radiosity_->shade(frame, lights_->set(), &*atlas_,
                      settings_.bias.of(tree_->tree().leafRadius(), hemispherePixelSlope(settings_.tilePx),
                                        settings_.tree.discs, settings_.limits.epsilonPx),
                      inPlace_      ? &inPlace_->countsBuffer()
                      : sequential_ ? &sequential_->countsBuffer()
                                    : nullptr);
  }

  const gl::Texture& product() const override { return radiosity_->texture(); }

  /// Of one further step of the light's motion.
  std::vector<Counter> count(frame::Frame& frame) override {
    if (sequential_) {
      const many_lods::InPlaceCounts counts = sequential_->counts();
      return {{"cut_nodes", double(counts.drawn)},
              {"cut_nodes_per_view", double(counts.drawn) / lights_->count()},
              {"refused_splits", 0.0},
              {"unfinished_groups", double(counts.unfinished)},
              {"tree_build_ms", tree_->buildMs()}};
    }
    if (inPlace_) {
      const many_lods::InPlaceCounts counts = inPlace_->counts();
      return {{"cut_nodes", double(counts.drawn)},
              {"cut_nodes_per_view", double(counts.drawn) / lights_->count()},
              {"refused_splits", double(counts.refused)},
              {"stack_entries", double(counts.deepest)},
              {"stack_bound", double(inPlace_->stackBound())},
              {"unfinished_groups", double(counts.unfinished)},
              {"tree_build_ms", tree_->buildMs()}};
    }
    findCuts(frame, step_++, true);
    return cutCounters(cut_->control(), lights_->count(), *tree_);
  }

 private:
  void findCuts(frame::Frame& frame, int step, bool counting) {
    tree_->update(frame);
    lights_->make(frame, step, settings_.tilePx, settings_.limits.epsilonPx,
                  double(tree_->tree().leafRadius()));
    if (!cut_) return;
    const auto scope = frame.passes().open(kCutsPass);
    cut_->update(tree_->tree().nodes(), lights_->views(), counting);
  }

  InstantRadiositySettings settings_;
  int step_ = 0;
  std::optional<SceneTree> tree_;
  std::optional<VirtualLights> lights_;
  // One of these.
  std::optional<many_lods::MultiCut> cut_;
  std::optional<many_lods::InPlaceCuts> inPlace_;
  std::optional<many_lods::SequentialCuts> sequential_;
  std::optional<many_lods::ViewAtlas> atlas_;
  std::optional<Radiosity> radiosity_;
};

const RegisteredTechnique<InstantRadiosity> kInstantRadiosityRegistered{
    {.name = "many_lods/instant_radiosity",
     .version = 2,
     .summary =
         "One bounce of light by virtual point lights, their shadow maps drawn from cuts for all of them",
     .source = "Holländer 2013, sections 3.5 and 3.6.1 (HOL-25)",
     .product = ProductKind::Colour,
     .needs = {"area_light"},
     .followsLight = true,
     .counters = radiosityQuantities(),
     .effort = "levels"}};

}  // namespace
}  // namespace limen::techniques
