// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/decision.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace limen::techniques {
namespace {

constexpr const char *kHard = "soft_shadows/hard", *kArea = "soft_shadows/backprojection",
                     *kMask = "soft_shadows/bitmask";
constexpr int kYsmBase = 256;

enum Evidence {
  Penumbra,
  SecondLayer,
  MoreSamples,
  Overlap,
  Thin,
  Coarse,
  Seams,
  SavedVisits,
  EvidenceCount
};

class Decider {
 public:
  Decider(frame::Frame& frame, ShadowProbe& probe, const std::map<std::string, ParameterValue>& common,
          const NeedThresholds& thresholds)
      : frame_(frame), probe_(probe), common_(common), limits_(thresholds), figures_(EvidenceCount, 0.0) {}

  Decision decide() {
    if (!isSoft()) return done();
    decision_.setting = {kMask, common_};
    set("maps", std::string("peeled"));
    set("layers", int64_t{2});
    current_ = probe_.run(decision_.setting);
    if (current_.processed == 0.0) {
      decision_.setting = {kMask, common_};
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
  void set(const std::string& name, ParameterValue value) {
    decision_.setting.values[name] = std::move(value);
  }
  void remark(std::string text) { decision_.remarks.push_back(std::move(text)); }

  ShadowSetting with(const std::map<std::string, ParameterValue>& values) const {
    ShadowSetting out = decision_.setting;
    for (const auto& [name, value] : values) out.values[name] = value;
    return out;
  }
  void take(ShadowSetting setting, Probed probed) {
    decision_.setting = std::move(setting);
    current_ = std::move(probed);
  }
  bool rectangular() const { return frame_.scene().traits().count("rectangular_light") > 0; }

  bool isSoft() {
    frame::ShadowMapSettings map;
    map.resolution = std::stoi(std::get<std::string>(common_.at("resolution")));
    figures_[Penumbra] = probe_.penumbraTexels(map);
    if (figures_[Penumbra] > limits_.hardPenumbraTexels) return true;
    decision_.setting = {kHard, common_};
    decision_.setting.values.erase("budget");
    remark(
        fmt::format("hard shadows: the widest penumbra that the depths allow is {:.2g} texels (limit {:g})",
                    figures_[Penumbra], limits_.hardPenumbraTexels));
    return false;
  }

  void dropLayer() {
    ShadowSetting one = decision_.setting;
    one.values.erase("maps");
    one.values.erase("layers");
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
    take(std::move(one), std::move(probed));
  }

  void dropSamples() {
    ShadowSetting fewer = with({{"pattern", std::string("regular_8")}});
    Probed probed = probe_.run(fewer);
    figures_[MoreSamples] = meanDifference(current_, probed);
    const bool enough = figures_[MoreSamples] <= limits_.tolerance;
    remark(fmt::format("{} light samples: 64 in place of 256 change visibility by {:.2g} (tolerance {:.2g})",
                       enough ? 64 : 256, figures_[MoreSamples], limits_.tolerance));
    if (enough) take(std::move(fewer), std::move(probed));
  }

  /// Areas add up and know neither layers nor lights of other shapes.
  void dropMask() {
    if (decision_.setting.values.count("maps") || !rectangular()) {
      remark(rectangular() ? "bitmask: layers need it" : "bitmask: the light is no rectangle");
      return;
    }
    ShadowSetting area{kArea, common_};
    Probed probed = probe_.run(area);
    figures_[Overlap] = meanDifference(current_, probed);
    const bool enough = figures_[Overlap] <= limits_.tolerance;
    remark(fmt::format("{}: summed areas change visibility by {:.2g} (tolerance {:.2g})",
                       enough ? "areas" : "bitmask", figures_[Overlap], limits_.tolerance));
    if (enough) take(std::move(area), std::move(probed));
  }

  /// Microquads need less bias, but lose casters of one or two texels.
  void chooseOccluders() {
    ShadowSetting quads = with({{"occluders", std::string("microquads")}, {"slope_bias", 0.5}});
    Probed probed = probe_.run(quads);
    figures_[Thin] = meanLightGained(current_, probed);
    const bool enough = figures_[Thin] <= limits_.tolerance;
    remark(fmt::format("{}: microquads let {:.2g} more light through (tolerance {:.2g})",
                       enough ? "microquads" : "micropatches", figures_[Thin], limits_.tolerance));
    if (enough) take(std::move(quads), std::move(probed));
  }

  void chooseLevels() {
    figures_[Coarse] = current_.coarseShare;
    figures_[Seams] = current_.levelChangeShare;
    const bool masked = decision_.setting.technique == kMask;
    if (masked && figures_[Coarse] > limits_.coarseShare) {
      ShadowSetting rects =
          with({{"occluders", std::string("microrects")}, {"diagonal_merge", std::string("nearest")}});
      rects.values.erase("slope_bias");
      take(rects, probe_.run(rects));
      remark(fmt::format(
          "microrects: {:.0f} % of the pixels have micro-occluders of level 2 or coarser (limit {:.0f} %)",
          100.0 * figures_[Coarse], 100.0 * limits_.coarseShare));
    }
    if (decision_.setting.values.count("maps")) {
      remark(fmt::format(
          "one level a pixel, though {:.1f} % of neighbours differ in level: masks of several layers cannot "
          "be blended",
          100.0 * figures_[Seams]));
      return;
    }
    const bool seams = figures_[Seams] > limits_.seamShare;
    remark(fmt::format("{}: {:.1f} % of neighbours differ in level (limit {:.1f} %)",
                       seams ? "levels smoothed and blended" : "one level a pixel", 100.0 * figures_[Seams],
                       100.0 * limits_.seamShare));
    if (!seams) return;
    set("passes", std::string("split"));
    set("levels", std::string("blend"));
    current_ = probe_.run(decision_.setting);
  }

  /// The small picture stands for the whole one by its number of pixels.
  void chooseStructure() {
    ShadowSetting ysm = with({{"structure", std::string("ysm")}});
    Probed probed = probe_.run(ysm);
    const double pixels =
        double(frame_.sizePx().x) * frame_.sizePx().y / (double(probe_.sizePx().x) * probe_.sizePx().y);
    figures_[SavedVisits] = (current_.examined - probed.examined) * pixels;
    const int base = std::min(kYsmBase, std::stoi(std::get<std::string>(common_.at("resolution"))));
    const double built = double(base) * base * (std::bit_width(unsigned(base)) - 1);
    const bool worth = figures_[SavedVisits] > limits_.buildWeight * built;
    remark(fmt::format("{}: a Y shadow map saves {:.3g} micro-occluders and takes {:.3g} texels to build",
                       worth ? "Y shadow map" : "hierarchical shadow map", figures_[SavedVisits], built));
    if (worth) take(std::move(ysm), std::move(probed));
  }

  Decision done() {
    const std::vector<std::string> names = evidenceNames();
    for (size_t i = 0; i < names.size(); ++i)
      decision_.evidence.push_back({names[i], figures_[i], i == Penumbra ? "texel" : "", false});
    return std::move(decision_);
  }

  frame::Frame& frame_;
  ShadowProbe& probe_;
  const std::map<std::string, ParameterValue>& common_;
  const NeedThresholds& limits_;
  std::vector<double> figures_;
  Probed current_;
  Decision decision_;
};

}  // namespace

std::vector<std::string> evidenceNames() {
  return {"penumbra_texels",  "second_layer_change", "fewer_samples_change", "summed_areas_change",
          "thin_caster_loss", "coarse_level_share",  "level_change_share",   "saved_micro_occluders"};
}

Decision decideNeeds(frame::Frame& frame, ShadowProbe& probe,
                     const std::map<std::string, ParameterValue>& common, const NeedThresholds& thresholds) {
  return Decider(frame, probe, common, thresholds).decide();
}

}  // namespace limen::techniques
