// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/pipeline.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <limits>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kVisible = "perceptual_lod/visible_pixels";

std::string testPass(int number) { return "perceptual_lod/test_" + std::to_string(number); }
std::string layerPrefix(int layer) { return "layer_" + std::to_string(layer) + "/"; }

std::vector<int> levelCounts(const scene::Scene& scene) {
  std::vector<int> out;
  for (const scene::LodObject& object : scene.lodObjects)
    out.push_back(static_cast<int>(object.levels.size()));
  return out;
}

}  // namespace

PerceptualPipeline::TestViews::TestViews(frame::Frame& parent, int number, bool shadows, bool withNext)
    : finest(parent, "finest_" + std::to_string(number)) {
  const std::string suffix = "_" + std::to_string(number);
  if (withNext) next = std::make_unique<LevelView>(parent, "next" + suffix);
  if (!shadows) return;
  finestCasters = std::make_unique<LevelView>(parent, "finest_casters" + suffix);
  if (withNext) nextCasters = std::make_unique<LevelView>(parent, "next_casters" + suffix);
}

PerceptualPipeline::PerceptualPipeline(frame::Frame& parent, const PerceptualLodSettings& settings)
    : parent_(parent),
      settings_(settings),
      seenOn_(settings.model.seenOn()),
      images_(parent, settings),
      control_(settings.rule, levelCounts(parent.scene()),
               settings.startLevel == StartLevel::Finest ? 0 : std::numeric_limits<int>::max()),
      thresholdMap_(parent.context(), parent.sizePx(), seenOn_.display, seenOn_.map, settings.gpu),
      visible_(gl::Format::R32F, parent.sizePx()),
      counts_(parent.context(), settings.tests.count, settings.tests.objectsPerFrame,
              settings.rule.lookAhead(), visible_) {
  int64_t bytes = visible_.bytes() + counts_.bytes();
  visible_.clear(glm::vec4(0.0F));
  for (int i = 0; i < layerCount(settings.layers); ++i) {
    maps_.emplace_back(gl::Format::R32F, parent.sizePx());
    maps_.back().clear(glm::vec4(0.0F));
    bytes += maps_.back().bytes();
  }
  for (int i = 0; i < settings.tests.objectsPerFrame; ++i)
    testViews_.push_back(
        std::make_unique<TestViews>(parent, i, images_.hasShadows(), settings.rule.lookAhead()));
  parent.passes().setBytesHeld(kVisible, bytes);
  parent.passes().setBytesHeld("perceptual_lod/threshold_map", thresholdMap_.bytesHeld());
}

void PerceptualPipeline::prime(double timeS) {
  timeS_ = timeS;
  images_.prime(timeS);
  for (int layer = 1; layer < images_.layers(); ++layer) makeMap(layer);
  { const auto scope = parent_.passes().open(kVisible); }
  for (int i = 0; i < settings_.tests.objectsPerFrame; ++i) test(i, -1, true);
  mapsMade_ = 0;
  trianglesTested_ = 0;
}

void PerceptualPipeline::takeResults(bool wait) {
  taken_.clear();
  while (const auto batch = counts_.take(frameNumber_ - settings_.tests.latencyFrames, wait))
    for (const LevelTest& test : *batch) {
      control_.apply(test);
      taken_.push_back(test);
    }
}

std::vector<char> PerceptualPipeline::testable() const {
  std::vector<char> out;
  for (const PixelRect& rect : pixels_) out.push_back(rect.empty() ? 0 : 1);
  return out;
}

void PerceptualPipeline::makeMap(int layer) {
  images_.makeContext(layer);
  gl::PassList& passes = parent_.passes();
  passes.setPrefix(layerPrefix(layer));
  const gl::Texture& map = thresholdMap_.run(images_.context(layer), &passes);
  const gl::Texture& to = maps_[static_cast<size_t>(layer - 1)];
  glCopyImageSubData(map.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.sizePx().x,
                     to.sizePx().y, 1);
  ++mapsMade_;
}

frame::Frame& PerceptualPipeline::versionOf(LevelView& view, LevelView* casters, int object, int level) {
  const scene::Scene& scene = parent_.scene();
  scene::LodSelection alone = nothingOf(scene), all = images_.shown();
  if (object >= 0) {
    alone = onlyObject(scene, object, level);
    all.levels[static_cast<size_t>(object)] = level;
  }
  if (casters) {
    // The object casts its shadow with the level under test; the others with their current levels.
    casters->show(timeS_, all);
    view.frame().setCasters(&casters->frame());
  }
  trianglesTested_ += static_cast<int64_t>(scene::triangleCount(scene, alone));
  frame::Frame& frame = view.show(timeS_, alone);
  frame.get<frame::Shaded>(settings_.shading);
  return frame;
}

