// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/radial_budget.h"

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

class RadialBudget : public BudgetDriver {
 public:
  explicit RadialBudget(const ParameterValues& values)
      : innerBudget_(static_cast<double>(values.integer("budget"))),
        outerBudget_(static_cast<double>(values.integer("radial_budget"))),
        centre_(values.real("radial_centre_x"), values.real("radial_centre_y")),
        inner_(values.real("radial_inner")),
        outer_(values.real("radial_outer")) {}

  /// The map depends on nothing that a frame changes: it is made here.
  void prepare(frame::Frame& frame) override {
    map_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("soft_shadows/budget_map", map_->bytes());
    const gl::Program& program = frame.context().programs().compute(
        "renderer/techniques/soft_shadows/quality/radial_budget.comp.glsl");
    program.set("sizePx", frame.sizePx());
    program.set("centre", glm::vec2(centre_));
    program.set("innerRadius", static_cast<float>(inner_));
    program.set("outerRadius", static_cast<float>(outer_));
    program.set("innerRoot", static_cast<float>(std::sqrt(innerBudget_)));
    program.set("outerRoot", static_cast<float>(std::sqrt(outerBudget_)));
    map_->bindImage(0, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  const gl::Texture& make(frame::Frame&) override { return *map_; }

 private:
  double innerBudget_, outerBudget_;
  glm::dvec2 centre_;
  double inner_, outer_;
  std::optional<gl::Texture> map_;
};

void checkRadialBudget(const ParameterValues& values) {
  if (values.integer("budget") == 0)
    throw Error("a budget without limit has no way down to a rim", "budget",
                "give 'budget' a number above 0, or budget_map: uniform");
  if (values.real("radial_inner") >= values.real("radial_outer"))
    throw Error("the rim at 'radial_outer' lies within 'radial_inner'", "radial_outer",
                "give it a larger radius than 'radial_inner'");
}

}  // namespace

BudgetDriverInfo radialBudgetInfo() {
  const char* source = "Schwarz 2009, figure 5.5 d";
  return {
      .name = "radial",
      .parameters = {integerParameter(
                         "radial_budget", 25, 1, 1 << 24, "",
                         "Micro-occluders allowed for a pixel at the rim; 'budget' is what is allowed "
                         "in the centre",
                         source),
                     realParameter("radial_centre_x", 0.5, 0.0, 1.0, "",
                                   "Centre of the budget map, as a share of the image's width"),
                     realParameter("radial_centre_y", 0.5, 0.0, 1.0, "",
                                   "Centre of the budget map, as a share of the image's height from its top"),
                     realParameter("radial_inner", 0.0, 0.0, 10.0, "half width",
                                   "Distance from the centre up to which the whole budget is allowed"),
                     realParameter("radial_outer", 1.0, 0.001, 10.0, "half width",
                                   "Distance from the centre at which the rim's budget is reached", source)},
      .make = [](const ParameterValues& values) { return std::make_unique<RadialBudget>(values); },
      .check = checkRadialBudget};
}

}  // namespace limen::techniques
