// SPDX-License-Identifier: BSD-3-Clause
// Discrete levels of detail with hard switches (SP-57; Schwarz 2009, section 2.4): each frame one level an
// object, chosen by distance (SP-38), by extent or error on the screen, or fixed. Switching uploads nothing.
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"

namespace limen::techniques {
namespace {

class Discrete : public Technique {
 public:
  explicit Discrete(const ParameterValues& values)
      : control_(values),
        shaded_(frame::ShadedSetting::from(values)),
        samples_(static_cast<int>(values.integer("samples"))) {}

  void prepare(frame::Frame& frame) override { view_.emplace(frame, "discrete", shaded_, samples_); }

  void render(frame::Frame& frame) override {
    const scene::LodSelection chosen = control_.choose(frame.scene(), {frame.camera(), frame.sizePx().y});
    if (chosen != shown_) view_->setLevels(chosen);
    shown_ = chosen;
    view_->render();
  }
  const gl::Texture& product() const override { return view_->texture(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    return control_.counters(frame.scene(), {frame.camera(), frame.sizePx().y});
  }

 private:
  LevelControl control_;
  frame::ShadedSetting shaded_;
  int samples_;
  scene::LodSelection shown_;
  std::optional<BoxView> view_;
};

std::vector<Parameter> discreteParameters() {
  std::vector<Parameter> out = LevelControl::parameters();
  out.push_back(samplesParameter(1));
  for (Parameter& parameter : frame::ShadedSetting::parameters()) out.push_back(std::move(parameter));
  return out;
}

const Registered<TechniqueInfo> kDiscreteRegistered{
    {.name = "lod/discrete",
     .version = 1,
     .summary = "One level an object and frame, chosen by distance, extent or error on the screen",
     .source = "Schwarz 2009, sections 2.4 and 10.3.5 (SP-57)",
     .product = ProductKind::Colour,
     .parameters = discreteParameters(),
     .needs = {"lod_sets"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Discrete>(values); },
     .errorBound = {},
     .counters = {"triangles_drawn", "level_mean", "screen_error_px", "level_switches"}}};

}  // namespace
}  // namespace limen::techniques
