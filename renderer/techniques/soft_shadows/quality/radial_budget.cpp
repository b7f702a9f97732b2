// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/radial_budget.h"

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"

namespace limen::techniques {
namespace {

class RadialBudgetDriver : public BudgetDriver {
 public:
  explicit RadialBudgetDriver(const RadialBudget& settings) : settings_(settings) {}

  /// The map does not depend on the frame, so it is made here.
  void prepare(frame::Frame& frame) override {
    map_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("soft_shadows/budget_map", map_->bytes());
    const gl::Program& program = frame.context().programs().compute(
        "renderer/techniques/soft_shadows/quality/radial_budget.comp.glsl");
    program.set("sizePx", frame.sizePx());
    program.set("centre", glm::vec2(settings_.centreX, settings_.centreY));
    program.set("innerRadius", static_cast<float>(settings_.inner));
    program.set("outerRadius", static_cast<float>(settings_.outer));
    program.set("innerRoot", static_cast<float>(std::sqrt(static_cast<double>(settings_.centre))));
    program.set("outerRoot", static_cast<float>(std::sqrt(static_cast<double>(settings_.rim))));
    map_->bindImage(kRadialBudgetImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  const gl::Texture& make(frame::Frame&) override { return *map_; }

 private:
  RadialBudget settings_;
  std::optional<gl::Texture> map_;
};

}  // namespace

std::unique_ptr<BudgetDriver> makeBudgetDriver(const RadialBudget& settings) {
  return std::make_unique<RadialBudgetDriver>(settings);
}

}  // namespace limen::techniques
