// SPDX-License-Identifier: BSD-3-Clause
// Visibility at the end of a motion of the light, and of the camera (SS-43): a history still remembers places
// where the light was. Against the visibility of a light that never moved this is its lag, the price of what
// it does for stability. Without a history it is the inner technique itself.
#include "renderer/techniques/soft_shadows/change/light_motion.h"

namespace limen::techniques {
namespace {

class InMotion : public Technique {
 public:
  explicit InMotion(const ParameterValues& values) : motion_(values) {
    motion_.setCameraStep(values.real("camera_step_s"));
  }

  void prepare(frame::Frame& frame) override {
    motion_.prepare(frame, motion_.hasHistory() ? motion_.steps() + 1 : 1);
  }
  void render(frame::Frame& frame) override { motion_.render(frame); }
  const gl::Texture& product() const override { return *motion_.last().visibility; }
  std::vector<Counter> count(frame::Frame&) override { return motion_.count(); }

 private:
  LightMotion motion_;
};

std::vector<Parameter> inMotionParameters() {
  std::vector<Parameter> all = LightMotion::parameters();
  all.push_back(realParameter("camera_step_s", 0.0, 0.0, 10.0, "s",
                              "Time that the camera moves on along its path with each step of the light"));
  return all;
}

const Registered<TechniqueInfo> kInMotionTechnique{
    {.name = "soft_shadows/in_motion",
     .version = 1,
     .summary = "Visibility of another technique at the end of a motion of the light, with a history or not",
     .source = "Schwarz 2009, section 5.2.2 (SS-43)",
     .product = ProductKind::Visibility,
     .parameters = inMotionParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<InMotion>(values); },
     .errorBound = {},
     .counters = LightMotion::counterNames(),
     .check = LightMotion::check}};

}  // namespace
}  // namespace limen::techniques
