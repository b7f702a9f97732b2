// SPDX-License-Identifier: BSD-3-Clause
// Reference of all LOD techniques: every object at its finest level, many samples per pixel. Its only error
// comes from the finite samples of the box filter; its geometry is exact.
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"

namespace limen::techniques {
namespace {

struct FinestSettings {
  int samples = 4;
  frame::ShadedSetting shading;
  static const SettingsTable<FinestSettings>& table() {
    using S = FinestSettings;
    static const SettingsTable<S> kTable = {samplesBinding(&S::samples), frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class Finest : public Technique {
 public:
  using Settings = FinestSettings;
  explicit Finest(const FinestSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    view_.emplace(frame, "finest", settings_.shading, settings_.samples);
    view_->setLevels(scene::finestLevels(frame.scene()));
  }
  void render(frame::Frame&) override { view_->render(); }
  const gl::Texture& product() const override { return view_->texture(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    return selectionCounters(frame.scene(), scene::finestLevels(frame.scene()),
                             {frame.camera(), frame.sizePx().y});
  }

 private:
  FinestSettings settings_;
  std::optional<BoxView> view_;
};

const RegisteredTechnique<Finest> kFinestRegistered{
    {.name = "lod/finest",
     .version = 1,
     .summary = "The finest level of every object, supersampled",
     .source = "bench",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .reference = true,
     .counters = selectionQuantities()}};

}  // namespace
}  // namespace limen::techniques
