// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/pipeline.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <limits>

#include "perception/thresholds/thresholds_gpu.h"

namespace limen::techniques {
namespace {

constexpr const char* kTests = "perceptual_lod/tests";

std::string layerPrefix(int layer) { return "layer_" + std::to_string(layer) + "/"; }

std::vector<int> levelCounts(const scene::Scene& scene) {
  std::vector<int> out;
  for (const scene::LodObject& object : scene.lodObjects)
    out.push_back(static_cast<int>(object.levels.size()));
  return out;
}

void copyTexture(const gl::Texture& from, const gl::Texture& to) {
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  glCopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.sizePx().x,
                     to.sizePx().y, 1);
}

}  // namespace

PerceptualPipeline::PerceptualPipeline(frame::Frame& parent, const PerceptualLodSettings& settings)
    : parent_(parent),
      settings_(settings),
      seenOn_(settings.model.seenOn()),
      images_(parent, settings, seenOn_),
      control_(settings.rule, levelCounts(parent.scene()),
               settings.startLevel == StartLevel::Finest ? 0 : std::numeric_limits<int>::max()),
      thresholds_(perception::makeThresholds(parent.context(), parent.sizePx(), seenOn_.display,
                                             settings.model.thresholds, false)),
      counts_(parent.context(), settings.tests.count, images_.defines(), settings.tests.objectsPerFrame,
              parent.sizePx()) {
  parent.passes().setBytesHeld(kTests, counts_.bytes());
  parent.passes().setBytesHeld("perceptual_lod/threshold_map", thresholds_->bytesHeld());
}

void PerceptualPipeline::prime(double timeS) {
  const scene::Scene& scene = parent_.scene();
  images_.moveTo(timeS);
  layerOf_.assign(scene.lodObjects.size(), 1);
  std::vector<ObjectTest> tests;
  for (size_t i = 0;
       i < scene.lodObjects.size() && static_cast<int>(tests.size()) < settings_.tests.objectsPerFrame; ++i)
    tests.push_back({static_cast<int>(i), 0, true, scene.lodObjects[i].levels.size() > 1});
  tests.resize(images_.fitting(tests));
  images_.draw({control_.levels(), true}, layerOf_, tests);
  for (int layer = 1; layer < images_.layers(); ++layer) {
    makeMap(layer, true);
    const auto scope = parent_.passes().open(layerPrefix(layer) + kTests);
  }
  images_.compose(0);
  mapsMade_ = 0;
}

void PerceptualPipeline::takeResults(bool wait) {
  taken_.clear();
  while (const auto batch = counts_.take(frameNumber_ - settings_.tests.latencyFrames, wait))
    for (const LevelTest& test : *batch) {
      control_.apply(test);
      taken_.push_back(test);
    }
}

std::vector<ObjectTest> PerceptualPipeline::nextTests() {
  // With all batches in flight the GPU is far behind: this frame tests nothing instead of waiting.
  if (!counts_.ready()) return {};
  std::vector<char> testable;
  for (const PixelRect& rect : pixels_) testable.push_back(rect.empty() ? 0 : 1);
  const std::vector<int> objects = control_.nextTests(settings_.tests.objectsPerFrame, testable);
  std::vector<ObjectTest> tests;
  for (const int object : objects) {
    const int level = control_.levels()[static_cast<size_t>(object)];
    tests.push_back({object, level, level > 0, control_.triesNext(object)});
  }
  const size_t count = images_.fitting(tests);
  if (count < objects.size()) control_.resumeWith(objects[count]);
  tests.resize(count);
  return tests;
}

const gl::Texture& PerceptualPipeline::makeMap(int layer, bool timed,
                                               const std::optional<perception::MapArea>& only) {
  images_.compose(layer);
  gl::PassList& passes = parent_.passes();
  passes.setPrefix(layerPrefix(layer));
  return thresholds_->run(images_.context(), timed ? &passes : nullptr, only);
}

void PerceptualPipeline::bindTests(const gl::Program& program, const gl::Texture& thresholds) {
  images_.bindGathered(program);
  images_.picture().bindTexture(kLevelTestPictureUnit);
  images_.behind().bindTexture(kLevelTestBehindUnit);
  thresholds.bindTexture(kLevelTestThresholdUnit);
}

