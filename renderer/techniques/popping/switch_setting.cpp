// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/popping/switch_setting.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/lod_pair.h"
#include "renderer/scene/lod_control.h"
#include "renderer/techniques/lod/box_view.h"

namespace limen::techniques {

const SettingsTable<DynamicPresentation>& DynamicPresentation::table() {
  using S = DynamicPresentation;
  static const SettingsTable<S> kTable = {
      Binding(&S::dtS, "dt_s", Range{0.0, 1.0}, "s",
              "Time from the last frame before the change to the first after it; 0: one frame of the display")
          .formerly({"dt_s"}),
      Binding(&S::flickerLevel, "flicker_level",
              "Level whose shading is compared with the previous frame; after: the change itself counts as "
              "flicker",
              "choice; Schwarz 2009, section 10.3.5, does not say")
          .formerly({"flicker_level"})};
  return kTable;
}

const SettingsTable<SwitchSettings>& SwitchSettings::table() {
  using S = SwitchSettings;
  const std::string kThesis = "Schwarz 2009, section 10.3.1";
  static const SettingsTable<S> kTable = {
      {&S::object, "object", {0, 65535}, "", "Index of the object that changes its level"},
      {&S::fromLevel, "from_level", {0, 15}, "", "Level before the change; 0 is the finest", kThesis},
      {&S::toLevel, "to_level", {0, 15}, "", "Level after the change", kThesis},
      {&S::others, "others",
       "Levels of all other objects: the finest, by the scene's switch distances, or not drawn"},
      {&S::presentation, "presentation", "How the change is shown", "Schwarz 2009, section 10.4.1"},
      // Four samples per pixel correspond to common antialiasing; the thesis does not say what it used.
      samplesBinding(&S::samples),
      included(&S::viewing),
      frame::shadingBinding(&S::shading),
      {&S::predictor, "predictor", "The popping predictor"}};
  return kTable;
}

void SwitchSettings::check() const { SwitchSetting{*this}; }

SwitchSetting::SwitchSetting(const SwitchSettings& settings)
    : object(settings.object),
      fromLevel(settings.fromLevel),
      toLevel(settings.toLevel),
      others(settings.others),
      samples(settings.samples),
      shaded(settings.shading),
      display(settings.viewing.profile()),
      popping(settings.predictor) {
  double dt = 0.0;
  if (const auto* moving = std::get_if<DynamicPresentation>(&settings.presentation)) {
    flickerOfBefore = moving->flickerLevel == FlickerLevel::Before;
    dt = moving->dtS;
  } else {
    dynamic = false;
  }
  dtS = std::max(dt > 0.0 ? dt : 1.0 / display.refreshHz, 1e-4);
  display.refreshHz = 1.0 / dtS;
}

std::pair<scene::LodSelection, scene::LodSelection> SwitchSetting::levels(const frame::Frame& frame) const {
  const scene::Scene& scene = frame.scene();
  const std::string where = "scene '" + scene.name + "'";
  if (object >= scene.lodObjects.size())
    throw Error("no object " + std::to_string(object) + " with levels of detail", where,
                "choose 'object' from 0 to " + std::to_string(scene.lodObjects.size() - 1));
  const int count = static_cast<int>(scene.lodObjects[object].levels.size());
  for (const auto& [name, level] : {std::pair{"from_level", fromLevel}, {"to_level", toLevel}})
    if (level >= count)
      throw Error("'" + std::string(name) + "' is " + std::to_string(level) + ", but the object has " +
                      std::to_string(count) + " levels",
                  where, "choose 0 to " + std::to_string(count - 1));
  scene::LodSelection base = scene::finestLevels(scene);
  if (others == OtherLevels::Distance)
    base = scene::levelsByDistance(scene, {frame.camera(), frame.sizePx().y});
  if (others == OtherLevels::Omitted)
    std::fill(base.levels.begin(), base.levels.end(), scene::LodSelection::kOmitted);
  return frame::objectChange(base, object, fromLevel, toLevel);
}

}  // namespace limen::techniques
