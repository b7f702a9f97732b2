// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Says how many micro-occluders each pixel may take: makes the budget map b(x, y) of Schwarz 2009,
/// section 5.2.1. A technique owns one and asks it once a frame.
class BudgetDriver {
 public:
  virtual ~BudgetDriver() = default;

  /// Compiles and allocates, before the first frame; states bytes held.
  virtual void prepare(frame::Frame& frame) = 0;

  /// R32F, the frame's size: micro-occluders that each pixel may take, >= 0, where 0 stands for no limit.
  /// Whole counts per axis follow from it, floor(sqrt b) and at least 1. Called outside of any pass, so that
  /// it opens its own, before those of the technique; has made the map visible to texture fetches when it
  /// returns.
  virtual const gl::Texture& make(frame::Frame& frame) = 0;

  /// Called right before the technique's own passes, shadow maps and what is made of them being there. Calls
  /// of begin() and finish() come in pairs, outside of any pass; not in frames that count their work.
  virtual void begin() {}
  /// Called once the frame's visibility is there, outside of any pass, for drivers that steer by what it
  /// took. `work` is the list of processed pixels (split_search.h),
  /// whose word 3 is their number; null in the single pass. Must not wait for the GPU.
  virtual void finish(frame::Frame& /*frame*/, const gl::Buffer* /*work*/) {}

  /// Frames that are to run, each to its end, before the first that is shown or timed, for drivers that have
  /// to find their budget first.
  virtual int settleFrames() const { return 0; }
  /// Facts of its own, after make(); may wait for the GPU.
  virtual std::vector<Counter> count() const { return {}; }
  /// Named images that the map was made from, beside the map itself; valid after make().
  virtual std::map<std::string, const gl::Texture*> debugViews() const { return {}; }
};

/// A choice of `budget_map`.
struct BudgetDriverInfo {
  std::string name;
  /// Its own parameters, whose names begin with its name and "_"; they share a list with the technique's.
  std::vector<Parameter> parameters;
  std::function<std::unique_ptr<BudgetDriver>(const ParameterValues&)> make;
  /// Throws Error if the values do not go together; null: all do. Called where the driver is chosen.
  std::function<void(const ParameterValues&)> check = {};
  /// Name of the driver that it starts from, whose parameters then count too; null or "uniform": none.
  std::function<std::string(const ParameterValues&)> base = {};
  /// Names of all that count() may return, those of a base aside.
  std::vector<Quantity> counters = {};
};

/// All drivers, in order of their names' places in the choice. The uniform budget needs no driver.
const std::vector<BudgetDriverInfo>& budgetDrivers();

/// `budget_map` and the parameters of all drivers.
std::vector<Parameter> budgetParameters();
/// Throws Error where values do not go together, or a driver's are given without it.
void checkBudget(const ParameterValues& values);
/// Some driver is chosen.
bool hasBudgetMap(const ParameterValues& values);
/// The chosen driver; null for a uniform budget.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const ParameterValues& values);
/// The driver of that name, whatever `budget_map` says; null for "uniform".
std::unique_ptr<BudgetDriver> makeBudgetDriver(const std::string& name, const ParameterValues& values);

}  // namespace limen::techniques
