// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "renderer/techniques/soft_shadows/gathering.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"
#include "renderer/techniques/soft_shadows/quality/budget_driver.h"
#include "renderer/techniques/soft_shadows/quality/level_of_quality.h"
#include "renderer/techniques/soft_shadows/quality/level_steps.h"
#include "renderer/techniques/soft_shadows/quality/split_passes.h"
#include "renderer/techniques/soft_shadows/visibility_pass.h"

namespace limen::techniques {

/// What a search technique is composed of.
struct SearchParts {
  std::string shader, pass;  ///< as for VisibilityTechnique
  SearchSettings search;
  LevelSettings levels;
  PassSettings passes;
  OccluderChoice occluders;
  MapChoice maps;
  std::unique_ptr<Gathering> gathering;
  std::unique_ptr<ProductStage> last;  ///< null: the visibility as gathered
};

/// The techniques that backproject the shadow map's texels onto the light, composed of parts: maps, the
/// search for occluders in them, levels, budgets, the gathering of occluders, and what turns that into the
/// product. Source: Schwarz 2009, chapters 4 and 5.
class SearchTechnique : public Technique, public CountsPixels, private PassInputs {
 public:
  /// prepare() of all parts, then the frames in which a driver of the budget settles.
  void prepare(frame::Frame& frame) override;
  void render(frame::Frame& frame) override;
  const gl::Texture& product() const override;
  std::vector<Counter> count(frame::Frame& frame) override;
  /// In the split form: areas and levels of split_search.h; and the budget map, if there is one, with its
  /// driver's images.
  std::map<std::string, const gl::Texture*> debugViews() const override;
  /// Search areas in the colours of the thesis's figure 4.10 and levels as in figure 4.11, once count() ran;
  /// and the budget map.
  std::map<std::string, PictureMaker> pictures() const override;

  const PixelCounts& counted() const override { return *counted_; }
  /// What count() found; empty before, with several maps, and if all pixels have one level.
  const std::optional<LevelSteps>& levelSteps() const { return levelSteps_; }
  /// The budget driver's counters for the last frame, without waiting or rendering another one.
  std::vector<Counter> budgetFacts() const;

  /// What count() returns, except that of gathering and product: the counters of every visibility technique;
  /// structure_bytes and occluder_bytes, see OccluderSearch; those of quality_counters.h; if one map is read,
  /// those of level_steps.h; and those of drivers.
  static std::vector<Quantity> quantities();

 protected:
  explicit SearchTechnique(SearchParts parts);

 private:
  const frame::LightFrustum& bindInputs(frame::Frame& frame, const frame::ShadowMapSettings& map) override;
  void setUniforms(const gl::Program& program) const override;
  /// Levels are smoothed, and there is something to smooth.
  bool smooths() const { return quality_.smoothing() && (budget_ > 0 || budgets_); }
  /// `counts` is null in a plain frame.
  void run(frame::Frame& frame, const CountImages* counts);
  void runPasses(frame::Frame& frame, const CountImages* counts);

  VisibilityPass pass_;
  OccluderSearch search_;
  LevelOfQuality quality_;
  MapSource maps_;
  size_t current_ = 0;                      // the map currently read, or the first of several
  int64_t budget_;                          // largest per pixel; 0: no limit
  std::unique_ptr<BudgetDriver> budgets_;   // null: the same budget for all pixels
  const gl::Texture* budgetMap_ = nullptr;  // of this frame
  std::unique_ptr<Gathering> gathering_;
  std::unique_ptr<ProductStage> last_;
  std::optional<SplitRunner> split_;  // empty: a single pass
  /// Replaced by count(), never changed after it: pictures still read it on other threads.
  std::shared_ptr<PixelCounts> counted_ = std::make_shared<PixelCounts>();
  std::optional<LevelSteps> levelSteps_;
};

}  // namespace limen::techniques
