// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/decision.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace limen::techniques {
namespace {

enum Evidence {
  Penumbra,
  SecondLayer,
  MoreSamples,
  Overlap,
  Thin,
  Coarse,
  LevelChanges,
  SavedVisits,
  EvidenceCount
};

class Decider {
 public:
  Decider(frame::Frame& frame, ShadowProbe& probe, const CommonNeeds& common,
          const NeedThresholds& thresholds)
      : frame_(frame), probe_(probe), common_(common), limits_(thresholds), figures_(EvidenceCount, 0.0) {}

  Decision decide() {
    if (!isSoft()) return done();
    BitmaskSettings everything{.search = search(), .occluders = patches()};
    everything.maps = PeeledMaps{.layers = 2};
    decision_.setting = everything;
    current_ = probe_.run(decision_.setting);
    if (current_.processed == 0.0) {
      decision_.setting = BitmaskSettings{.search = search(), .occluders = patches()};
      remark(
          "one map, 16 x 16 samples: no pixel of the small picture lies in a penumbra, so nothing was "
          "compared");
      return done();
    }
    dropLayer();
    dropSamples();
    dropMask();
    chooseOccluders();
    chooseLevels();
    chooseStructure();
    return done();
  }

 private:
  void remark(std::string text) { decision_.remarks.push_back(std::move(text)); }

  /// All choices are among the thesis's forms, whose costs and errors its rules weigh.
  SearchSettings search() const {
    return {.map = common_.map,
            .bias = SlopeBias{.slope = 2.0},
            .budget = UniformBudget{.limit = common_.budget}};
  }
  static Micropatches patches() {
    Micropatches nearest;
    nearest.depths = CoarseDepths::Nearest;
    return nearest;
  }
  const BitmaskSettings* masked() const { return std::get_if<BitmaskSettings>(&decision_.setting); }
  bool layered() const { return masked() && !std::holds_alternative<CentreMap>(masked()->maps); }

  /// The current setting, modified; it is not a hard shadow.
  template <class Change>
  ShadowSetting with(const Change& change) const {
    ShadowSetting out = decision_.setting;
    if (auto* areas = std::get_if<BackprojectionSettings>(&out)) change(*areas);
    if (auto* masks = std::get_if<BitmaskSettings>(&out)) change(*masks);
    return out;
  }
  void take(ShadowSetting setting, Probed probed) {
    decision_.setting = std::move(setting);
    current_ = std::move(probed);
  }
  bool rectangular() const { return frame_.scene().traits().count("rectangular_light") > 0; }

  bool isSoft() {
    frame::ShadowMapSettings map;
    map.resolution = common_.map.resolution;
    figures_[Penumbra] = probe_.penumbraTexels(map);
    if (figures_[Penumbra] > limits_.hardPenumbraTexels) return true;
    decision_.setting = common_.map;
    remark(
        fmt::format("hard shadows: the widest penumbra that the depths allow is {:.2g} texels (limit {:g})",
                    figures_[Penumbra], limits_.hardPenumbraTexels));
    return false;
  }

  void dropLayer() {
    BitmaskSettings one = *masked();
    one.maps = CentreMap{};
    Probed probed = probe_.run(one);
    figures_[SecondLayer] = meanDifference(current_, probed);
    if (figures_[SecondLayer] > limits_.tolerance) {
      remark(fmt::format(
          "two peeled layers: without the second, visibility changes by {:.2g} (tolerance {:.2g})",
          figures_[SecondLayer], limits_.tolerance));
      return;
    }
    remark(fmt::format("one map: a second layer changes visibility by {:.2g} (tolerance {:.2g})",
                       figures_[SecondLayer], limits_.tolerance));
    take(one, std::move(probed));
  }

  void dropSamples() {
    BitmaskSettings fewer = *masked();
    fewer.pattern = GridSamples<LightPattern::Regular8>{};
    Probed probed = probe_.run(fewer);
    figures_[MoreSamples] = meanDifference(current_, probed);
    const bool enough = figures_[MoreSamples] <= limits_.tolerance;
    remark(fmt::format("{} light samples: 64 in place of 256 change visibility by {:.2g} (tolerance {:.2g})",
                       enough ? 64 : 256, figures_[MoreSamples], limits_.tolerance));
    if (enough) take(fewer, std::move(probed));
  }

  /// Areas are summed and support neither layers nor lights of other shapes.
  void dropMask() {
    if (layered() || !rectangular()) {
      remark(rectangular() ? "bitmask: required by layers" : "bitmask: the light is not a rectangle");
      return;
    }
    const BackprojectionSettings area{.search = search(), .occluders = patches()};
    Probed probed = probe_.run(area);
    figures_[Overlap] = meanDifference(current_, probed);
    const bool enough = figures_[Overlap] <= limits_.tolerance;
    remark(fmt::format("{}: summed areas change visibility by {:.2g} (tolerance {:.2g})",
                       enough ? "areas" : "bitmask", figures_[Overlap], limits_.tolerance));
    if (enough) take(area, std::move(probed));
  }

  /// Microquads need less bias, but lose casters of one or two texels.
  void chooseOccluders() {
    ShadowSetting quads = with([](auto& settings) {
      settings.search.bias = SlopeBias{.slope = 0.5};
      if constexpr (std::is_same_v<decltype(settings), BitmaskSettings&>)
        settings.occluders = MaskedMicroquads{};
      else
        settings.occluders = SummedMicroquads{};
    });
    Probed probed = probe_.run(quads);
    figures_[Thin] = meanLightGained(current_, probed);
    const bool enough = figures_[Thin] <= limits_.tolerance;
    remark(fmt::format("{}: microquads let {:.2g} more light through (tolerance {:.2g})",
                       enough ? "microquads" : "micropatches", figures_[Thin], limits_.tolerance));
    if (enough) take(std::move(quads), std::move(probed));
  }

