// SPDX-License-Identifier: BSD-3-Clause
// The picture with the coarsest levels that an exhaustive search finds indistinguishable from the finest: the
// target of lod/perceptual, whose test costs a frame next to nothing. See oracle.h.
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/perceptual_lod/level_view.h"
#include "renderer/techniques/perceptual_lod/oracle.h"

namespace limen::techniques {
namespace {

struct PixelLimit {
  static constexpr const char *kKind = "px", *kSummary = "pixels";
  double most = 16.0;
  static const SettingsTable<PixelLimit>& table() {
    static const SettingsTable<PixelLimit> kTable = {
        {&PixelLimit::most,
         "most",
         {0.0, 1e8},
         "px",
         "Largest number of visible pixels of a level that counts as invisible"}};
    return kTable;
  }
};

struct ShareLimit {
  static constexpr const char *kKind = "share", *kSummary = "a share of the pixels that the object covers";
  double most = 0.04;
  static const SettingsTable<ShareLimit>& table() {
    static const SettingsTable<ShareLimit> kTable = {
        {&ShareLimit::most,
         "most",
         {0.0, 1.0},
         "",
         "Largest visible share of a level that counts as invisible"}};
    return kTable;
  }
};

struct LodOracleSettings {
  std::variant<PixelLimit, ShareLimit> limit;
  frame::ShadedSetting shading;
  ModelSettings model;
  static const SettingsTable<LodOracleSettings>& table() {
    using S = LodOracleSettings;
    static const SettingsTable<S> kTable = {
        Binding(&S::limit, "limit", "Limit up to which a level counts as invisible",
                "Schwarz 2009, section 9.5 (not given there)")
            .shorthand("most")
            .formerly({"limit_unit"}),
        frame::shadingBinding(&S::shading), included(&S::model)};
    return kTable;
  }
  LevelRule rule() const {
    if (const auto* px = std::get_if<PixelLimit>(&limit)) return {PixelLimits{px->most, px->most}};
    const double most = std::get<ShareLimit>(limit).most;
    return {ShareLimits{most, most}};
  }
};

class LodOracle : public Technique {
 public:
  using Settings = LodOracleSettings;
  explicit LodOracle(const LodOracleSettings& settings)
      : shading_(settings.shading), rule_(settings.rule()), seenOn_(settings.model.seenOn()) {}

  void prepare(frame::Frame& frame) override { view_.emplace(frame, "oracle"); }

  void render(frame::Frame& frame) override {
    scene::LodSelection chosen;
    for (const OracleVerdict& verdict : searchLevels(frame, frame.timeS(), shading_, seenOn_))
      chosen.levels.push_back(verdict.seen() ? verdict.coarsestInvisible(rule_)
                                             : static_cast<int>(verdict.visiblePx.size()) - 1);
    levels_ = chosen.levels;
    product_ = &view_->show(frame.timeS(), chosen).get<frame::Shaded>(shading_).texture();
  }

  const gl::Texture& product() const override { return *product_; }
  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> out = countLevels(frame.scene(), levels_);
    countOracle(frame, frame.timeS(), shading_, seenOn_, rule_, levels_, out);
    return out;
  }

 private:
  frame::ShadedSetting shading_;
  LevelRule rule_;
  SeenOn seenOn_;
  std::optional<LevelView> view_;
  std::vector<int> levels_;
  const gl::Texture* product_ = nullptr;
};

const RegisteredTechnique<LodOracle> kLodOracleRegistered{
    {.name = "lod/oracle",
     .version = 2,
     .summary =
         "Coarsest levels without a visible difference, by exhaustive search in double precision (slow)",
     .source = "bench, for Schwarz 2009, section 9.5",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .reference = true,
     .onCpu = true,
     .counters = levelQuantities()}};

}  // namespace
}  // namespace limen::techniques
