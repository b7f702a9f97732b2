// SPDX-License-Identifier: BSD-3-Clause
// Discrete levels of detail with hard switches (SP-57; Schwarz 2009, section 2.4): in each frame one level
// per object, chosen by distance (SP-38), by screen extent or screen error, or fixed. Switching uploads
// nothing.
#include <optional>

#include "renderer/techniques/lod/box_view.h"
#include "renderer/techniques/lod/level_control.h"

namespace limen::techniques {
namespace {

struct DiscreteSettings {
  LevelControlSettings levels;
  int samples = 1;
  frame::ShadedSetting shading;
  static const SettingsTable<DiscreteSettings>& table() {
    using S = DiscreteSettings;
    static const SettingsTable<S> kTable = {included(&S::levels), samplesBinding(&S::samples),
                                            frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class Discrete : public Technique {
 public:
  using Settings = DiscreteSettings;
  explicit Discrete(const DiscreteSettings& settings) : settings_(settings), control_(settings.levels) {}

  void prepare(frame::Frame& frame) override {
    view_.emplace(frame, "discrete", settings_.shading, settings_.samples);
  }

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
  DiscreteSettings settings_;
  LevelControl control_;
  scene::LodSelection shown_;
  std::optional<BoxView> view_;
};

std::vector<Quantity> discreteQuantities() {
  std::vector<Quantity> out = selectionQuantities();
  out.push_back(levelSwitches());
  return out;
}

const RegisteredTechnique<Discrete> kDiscreteRegistered{
    {.name = "lod/discrete",
     .version = 1,
     .summary = "One level per object and frame, chosen by distance, screen extent or screen error",
     .source = "Schwarz 2009, sections 2.4 and 10.3.5 (SP-57)",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .counters = discreteQuantities()}};

}  // namespace
}  // namespace limen::techniques
