// SPDX-License-Identifier: BSD-3-Clause
// The picture with the coarsest levels that an exhaustive search calls invisible: what lod/perceptual aims at
// with a test that costs a frame next to nothing. See oracle.h.
#include <optional>

#include "renderer/techniques/perceptual_lod/level_view.h"
#include "renderer/techniques/perceptual_lod/oracle.h"

namespace limen::techniques {
namespace {

class LodOracle : public Technique {
 public:
  explicit LodOracle(const ParameterValues& values) {
    settings_.rule.lower = settings_.rule.upper = values.real("limit");
    settings_.rule.unit = values.text("limit_unit") == "share" ? LevelRule::Unit::Share : LevelRule::Unit::Px;
    settings_.shading = frame::ShadedSetting::from(values);
    settings_.seenOn = SeenOn::from(values);
  }

  void prepare(frame::Frame& frame) override { view_.emplace(frame, "oracle"); }

  void render(frame::Frame& frame) override {
    scene::LodSelection chosen;
    for (const OracleVerdict& verdict :
         searchLevels(frame, frame.timeS(), settings_.shading, settings_.seenOn))
      chosen.levels.push_back(verdict.seen() ? verdict.coarsestInvisible(settings_.rule)
                                             : static_cast<int>(verdict.visiblePx.size()) - 1);
    levels_ = chosen.levels;
    product_ = &view_->show(frame.timeS(), chosen).get<frame::Shaded>(settings_.shading).texture();
  }

  const gl::Texture& product() const override { return *product_; }
  std::vector<Counter> count(frame::Frame& frame) override {
    return countLevels(frame, frame.timeS(), settings_, levels_);
  }

 private:
  PerceptualLodSettings settings_;
  std::optional<LevelView> view_;
  std::vector<int> levels_;
  const gl::Texture* product_ = nullptr;
};

std::vector<Parameter> oracleParameters() {
  std::vector<Parameter> out = {
      realParameter("limit", 16.0, 0.0, 1e8, "limit_unit",
                    "Most visible pixels of a level that counts as invisible",
                    "Schwarz 2009, section 9.5 (not given there)"),
      choiceParameter("limit_unit", "px", {"px", "share"},
                      "Of limit: pixels, or share (0..1) of the pixels that the object covers")};
  appendTo(out, frame::ShadedSetting::parameters());
  appendTo(out, SeenOn::parameters(false));
  return out;
}

const Registered<TechniqueInfo> kLodOracleRegistered{
    {.name = "lod/oracle",
     .version = 1,
     .summary = "Coarsest levels without a visible difference, by trying all in double precision (slow)",
     .source = "bench, for Schwarz 2009, section 9.5",
     .product = ProductKind::Colour,
     .parameters = oracleParameters(),
     .needs = {"lod_sets"},
     .reference = true,
     .onCpu = true,
     .make = [](const ParameterValues& values) { return std::make_unique<LodOracle>(values); },
     .errorBound = {},
     .counters = levelCounterNames()}};

}  // namespace
}  // namespace limen::techniques
