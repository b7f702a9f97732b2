// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "renderer/techniques/soft_shadows/coarse_occluders.h"
#include "renderer/techniques/soft_shadows/quality/budget_driver.h"
#include "renderer/techniques/soft_shadows/quality/level_of_quality.h"
#include "renderer/techniques/soft_shadows/quality/level_steps.h"
#include "renderer/techniques/soft_shadows/quality/split_search.h"
#include "renderer/techniques/soft_shadows/search_settings.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// Base of the techniques that backproject the shadow map's texels onto the light: finds the texels that can
/// matter for a receiver by an acceleration structure and loops over them as micro-occluders. What a
/// micro-occluder does to the visibility is the shader's own (area, bitmask). Source: Schwarz 2009,
/// sections 4.1 to 4.4; how coarse they may be: chapter 5.
class OccluderSearch : public VisibilityTechnique {
 public:
  /// Those of every visibility technique; structure_bytes: the minimum/maximum pyramid, of which every
  /// structure needs the minimum for micro-occluders, and the layers on top of it, of all maps together;
  /// occluder_bytes: what is kept for the kind of occluders or form of bias alone; those of
  /// quality_counters.h; and, where one map is read, those of level_steps.h.
  static std::vector<Quantity> quantities();

  /// prepareSearch(), then the frames in which a driver of the budget settles.
  void prepare(frame::Frame& frame) final;
  std::vector<Counter> count(frame::Frame& frame) override;
  /// What the driver of the budget says of the last frame; without waiting or rendering another one.
  std::vector<Counter> budgetFacts() const;
  /// What count() found; empty before, with several maps, and where all pixels have one level.
  const std::optional<LevelSteps>& levelSteps() const { return levelSteps_; }
  /// Of the split form: areas and levels of split_search.h; and the budget map, where there is one, with what
  /// its driver shows.
  std::map<std::string, const gl::Texture*> debugViews() const override;
  /// Search areas in the colours of the thesis's figure 4.10 and levels as in figure 4.11, once count() ran;
  /// and the budget map.
  std::map<std::string, Image> pictures() const override;

 protected:
  OccluderSearch(const SearchSettings& settings, const LevelSettings& levels, const PassSettings& passes,
                 const OccluderChoice& occluders, std::string shader, std::string pass,
                 gl::ShaderDefines defines = {});
  /// All that a frame needs, for whoever adds to it.
  virtual void prepareSearch(frame::Frame& frame);
  const frame::LightFrustum& bindMap(frame::Frame& frame) override;
  void configure(const gl::Program& program) const override;
  void preparePasses(frame::Frame& frame) override;
  void makeInputs(frame::Frame& frame) override;
  void runPasses(frame::Frame& frame, const CountImages* counts) override;

 private:
  /// Levels are smoothed, and there is something to smooth.
  bool smooths() const { return quality_.smoothing() && (budget_ > 0 || budgets_); }
  void runSplit(frame::Frame& frame, const CountImages* counts);
  /// Processed pixels do not all stand for the same levels, in what was counted last.
  bool choicesDiffer() const;
  /// After the map's pixels are counted.
  void findLevelSteps(frame::Frame& frame, const CountImages& counts);

  int64_t budget_;  // the most for a pixel; 0: no limit
  int refinements_;
  StructureSettings structure_;
  CoarseOccluders coarse_;
  BiasForm biasForm_;
  int baseLevel_ = 0, maxIterations_ = 0;
  std::vector<int64_t> structureBytes_;  // of each map
  LevelOfQuality quality_;
  std::unique_ptr<BudgetDriver> budgets_;   // null: the same budget for all pixels
  const gl::Texture* budgetMap_ = nullptr;  // of this frame
  std::optional<SplitSearch> split_;        // empty: a single pass
  const gl::Program *classify_ = nullptr, *smooth_ = nullptr, *gather_ = nullptr;
  const gl::Program *countBins_ = nullptr, *scatter_ = nullptr;
  std::optional<LevelSteps> levelSteps_;
};

}  // namespace limen::techniques
