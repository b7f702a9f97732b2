// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/layer_images.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "renderer/frame/shaded.h"

namespace limen::techniques {
namespace {

constexpr const char* kFolder = "renderer/techniques/perceptual_lod/";
constexpr const char* kCompose = "perceptual_lod/compose";
/// Tests have at least this much room in a frame; further ones wait for the next.
constexpr int64_t kTestWords = int64_t{1} << 25;

/// Offsets in the uploaded plan; 256 bytes are the coarsest alignment that GL allows drivers to ask for.
constexpr int64_t aligned(int64_t bytes) { return (bytes + 255) / 256 * 256; }
constexpr int64_t kTableBytes = int64_t{frame::kMostRasterRegions} * int64_t{sizeof(frame::RasterRegion)};
constexpr int64_t kTestBytes = int64_t{kMostTests} * int64_t{sizeof(PlannedTest)};
constexpr int64_t kTestsOffset = aligned(kTableBytes), kRangesOffset = aligned(kTestsOffset + kTestBytes);
constexpr int kClearGroups = 2048;
constexpr int64_t kMostRangesOfTests = 3 * kMostTests;

double attenuationOf(const PerceptualLodSettings& settings) {
  const auto* darkened = std::get_if<DarkenedShadows>(&settings.castShadows);
  return darkened ? darkened->factor : 1.0;
}

int64_t area(glm::ivec2 size) { return int64_t{size.x} * size.y; }
int64_t area(const PixelRect& rect) { return rect.empty() ? 0 : area(rect.high - rect.low); }

PixelRect unionOf(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

}  // namespace

LayerImages::LayerImages(frame::Frame& parent, const PerceptualLodSettings& settings, const SeenOn& seenOn)
    : parent_(parent),
      shading_(settings.shading),
      attenuation_(attenuationOf(settings)),
      blackCdM2_(static_cast<float>(seenOn.display.blackLevelCdM2())),
      rangeCdM2_(static_cast<float>(seenOn.display.whiteLevelCdM2() - seenOn.display.blackLevelCdM2())),
      layers_(1 + layerCount(settings.layers)),
      view_(parent, "view", parent.sizePx()),
      picture_(gl::Format::RGBA32F, parent.sizePx()),
      behind_(gl::Format::R32F, parent.sizePx()),
      context_(gl::Format::R32F, parent.sizePx()),
      shown_(nothingOf(parent.scene())),
      table_(frame::kMostRasterRegions),
      tests_(kMostTests),
      drawn_(static_cast<size_t>(layers_), 0) {
  const scene::Scene& scene = parent.scene();
  const int tests = settings.tests.objectsPerFrame;
  camera_ = std::make_unique<frame::RegionRaster>(parent, "perceptual_lod/raster");
  int64_t layerWords = 2 * layers_ * area(parent.sizePx());
  int64_t oneTest = 4 * area(parent.sizePx());
  if (shading_.shadow && !scene.lights.empty()) {
    const int resolution = shading_.shadowResolution;
    light_ = frame::LightCasters(scene).fit(glm::dvec2(0.0), resolution);
    shadows_ =
        std::make_unique<frame::RegionRaster>(parent, "perceptual_lod/shadow_raster", &*light_, resolution);
    layerWords += layers_ * area(glm::ivec2(resolution));
    oneTest += 3 * area(glm::ivec2(resolution));
    for (const scene::LodObject& object : scene.lodObjects)
      lightPixels_.push_back(lightPixelsOf(object.bounds));
  }
  testWords_ = std::max(oneTest, std::min(oneTest * tests, kTestWords));
  gathered_.emplace(aligned(4 * (layerWords + testWords_)), nullptr);
  const auto ranges = static_cast<int64_t>(scene.parts.size()) + kMostRangesOfTests;
  plan_.emplace(kRangesOffset + 2 * aligned(ranges * int64_t{sizeof(glm::uvec4)}), nullptr);
  clear_ = &parent.context().programs().compute(std::string(kFolder) + "clear.comp.glsl");
  compose_ = &parent.context().programs().compute(std::string(kFolder) + "compose.comp.glsl", defines());
  for (const gl::Texture* texture : {&picture_, &behind_, &context_}) texture->clear(glm::vec4(0.0F));
  parent.passes().setBytesHeld("perceptual_lod/raster",
                               gathered_->bytes() + camera_->bytes() + (shadows_ ? shadows_->bytes() : 0));
  parent.passes().setBytesHeld(kCompose, picture_.bytes() + behind_.bytes() + context_.bytes());
}

LayerImages::~LayerImages() = default;

gl::ShaderDefines LayerImages::defines() const { return frame::shadingDefines(shading_, parent_); }

PixelRect LayerImages::lightPixelsOf(const scene::Bounds& bounds) const {
  const glm::ivec2 size(shading_.shadowResolution);
  if (bounds.empty()) return {};
  const glm::dmat4 toLight = parent_.scene().lights[0].toLightSpace();
  glm::dvec2 low(1e300), high(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 world(corner & 1 ? bounds.high.x : bounds.low.x,
                           corner & 2 ? bounds.high.y : bounds.low.y,
                           corner & 4 ? bounds.high.z : bounds.low.z);
    const glm::dvec3 p(toLight * glm::dvec4(world, 1.0));
    if (p.z < light_->near) return {glm::ivec2(0), size};
    const glm::dvec2 at =
        (glm::dvec2(p) / p.z - light_->low) / (light_->high - light_->low) * glm::dvec2(size);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  // One more texel on each side for the raster's rounding.
  const glm::dvec2 limit(size);
  return {glm::ivec2(glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0.0), limit)),
          glm::ivec2(glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0.0), limit))};
}

