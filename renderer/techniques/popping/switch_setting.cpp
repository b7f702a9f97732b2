// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/popping/switch_setting.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "perception/threshold_maps/viewing.h"
#include "renderer/frame/lod_pair.h"
#include "renderer/scene/lod_control.h"
#include "renderer/techniques/lod/box_view.h"

namespace limen::techniques {

std::vector<Parameter> SwitchSetting::parameters() {
  const std::string kThesis = "Schwarz 2009, section 10.3.1";
  std::vector<Parameter> all = {
      integerParameter("object", 0, 0, 65535, "", "Number of the object that changes its level"),
      integerParameter("from_level", 1, 0, 15, "", "Level before the change; 0 is the finest", kThesis),
      integerParameter("to_level", 0, 0, 15, "", "Level after the change", kThesis),
      choiceParameter(
          "others", "finest", {"finest", "distance", "omitted"},
          "Levels of all other objects: the finest, by the scene's switch distances, or not drawn"),
      choiceParameter(
          "presentation", "dynamic", {"dynamic", "static"},
          "dynamic: the camera moves as the scene says; static: the same two pictures shown at rest",
          "Schwarz 2009, section 10.4.1"),
      realParameter(
          "dt_s", 0.0, 0.0, 1.0, "s",
          "Time from the last frame before the change to the first after it; 0: one of the display's "
          "frames")};
  all.push_back(choiceParameter(
      "flicker_level", "before", {"before", "after"},
      "Level whose shading is compared with the previous frame; after: the change itself counts as flicker",
      "choice; Schwarz 2009, section 10.3.5, does not say"));
  // Four samples a pixel are what common antialiasing shows; the thesis does not say what it used.
  all.push_back(samplesParameter(2));
  for (const std::vector<Parameter>& more :
       {perception::ViewingSettings::table().parameters(), frame::ShadedSetting::parameters(),
        perception::PoppingSettings::table().parameters()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

SwitchSetting SwitchSetting::from(const ParameterValues& values) {
  SwitchSetting s;
  s.object = static_cast<size_t>(values.integer("object"));
  s.fromLevel = static_cast<int>(values.integer("from_level"));
  s.toLevel = static_cast<int>(values.integer("to_level"));
  s.others = values.text("others");
  s.dynamic = values.text("presentation") == "dynamic";
  s.flickerOfBefore = values.text("flicker_level") == "before";
  s.samples = static_cast<int>(values.integer("samples"));
  s.shaded = frame::ShadedSetting::from(values);
  s.display = perception::ViewingSettings::table().read(values).profile();
  s.popping = perception::PoppingSettings::table().read(values);
  const double dt = values.real("dt_s");
  s.dtS = std::max(dt > 0.0 ? dt : 1.0 / s.display.refreshHz, 1e-4);
  s.display.refreshHz = 1.0 / s.dtS;
  return s;
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
  if (others == "distance") base = scene::levelsByDistance(scene, {frame.camera(), frame.sizePx().y});
  if (others == "omitted") std::fill(base.levels.begin(), base.levels.end(), scene::LodSelection::kOmitted);
  return frame::objectChange(base, object, fromLevel, toLevel);
}

}  // namespace limen::techniques
