// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "renderer/techniques/soft_shadows/quality/level_of_quality.h"
#include "renderer/techniques/soft_shadows/quality/split_search.h"
#include "renderer/techniques/soft_shadows/visibility_pass.h"

namespace limen::techniques {

/// A search in separate passes: classify, smooth, order, gather. Source: Schwarz 2009, sections 4.1 and
/// 5.2.1.
class SplitRunner {
 public:
  /// Compiles and allocates; states the bytes held. `smooths`: there are levels to smooth. `layers`: of
  /// the map, as for SplitSearch.
  SplitRunner(frame::Frame& frame, const VisibilityPass& pass, const LevelOfQuality& quality, bool smooths,
              int layers);

  /// Makes what bindInputs() binds.
  void makeInputs(frame::Frame& frame) const;
  void bindInputs(frame::Frame& frame) const;
  enum class Timing {
    Stages,  ///< each stage is a pass of the frame
    Whole    ///< within a pass that the caller has opened
  };
  /// `counts` is null in a plain frame.
  void run(frame::Frame& frame, const VisibilityPass& pass, PassInputs& inputs,
           const frame::ShadowMapSettings& map, const CountImages* counts, Timing timing);
  std::map<std::string, const gl::Texture*> debugViews() const {
    return {{"search_areas", &search_.areas()}, {"levels", &search_.levels()}};
  }

 private:
  LevelOfQuality quality_;
  bool smooths_;
  SplitSearch search_;
  const gl::Program &classify_, &gather_;
  const gl::Program *smooth_ = nullptr, *countBins_ = nullptr, *scatter_ = nullptr;
};

}  // namespace limen::techniques