const frame::Frame& LayerImages::moveTo(double timeS) {
  view_.setTime(timeS);
  view_.begin();
  return view_;
}

int64_t LayerImages::wordsOf(const ObjectTest& test) const {
  const auto object = static_cast<size_t>(test.object);
  const int versions = int{test.finest} + int{test.next};
  int64_t out = 2 * versions * area(pixelsOf(parent_.scene().lodObjects[object].bounds, view_));
  if (shadows_) out += (1 + versions) * area(lightPixels_[object]);
  return out;
}

size_t LayerImages::fitting(const std::vector<ObjectTest>& tests) const {
  int64_t words = 0;
  size_t count = 0;
  for (; count < std::min(tests.size(), size_t{kMostTests}); ++count) {
    words += wordsOf(tests[count]);
    if (count > 0 && words > testWords_) break;
  }
  return count;
}

void LayerImages::plan(const std::vector<int>& layerOf, const std::vector<ObjectTest>& tests) {
  const scene::Scene& scene = parent_.scene();
  const auto versionRegions = [&](int per) { return static_cast<size_t>(kLayerSlots + per * kMostTests); };
  cameraRegions_.assign(versionRegions(2), {nothingOf(scene), glm::ivec2(0), glm::ivec2(0)});
  lightRegions_.assign(shadows_ ? versionRegions(3) : 0, cameraRegions_[0]);
  std::vector<char> tested(scene.lodObjects.size(), 0);
  for (const ObjectTest& test : tests) tested[static_cast<size_t>(test.object)] = 1;
  const auto extend = [](frame::RegionContent& region, size_t object, int level, const PixelRect& rect) {
    region.selection.levels[object] = level;
    const PixelRect both = unionOf({region.low, region.high}, rect);
    region.low = both.low;
    region.high = both.high;
  };

  drawn_.assign(static_cast<size_t>(layers_), 0);
  drawn_[0] = 1;
  for (auto* regions : {&cameraRegions_, &lightRegions_}) {
    if (regions->empty()) continue;
    regions->front().selection.background = shown_.background;
    regions->front().high = regions == &cameraRegions_ ? view_.sizePx() : shadows_->sizePx();
  }
  std::vector<PixelRect> pixels;
  for (size_t i = 0; i < layerOf.size(); ++i) {
    pixels.push_back(pixelsOf(scene.lodObjects[i].bounds, view_));
    const auto layer = static_cast<size_t>(layerOf[i]);
    drawn_[layer] = 1;
    // What the camera does not see may cast a shadow that it does.
    if (!pixels[i].empty()) extend(cameraRegions_[layer], i, shown_.levels[i], pixels[i]);
    if (shadows_ && !tested[i]) extend(lightRegions_[layer], i, shown_.levels[i], lightPixels_[i]);
  }
  layersDrawn_ = static_cast<int>(std::count(drawn_.begin(), drawn_.end(), 1));

  trianglesTested_ = 0;
  testCount_ = static_cast<int>(tests.size());
  for (size_t i = 0; i < tests.size(); ++i) {
    const ObjectTest& test = tests[i];
    const auto object = static_cast<size_t>(test.object);
    const scene::TriangleRange range = scene.triangles(scene.lodObjects[object], test.level);
    const auto add = [&](std::vector<frame::RegionContent>& regions, int at, int level,
                         const PixelRect& rect) {
      extend(regions[static_cast<size_t>(at)], object, level, rect);
      return at;
    };
    const int camera = kLayerSlots + 2 * static_cast<int>(i), light = kLayerSlots + 3 * static_cast<int>(i);
    PlannedTest out{layerOf[object],    -1, -1, -1, -1, -1, range.first, range.count, pixels[object].low,
                    pixels[object].high};
    if (test.finest) out.cameraFinest = kFirstCameraRegion + add(cameraRegions_, camera, 0, pixels[object]);
    if (test.next)
      out.cameraNext = kFirstCameraRegion + add(cameraRegions_, camera + 1, test.level + 1, pixels[object]);
    if (shadows_) {
      const PixelRect& rect = lightPixels_[object];
      out.lightCurrent = out.lightFinest = add(lightRegions_, light, test.level, rect);
      if (test.finest) out.lightFinest = add(lightRegions_, light + 1, 0, rect);
      if (test.next) out.lightNext = add(lightRegions_, light + 2, test.level + 1, rect);
    }
    tests_[i] = out;
    if (test.finest) trianglesTested_ += scene.triangles(scene.lodObjects[object], 0).count;
    if (test.next) trianglesTested_ += scene.triangles(scene.lodObjects[object], test.level + 1).count;
  }
}