void PerceptualPipeline::markVisible(int layer, const gl::Texture& thresholds, const gl::Texture& marks) {
  gl::ShaderDefines defines = images_.defines();
  defines["MARK"] = "1";
  const gl::Program& program = parent_.context().programs().compute(
      "renderer/techniques/perceptual_lod/count_visible.comp.glsl", defines);
  bindTests(program, thresholds);
  marks.bindImage(kLevelTestVisibleImage, gl::Access::Write);
  for (size_t i = 0; i < tests_.size(); ++i) {
    const auto object = static_cast<size_t>(tests_[i].object);
    if (layerOf_[object] != layer) continue;
    program.set("test", static_cast<int>(i));
    program.dispatch(pixels_[object].high - pixels_[object].low);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void PerceptualPipeline::runTests(int layer, const gl::Texture& thresholds) {
  const gl::PassList::Scope scope = parent_.passes().open(layerPrefix(layer) + kTests);
  bindTests(counts_.program(), thresholds);
  for (size_t i = 0; i < tests_.size(); ++i) {
    const auto object = static_cast<size_t>(tests_[i].object);
    if (layerOf_[object] == layer) counts_.count(tests_[i], static_cast<int>(i), pixels_[object]);
  }
}

void PerceptualPipeline::render(double timeS, bool wait) {
  takeResults(wait);
  mapsMade_ = 0;
  const scene::Scene& scene = parent_.scene();
  const frame::Frame& view = images_.moveTo(timeS);
  std::vector<double> distances;
  pixels_.clear();
  for (const scene::LodObject& object : scene.lodObjects) {
    distances.push_back(glm::length(object.bounds.centre() - view.camera().eye));
    pixels_.push_back(pixelsOf(object.bounds, view));
  }
  layerOf_ = assignLayers(settings_.layers, distances);
  for (int& layer : layerOf_) ++layer;
  tests_ = nextTests();
  images_.draw({control_.levels(), true}, layerOf_, tests_);

  // Where tests need a layer's map; the thesis's form computes all of all.
  std::vector<std::optional<perception::MapArea>> mapped(static_cast<size_t>(images_.layers()));
  std::vector<char> tested(mapped.size(), 0);
  for (const ObjectTest& test : tests_) {
    const auto object = static_cast<size_t>(test.object), layer = static_cast<size_t>(layerOf_[object]);
    const PixelRect& rect = pixels_[object];
    const perception::MapArea before = mapped[layer].value_or(perception::MapArea{rect.low, rect.high});
    mapped[layer] = perception::MapArea{glm::min(before.low, rect.low), glm::max(before.high, rect.high)};
    tested[layer] = 1;
  }
  if (settings_.tests.thresholdMaps == MappedLayers::All)
    for (const int layer : layerOf_)
      mapped[static_cast<size_t>(layer)] = perception::MapArea{glm::ivec2(0), parent_.sizePx()};
  if (!tests_.empty()) counts_.begin(frameNumber_);
  for (int layer = 1; layer < images_.layers(); ++layer) {
    if (!mapped[static_cast<size_t>(layer)]) continue;
    const gl::Texture& thresholds = makeMap(layer, true, mapped[static_cast<size_t>(layer)]);
    ++mapsMade_;
    if (tested[static_cast<size_t>(layer)]) runTests(layer, thresholds);
  }
  if (mapsMade_ == 0) images_.compose(0);
  if (!tests_.empty()) counts_.end();
  ++frameNumber_;
}

PerceptualPipeline::Surroundings PerceptualPipeline::surroundings(int layer) {
  const std::string number = std::to_string(layer);
  const auto kept = [&](const std::string& name) -> const gl::Texture& {
    return views_.try_emplace(name, gl::Format::R32F, parent_.sizePx()).first->second;
  };
  const gl::Texture &context = kept("context_" + number), &map = kept("threshold_map_" + number);
  const gl::Texture& thresholds = makeMap(layer, false);
  copyTexture(images_.context(), context);
  copyTexture(thresholds, map);
  return {&context, &map};
}

std::map<std::string, const gl::Texture*> PerceptualPipeline::debugViews() {
  std::map<std::string, const gl::Texture*> out = images_.views();
  const gl::Texture& marks =
      views_.try_emplace("visible_pixels", gl::Format::R32F, parent_.sizePx()).first->second;
  marks.clear(glm::vec4(0.0F));
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  out["visible_pixels"] = &marks;
  for (int layer = 1; layer < images_.layers(); ++layer) {
    // A layer without objects is not drawn.
    if (std::find(layerOf_.begin(), layerOf_.end(), layer) == layerOf_.end()) continue;
    const std::string number = std::to_string(layer);
    const Surroundings made = surroundings(layer);
    out["context_" + number] = made.context;
    out["threshold_map_" + number] = made.thresholds;
    markVisible(layer, *made.thresholds, marks);
  }
  return out;
}

}  // namespace limen::techniques