  void chooseLevels() {
    figures_[Coarse] = current_.coarseShare;
    figures_[LevelChanges] = current_.levelChangeShare;
    if (masked() && figures_[Coarse] > limits_.coarseShare) {
      BitmaskSettings rects = *masked();
      Microrects merged;
      merged.diagonalMerge = frame::DiagonalMerge::Nearest;
      rects.occluders = merged;
      rects.search.bias = search().bias;
      take(rects, probe_.run(rects));
      remark(fmt::format(
          "microrects: {:.0f} % of the pixels have micro-occluders of level 2 or coarser (limit {:.0f} %)",
          100.0 * figures_[Coarse], 100.0 * limits_.coarseShare));
    }
    if (layered()) {
      remark(
          fmt::format("one level per pixel, although {:.1f} % of neighbours differ in level: masks of "
                      "several layers cannot be blended",
                      100.0 * figures_[LevelChanges]));
      return;
    }
    const bool blends = figures_[LevelChanges] > limits_.blendShare;
    remark(fmt::format("{}: {:.1f} % of neighbours differ in level (limit {:.1f} %)",
                       blends ? "levels smoothed and blended" : "one level per pixel",
                       100.0 * figures_[LevelChanges], 100.0 * limits_.blendShare));
    if (!blends) return;
    decision_.setting = with([](auto& settings) {
      settings.passes = SplitPasses{};
      settings.levels = BlendedLevels{};
    });
    current_ = probe_.run(decision_.setting);
  }

  /// The small picture is extrapolated to the full one by the number of pixels.
  void chooseStructure() {
    ShadowSetting ysm = with([](auto& settings) { settings.search.structure = YLayers{}; });
    Probed probed = probe_.run(ysm);
    const double pixels =
        double(frame_.sizePx().x) * frame_.sizePx().y / (double(probe_.sizePx().x) * probe_.sizePx().y);
    figures_[SavedVisits] = (current_.examined - probed.examined) * pixels;
    const int base = std::min(YLayers{}.base, common_.map.resolution);
    const double built = double(base) * base * (std::bit_width(unsigned(base)) - 1);
    const bool worth = figures_[SavedVisits] > limits_.buildWeight * built;
    remark(fmt::format("{}: a Y shadow map saves {:.3g} micro-occluders and takes {:.3g} texels to build",
                       worth ? "Y shadow map" : "hierarchical shadow map", figures_[SavedVisits], built));
    if (worth) take(std::move(ysm), std::move(probed));
  }

  Decision done() {
    const std::vector<Quantity> quantities = evidenceQuantities();
    for (size_t i = 0; i < quantities.size(); ++i)
      decision_.evidence.push_back({quantities[i].name, figures_[i]});
    return std::move(decision_);
  }

  frame::Frame& frame_;
  ShadowProbe& probe_;
  const CommonNeeds& common_;
  const NeedThresholds& limits_;
  std::vector<double> figures_;
  Probed current_;
  Decision decision_;
};

}  // namespace

const SettingsTable<NeedThresholds>& NeedThresholds::table() {
  using S = NeedThresholds;
  static const SettingsTable<S> kTable = {
      {&S::tolerance,
       "tolerance",
       {0.0, 1.0},
       "",
       "Mean change of visibility in shadow up to which a feature is left out"},
      {&S::hardPenumbraTexels,
       "hard_penumbra",
       {0.0, 64.0},
       "texel",
       "Widest penumbra that is shown as a hard edge",
       "Schwarz 2009, section 3.2.1"},
      {&S::coarseShare,
       "coarse_share",
       {0.0, 1.0},
       "",
       "Share of pixels with coarse micro-occluders from which microrects are used",
       "Schwarz 2009, section 4.4.4"},
      Binding(&S::blendShare, "blend_share", Range{0.0, 1.0}, "",
              "Share of neighbours with different levels from which levels are blended",
              "Schwarz 2009, section 5.2.1")
          .formerly({"seam_share"}),
      {&S::buildWeight,
       "build_weight",
       {0.0, 1e6},
       "",
       "Micro-occluders that must be saved per texel of a Y shadow map",
       "Schwarz 2009, section 4.3.2"}};
  return kTable;
}

const SettingsTable<CommonNeeds>& CommonNeeds::table() {
  static const SettingsTable<CommonNeeds> kTable = {
      included(&CommonNeeds::map),
      {&CommonNeeds::budget,
       "budget",
       {0, 1 << 24},
       "",
       "Micro-occluders allowed per pixel; the square root is the number per axis; 0: no limit",
       "Schwarz 2009, sections 4.1 and 4.5"}};
  return kTable;
}

std::vector<Quantity> evidenceQuantities() {
  constexpr Direction kNeither = Direction::Neither;
  return {{"penumbra_texels", "Widest penumbra", "texel", kNeither, "Schwarz 2009, section 3.2.1"},
          {"second_layer_change", "Change by a second layer", "", kNeither},
          {"fewer_samples_change", "Change by fewer samples", "", kNeither},
          {"summed_areas_change", "Change by summed areas", "", kNeither},
          {"thin_caster_loss", "Light let through by microquads", "", kNeither},
          {"coarse_level_share", "Share of pixels with coarse occluders", "", kNeither},
          {"level_change_share", "Share of neighbours with different levels", "", kNeither},
          {"saved_micro_occluders", "Micro-occluders saved by a Y shadow map", "", kNeither}};
}

Decision decideNeeds(frame::Frame& frame, ShadowProbe& probe, const CommonNeeds& common,
                     const NeedThresholds& thresholds) {
  return Decider(frame, probe, common, thresholds).decide();
}

}  // namespace limen::techniques