void LayerImages::draw(const scene::LodSelection& shown, const std::vector<int>& layerOf,
                       const std::vector<ObjectTest>& tests) {
  shown_ = shown;
  plan(layerOf, tests);
  int64_t words = 0;
  const auto place = [&](const std::vector<frame::RegionContent>& regions, int first, int wordsOfPixel) {
    for (size_t i = 0; i < regions.size(); ++i) {
      table_[static_cast<size_t>(first) + i] = {
          regions[i].low, regions[i].high, static_cast<int>(words), 0, 0, 0};
      words += wordsOfPixel * regions[i].pixels();
    }
  };
  if (shadows_) place(lightRegions_, 0, shadows_->wordsOfPixel());
  place(cameraRegions_, kFirstCameraRegion, camera_->wordsOfPixel());
  upload();
  {
    const auto scope = parent_.passes().open("perceptual_lod/clear");
    // The frame before has read what this empties.
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    clear_->set("quads", static_cast<uint32_t>((words + 3) / 4));
    gathered_->bindStorage(kGatheredBuffer);
    clear_->dispatch({kClearGroups, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  const auto rangesAt = [&](const std::vector<glm::uvec4>& ranges, int64_t offset) {
    return frame::RegionRaster::Ranges{*plan_, offset, static_cast<int64_t>(ranges.size()),
                                       ranges.empty() ? 0 : ranges.back().y};
  };
  const int64_t second =
      kRangesOffset + aligned(static_cast<int64_t>(lightRanges_.size() * sizeof(glm::uvec4)));
  bindTables();
  if (shadows_)
    shadows_->draw(view_, lightRegions_, table_, 0, rangesAt(lightRanges_, kRangesOffset), *gathered_);
  bindTables();
  camera_->draw(view_, cameraRegions_, table_, kFirstCameraRegion, rangesAt(cameraRanges_, second),
                *gathered_);
}

void LayerImages::upload() {
  lightRanges_ = shadows_ ? shadows_->rangesOf(lightRegions_, 0) : std::vector<glm::uvec4>();
  cameraRanges_ = camera_->rangesOf(cameraRegions_, kFirstCameraRegion);
  const size_t lightBytes = lightRanges_.size() * sizeof(glm::uvec4),
               cameraBytes = cameraRanges_.size() * sizeof(glm::uvec4);
  const auto second = static_cast<size_t>(kRangesOffset + aligned(static_cast<int64_t>(lightBytes)));
  std::vector<char> bytes(second + cameraBytes);
  std::memcpy(bytes.data(), table_.data(), static_cast<size_t>(kTableBytes));
  std::memcpy(bytes.data() + kTestsOffset, tests_.data(), static_cast<size_t>(kTestBytes));
  if (lightBytes > 0) std::memcpy(bytes.data() + kRangesOffset, lightRanges_.data(), lightBytes);
  if (cameraBytes > 0) std::memcpy(bytes.data() + second, cameraRanges_.data(), cameraBytes);
  assert(static_cast<int64_t>(bytes.size()) <= plan_->bytes());
  plan_->write(0, static_cast<int64_t>(bytes.size()), bytes.data());
}

void LayerImages::bindTables() const {
  glBindBufferRange(GL_UNIFORM_BUFFER, frame::kRasterRegionsBlock, plan_->id(), 0, kTableBytes);
  glBindBufferRange(GL_UNIFORM_BUFFER, kPlannedTestsBlock, plan_->id(), kTestsOffset, kTestBytes);
}

void LayerImages::bindGathered(const gl::Program& program) {
  frame::configureShading(program, view_, shading_);
  if (light_) {
    program.set("tangentLow", glm::vec2(light_->low));
    program.set("tangentSize", glm::vec2(light_->high - light_->low));
    program.set("resolution", shading_.shadowResolution);
    program.set("bias", frame::kShadowBias);
    program.set("slopeBias", frame::kShadowSlopeBias);
    program.set("maxSlope", frame::kShadowMaxSlope);
    const glm::dmat4 toLight = parent_.scene().lights[0].toLightSpace(parent_.gpuScene().anchor());
    program.set("cameraToLight", glm::mat4(toLight * glm::inverse(view_.anchorToCamera())));
    program.set("lightNear", static_cast<float>(light_->near));
  }
  program.set("layerCount", layers_);
  program.set("testCount", testCount_);
  program.set("blackCdM2", blackCdM2_);
  program.set("rangeCdM2", rangeCdM2_);
  bindTables();
  gathered_->bindStorage(kGatheredBuffer);
}

void LayerImages::compose(int mappedLayer) {
  const std::string layer = mappedLayer > 0 ? "layer_" + std::to_string(mappedLayer) + "/" : "";
  const auto scope = parent_.passes().open(layer + kCompose);
  bindGathered(*compose_);
  compose_->set("mappedLayer", mappedLayer > 0 ? mappedLayer : -1);
  compose_->set("attenuation", light_ ? static_cast<float>(attenuation_) : 1.0F);
  picture_.bindImage(kComposePictureImage, gl::Access::Write);
  behind_.bindImage(kComposeBehindImage, gl::Access::Write);
  context_.bindImage(kComposeContextImage, gl::Access::Write);
  compose_->dispatch(parent_.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

std::map<std::string, const gl::Texture*> LayerImages::views() {
  if (!layerView_)
    layerView_ =
        &parent_.context().programs().compute(std::string(kFolder) + "layer_view.comp.glsl", defines());
  std::map<std::string, const gl::Texture*> out;
  const auto texture = [&](const std::string& name, gl::Format format) -> const gl::Texture& {
    return views_.try_emplace(name, format, parent_.sizePx()).first->second;
  };
  for (int layer = 0; layer < layers_; ++layer) {
    if (!drawn_[static_cast<size_t>(layer)]) continue;
    const std::string number = std::to_string(layer), name = layer == 0 ? "background" : "layer_" + number;
    const gl::Texture& image = texture(name, gl::Format::RGBA32F);
    const gl::Texture& mask = texture("shadow_mask_" + number, gl::Format::R32F);
    bindGathered(*layerView_);
    layerView_->set("shownLayer", layer);
    image.bindImage(kLayerViewImage, gl::Access::Write);
    mask.bindImage(kLayerViewMaskImage, gl::Access::Write);
    layerView_->dispatch(parent_.sizePx());
    out[name] = &image;
    if (layer > 0 && light_ && attenuation_ < 1.0) out["shadow_mask_" + number] = &mask;
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  return out;
}

}  // namespace limen::techniques