void PerceptualPipeline::test(int number, int object, bool priming) {
  TestViews& views = *testViews_[static_cast<size_t>(number)];
  const scene::Scene& scene = parent_.scene();
  const int level = priming ? 0 : images_.shown().levels[static_cast<size_t>(object)];
  frame::Frame& finest = versionOf(views.finest, views.finestCasters.get(), object, 0);
  frame::Frame* next = nullptr;
  if (views.next) {
    const int coarsest =
        priming ? 0 : static_cast<int>(scene.lodObjects[static_cast<size_t>(object)].levels.size()) - 1;
    next = &versionOf(*views.next, views.nextCasters.get(), object, std::min(level + 1, coarsest));
  }
  const auto scope = parent_.passes().open(testPass(number));
  if (priming) return;
  const auto bindVersion = [&](frame::Frame& frame, uint32_t colour, uint32_t depth, uint32_t ids) {
    frame.get<frame::Shaded>(settings_.shading).texture().bindTexture(colour);
    frame.get<frame::TriangleIds>().depth().bindTexture(depth);
    frame.get<frame::TriangleIds>().texture().bindTexture(ids);
  };
  images_.composite().bindTexture(kLevelTestFrontColourUnit);
  images_.frontKey().bindTexture(kLevelTestFrontKeyUnit);
  images_.secondColour().bindTexture(kLevelTestSecondColourUnit);
  images_.secondKey().bindTexture(kLevelTestSecondKeyUnit);
  maps_[static_cast<size_t>(layerOf_[static_cast<size_t>(object)] - 1)].bindTexture(kLevelTestThresholdUnit);
  bindVersion(finest, kLevelTestFinestColourUnit, kLevelTestFinestDepthUnit, kLevelTestFinestIdsUnit);
  if (next) bindVersion(*next, kLevelTestNextColourUnit, kLevelTestNextDepthUnit, kLevelTestNextIdsUnit);
  const auto index = static_cast<size_t>(object);
  counts_.count({object, level, scene.triangles(scene.lodObjects[index], level), pixels_[index]});
}

void PerceptualPipeline::render(double timeS, bool wait) {
  takeResults(wait);
  timeS_ = timeS;
  mapsMade_ = 0;
  trianglesTested_ = 0;
  const scene::Scene& scene = parent_.scene();
  const scene::Camera camera = scene.camera.at(timeS);
  std::vector<double> distances;
  for (const scene::LodObject& object : scene.lodObjects)
    distances.push_back(glm::length(object.bounds.centre() - camera.eye));
  layerOf_ = assignLayers(settings_.layers, distances);
  for (int& layer : layerOf_) ++layer;
  images_.render(timeS, {control_.levels(), true}, layerOf_);
  pixels_.clear();
  for (const scene::LodObject& object : scene.lodObjects)
    pixels_.push_back(pixelsOf(object.bounds, images_.view()));

  std::vector<int> objects;
  // With all batches in flight the GPU is far behind: this frame tests nothing instead of waiting.
  if (counts_.ready()) objects = control_.nextTests(settings_.tests.objectsPerFrame, testable());
  std::vector<char> needed(static_cast<size_t>(images_.layers()), 0);
  for (const int layer : layerOf_)
    if (settings_.tests.thresholdMaps == MappedLayers::All) needed[static_cast<size_t>(layer)] = 1;
  for (const int object : objects) needed[static_cast<size_t>(layerOf_[static_cast<size_t>(object)])] = 1;
  for (int layer = 1; layer < images_.layers(); ++layer)
    if (needed[static_cast<size_t>(layer)]) makeMap(layer);
  if (!objects.empty()) {
    const perception::DisplayProfile& display = seenOn_.display;
    {
      const auto scope = parent_.passes().open(kVisible);
      counts_.begin(frameNumber_, static_cast<float>(display.blackLevelCdM2()),
                    static_cast<float>(display.whiteLevelCdM2() - display.blackLevelCdM2()));
    }
    for (size_t i = 0; i < objects.size(); ++i) test(static_cast<int>(i), objects[i], false);
    counts_.end();
  }
  ++frameNumber_;
}

std::map<std::string, const gl::Texture*> PerceptualPipeline::debugViews() {
  std::map<std::string, const gl::Texture*> out = {{"background", &images_.image(0)},
                                                   {"visible_pixels", &visible_}};
  for (int layer = 1; layer < images_.layers(); ++layer) {
    // A layer without objects is not drawn.
    if (std::find(layerOf_.begin(), layerOf_.end(), layer) == layerOf_.end()) continue;
    const std::string number = std::to_string(layer);
    out["layer_" + number] = &images_.image(layer);
    out["context_" + number] = &images_.context(layer);
    out["threshold_map_" + number] = &maps_[static_cast<size_t>(layer - 1)];
    if (const gl::Texture* mask = images_.mask(layer)) out["shadow_mask_" + number] = mask;
  }
  return out;
}

}  // namespace limen::techniques
