// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/state_view.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/frame/lod_pair.h"
#include "renderer/scene/lod_control.h"

namespace limen::study {
namespace {

const techniques::TechniqueInfo& techniqueOf(const NamedEntry& entry, const scene::Scene& scene) {
  const std::string where = "technique '" + entry.name + "'";
  const techniques::TechniqueInfo& info =
      techniques::TechniqueRegistry::instance().get(entry.name, "stimulus");
  if (info.version != entry.version)
    throw Error(fmt::format("version {} is requested", entry.version), where,
                fmt::format("this program has version {}", info.version));
  if (info.product != techniques::ProductKind::Colour && info.product != techniques::ProductKind::Visibility)
    throw Error("its product '" + toText(info.product) + "' is not a picture", where,
                "a stimulus takes techniques that make colour or visibility");
  checkFiles(entry, where);
  const std::set<std::string> traits = scene.traits();
  for (const std::string& need : info.needs)
    if (!traits.count(need))
      throw Error("needs a scene with '" + need + "'", where,
                  "scene '" + scene.name + "' has: " + join({traits.begin(), traits.end()}));
  return info;
}

void checkSize(glm::ivec2 sizePx, int samples) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (samples >= 1 && std::max(sizePx.x, sizePx.y) <= largest / samples) return;
  throw Error(
      fmt::format("{} samples along each axis of {} x {} px", samples, sizePx.x, sizePx.y), "stimulus",
      fmt::format("this driver supports pictures of at most {} px: lower 'samples' or the window's size",
                  largest));
}

}  // namespace

scene::LodSelection levelsOf(const scene::Scene& scene, const LevelChange& change, bool after,
                             double changeSceneTimeS, int heightPx) {
  const std::string where = "scene '" + scene.name + "'";
  const auto object = static_cast<size_t>(change.object);
  if (change.object < 0 || object >= scene.lodObjects.size())
    throw Error(fmt::format("no object {} with levels of detail", change.object), where,
                scene.lodObjects.empty() ? "it has none"
                                         : fmt::format("choose 0 to {}", scene.lodObjects.size() - 1));
  const int count = static_cast<int>(scene.lodObjects[object].levels.size());
  for (const int level : {change.before, change.after})
    if (level < 0 || level >= count)
      throw Error(fmt::format("no level {}: the object has {}", level, count), where,
                  fmt::format("choose 0 to {}", count - 1));
  scene::LodSelection others = scene::finestLevels(scene);
  if (change.others == "distance")
    others = scene::levelsByDistance(scene, {scene.camera.at(changeSceneTimeS), heightPx});
  else if (change.others == "omitted")
    std::fill(others.levels.begin(), others.levels.end(), scene::LodSelection::kOmitted);
  else if (change.others != "finest")
    throw Error("no levels '" + change.others + "' for the other objects", where,
                suggest(change.others, {"finest", "distance", "omitted"}));
  const auto [now, old] = frame::objectChange(others, object, change.before, change.after);
  return after ? now : old;
}

frame::ShadedSetting shadingOf(const Stimulus& stimulus) {
  const SettingsTable<frame::ShadedSetting>& table = frame::ShadedSetting::table();
  return table.read({table.parameters(), stimulus.shading.all(), "shading of the stimulus"});
}

StateView::StateView(gl::Context& context, std::shared_ptr<const frame::SceneOnGpu> onGpu,
                     const Stimulus& stimulus, bool after, glm::ivec2 sizePx, double changeSceneTimeS)
    : scene_(std::move(onGpu)), shaded_(shadingOf(stimulus)) {
  checkSize(sizePx, stimulus.samples);
  const glm::ivec2 sampledPx = sizePx * stimulus.samples;
  const scene::Scene& scene = scene_->scene;
  if (stimulus.levels.has_value() == stimulus.before.has_value() || (stimulus.after && !stimulus.before))
    throw Error("a stimulus shows levels of detail or a technique", "stimulus",
                "give either 'levels', or 'before' with or without 'after'");
  if (stimulus.levels) {
    const scene::LodSelection levels = levelsOf(scene, *stimulus.levels, after, changeSceneTimeS, sizePx.y);
    frame_ = std::make_unique<frame::Frame>(context, *scene_, sampledPx);
    frame_->setLevels(levels);
  } else {
    const NamedEntry& entry = after && stimulus.after ? *stimulus.after : *stimulus.before;
    const techniques::TechniqueInfo& info = techniqueOf(entry, scene);
    modulates_ = info.product == techniques::ProductKind::Visibility;
    if (modulates_) shaded_.shadow = false;
    frame_ = std::make_unique<frame::Frame>(context, *scene_, sampledPx);
    frame_->setTime(changeSceneTimeS);
    technique_ =
        info.make(ParameterValues(info.parameters, entry.values.all(), "technique '" + entry.name + "'"));
    technique_->prepare(*frame_);
  }
  // Inputs are made on first use; that must not be during presentation.
  render(changeSceneTimeS);
}

StateView::~StateView() = default;

StateView::Picture StateView::render(double sceneTimeS) {
  frame_->setTime(sceneTimeS);
  frame_->begin();
  Picture out;
  if (technique_) {
    technique_->render(*frame_);
    out.lit = &technique_->product();
  }
  if (modulates_) {
    out.visibility = out.lit;
    frame::ShadedSetting unlit = shaded_;
    unlit.diffuse = unlit.specular = 0.0;
    out.unlit = &frame_->get<frame::Shaded>(unlit).texture();
  }
  if (!technique_ || modulates_) out.lit = &frame_->get<frame::Shaded>(shaded_).texture();
  frame_->end();
  return out;
}

}  // namespace limen::study
