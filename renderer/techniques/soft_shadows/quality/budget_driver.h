// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/soft_shadows/quality/budget_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Determines how many micro-occluders each pixel may use: makes the budget map b(x, y) of Schwarz 2009,
/// section 5.2.1. A technique owns one and calls it once per frame.
class BudgetDriver {
 public:
  virtual ~BudgetDriver() = default;

  /// Compiles and allocates, before the first frame; states bytes held.
  virtual void prepare(frame::Frame& frame) = 0;

  /// R32F, the frame's size: micro-occluders that each pixel may use, >= 0; 0 means no limit.
  /// Whole counts per axis follow from it, floor(sqrt b) and at least 1. Called outside of any pass, so that
  /// it opens its own, before those of the technique; has made the map visible to texture fetches when it
  /// returns.
  virtual const gl::Texture& make(frame::Frame& frame) = 0;

  /// Called right before the technique's own passes, once shadow maps and everything derived from them exist.
  /// Calls of begin() and finish() come in pairs, outside of any pass; not in frames that count their work.
  virtual void begin() {}
  /// Called once the frame's visibility is complete, outside of any pass, for drivers that react to its cost.
  /// Must not wait for the GPU.
  virtual void finish() {}

  /// Frames to run to completion before the first one shown or timed, for drivers that have to find their
  /// budget first.
  virtual int settleFrames() const { return 0; }
  /// The driver's own counters, after make(); may wait for the GPU.
  virtual std::vector<Counter> count() const { return {}; }
  /// Named images from which the map was made, besides the map itself; valid after make().
  virtual std::map<std::string, const gl::Texture*> debugViews() const { return {}; }
};

/// The chosen driver; null for a uniform budget.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const BudgetSettings& settings);
/// The counters of any driver.
std::vector<Quantity> budgetQuantities();

/// Sets the uniforms leastRoot and mostRoot.
void setRoots(const gl::Program& program, const BudgetRange& range);

}  // namespace limen::techniques
