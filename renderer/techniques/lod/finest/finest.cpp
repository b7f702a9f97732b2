// SPDX-License-Identifier: BSD-3-Clause
// Reference of all LOD techniques: every object at its finest level, many samples a pixel. Its own error is
// that of the box filter's finite samples; it has none in geometry.
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"

namespace limen::techniques {
namespace {

class Finest : public Technique {
 public:
  explicit Finest(const ParameterValues& values)
      : shaded_(frame::ShadedSetting::from(values)), samples_(static_cast<int>(values.integer("samples"))) {}

  void prepare(frame::Frame& frame) override {
    view_.emplace(frame, "finest", shaded_, samples_);
    view_->setLevels(scene::finestLevels(frame.scene()));
  }
  void render(frame::Frame&) override { view_->render(); }
  const gl::Texture& product() const override { return view_->texture(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    return selectionCounters(frame.scene(), scene::finestLevels(frame.scene()),
                             {frame.camera(), frame.sizePx().y});
  }

 private:
  frame::ShadedSetting shaded_;
  int samples_;
  std::optional<BoxView> view_;
};

std::vector<Parameter> finestParameters() {
  std::vector<Parameter> out{samplesParameter(4)};
  for (Parameter& parameter : frame::ShadedSetting::parameters()) out.push_back(std::move(parameter));
  return out;
}

const Registered<TechniqueInfo> kFinestRegistered{
    {.name = "lod/finest",
     .version = 1,
     .summary = "The finest level of every object, supersampled",
     .source = "bench",
     .product = ProductKind::Colour,
     .parameters = finestParameters(),
     .needs = {"lod_sets"},
     .reference = true,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Finest>(values); },
     .errorBound = {},
     .counters = {"triangles_drawn", "level_mean", "screen_error_px"}}};

}  // namespace
}  // namespace limen::techniques
