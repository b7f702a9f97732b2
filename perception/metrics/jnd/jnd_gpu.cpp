// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/jnd/jnd_gpu.h"

#include <epoxy/gl.h>

#include <bit>
#include <cassert>
#include <memory>

#include "perception/metrics/jnd/jnd_bindings.h"
#include "perception/metrics/metric_gpu.h"

namespace limen::perception {
namespace {

using gl::Access;
using gl::Format;

const std::string kFolder = "perception/metrics/jnd/";
const gl::ShaderDefines kCarried = {{"CARRIED", "1"}};
/// Depths of one surface in two frames agree to a few digits; surfaces that hide each other differ by more
/// than this share.
constexpr float kDepthTolerance = 0.01F;

DisplayProfile displayOf(const JndSettings& settings, double refreshHz) {
  DisplayProfile display = settings.viewing.profile();
  if (refreshHz > 0.0) display.refreshHz = refreshHz;
  return display;
}

double ratingWithoutRegion(const PoppingSettings& settings) {
  return poppingRating(settings.regions.thresholdJnd, settings) - 1.0;
}

Image threeChannels(const Image& image) {
  Image out(image.width, image.height, 3);
  for (size_t pixel = 0; pixel < out.pixels(); ++pixel)
    for (size_t c = 0; c < 3; ++c) out.data[3 * pixel + c] = image.data[4 * pixel + c];
  return out;
}

}  // namespace

JndGpu::JndGpu(gl::Context& context, glm::ivec2 sizePx, const JndSettings& settings, double refreshHz)
    : context_(context),
      sizePx_(sizePx),
      settings_(settings),
      predictor_(context, sizePx, displayOf(settings, refreshHz), settings.predictor),
      actual_(Format::RGBA32F, sizePx),
      predicted_(Format::RGBA32F, sizePx),
      evaluated_(Format::R8, sizePx),
      mask_(Format::R32F, sizePx),
      statistics_(int64_t{sizeof(JndStatistics)} + int64_t{kJndBins} * int64_t{sizeof(uint32_t)}, nullptr) {
  for (const char* name : {"show", "count", "choose"})
    context_.programs().compute(kFolder + name + ".comp.glsl");
  context_.programs().compute(kFolder + "show.comp.glsl", kCarried);
}

const gl::Texture* JndGpu::upload(const Image* mask) {
  if (mask) mask_.write(*mask);
  return mask ? &mask_ : nullptr;
}

void JndGpu::run(const PathFrame& pair, Depicts depicts) {
  show(context_.programs().compute(kFolder + "show.comp.glsl"), pair, depicts);
  predict(nullptr);
}

void JndGpu::runStep(const PathFrame& before, const PathFrame& now, Depicts depicts) {
  const gl::Program& program = context_.programs().compute(kFolder + "show.comp.glsl", kCarried);
  before.test->bindTexture(kShowEarlierTestUnit);
  before.reference->bindTexture(kShowEarlierReferenceUnit);
  const bool moves = now.displacement != nullptr;
  (moves ? now.displacement : now.test)->bindTexture(kShowDisplacementUnit);
  (moves ? now.depthBefore : now.test)->bindTexture(kShowDepthBeforeUnit);
  (moves ? before.depth : now.test)->bindTexture(kShowEarlierDepthUnit);
  program.set("moves", moves ? 1 : 0);
  program.set("depthTolerance", kDepthTolerance);
  show(program, now, depicts);
  predict(now.displacement);
}

void JndGpu::show(const gl::Program& program, const PathFrame& frame, Depicts depicts) {
  assert(frame.test->sizePx() == sizePx_ && frame.reference->sizePx() == sizePx_);
  const bool isShare = depicts == Depicts::ShareOfLight;
  assert(!isShare || (frame.surfaces.albedo && frame.surfaces.direct));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  frame.test->bindTexture(kShowTestUnit);
  frame.reference->bindTexture(kShowReferenceUnit);
  (isShare ? frame.surfaces.albedo : frame.test)->bindTexture(kShowAlbedoUnit);
  (isShare ? frame.surfaces.direct : frame.test)->bindTexture(kShowDirectUnit);
  (frame.mask ? frame.mask : frame.test)->bindTexture(kShowMaskUnit);
  actual_.bindImage(kShowActualImage, Access::Write);
  predicted_.bindImage(kShowPredictedImage, Access::Write);
  evaluated_.bindImage(kShowEvaluatedImage, Access::Write);
  program.set("sizePx", sizePx_);
  program.set("grey", gl::channelCount(frame.test->format()) < 3 ? 1 : 0);
  program.set("isShare", isShare ? 1 : 0);
  program.set("exposure", static_cast<float>(settings_.shown.exposure));
  program.set("ambient", static_cast<float>(settings_.shown.ambient));
  program.set("diffuse", static_cast<float>(settings_.shown.diffuse));
  program.set("background", static_cast<float>(settings_.shown.background));
  // The mask is that of the region.
  const Region region = settings_.region.region;
  program.set("region", static_cast<int>(region == Region::Reflectors ? Region::Receivers : region));
  program.set("hasMask", frame.mask ? 1 : 0);
  program.dispatch(sizePx_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void JndGpu::predict(const gl::Texture* displacement) {
  PoppingGpuInput input;
  input.actual = &actual_;
  input.predicted = &predicted_;
  input.actualDisplacement = displacement;
  predictor_.run(input);
  statistics_.clearUint(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  const gl::Program& count = context_.programs().compute(kFolder + "count.comp.glsl");
  const gl::Program& choose = context_.programs().compute(kFolder + "choose.comp.glsl");
  const auto lowest = static_cast<float>(ratingWithoutRegion(settings_.predictor));
  for (int round = 0; round < 3; ++round) {
    predictor_.jnd().bindTexture(kCountJndUnit);
    evaluated_.bindTexture(kCountEvaluatedUnit);
    statistics_.bindStorage(kStatisticsBuffer);
    predictor_.regionTable().bindStorage(kJndRegionsBuffer);
    count.set("sizePx", sizePx_);
    count.set("round_", round);
    count.dispatch((sizePx_ + kCountTile - 1) / kCountTile, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    choose.set("round_", round);
    choose.set("ratingWithoutRegion", lowest);
    choose.dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

JndFigures JndGpu::figures() const {
  const JndStatistics found = statistics_.read<JndStatistics>(0, 1).front();
  JndFigures out;
  out.evaluatedPixels = found.evaluatedPx;
  out.medianJnd = std::bit_cast<float>(found.valueBits[0]);
  out.p95Jnd = std::bit_cast<float>(found.valueBits[1]);
  out.largestJnd = std::bit_cast<float>(found.largestBits);
  out.shareAbove1 = found.evaluatedPx > 0 ? static_cast<double>(found.visiblePx) / found.evaluatedPx : 0.0;
  const bool any = found.regionCount > 0;
  out.rating = any ? double{found.rating} : ratingWithoutRegion(settings_.predictor);
  out.detection =
      any ? settings_.predictor.detection.probability(out.rating) : settings_.predictor.detection.guessRate;
  return out;
}

Image JndGpu::readActual() const { return threeChannels(actual_.read()); }
Image JndGpu::readPredicted() const { return threeChannels(predicted_.read()); }

int64_t JndGpu::bytesHeld() const {
  return predictor_.bytesHeld() + actual_.bytes() + predicted_.bytes() + evaluated_.bytes() + mask_.bytes() +
         statistics_.bytes();
}

JndGpu& keptJndGpu(MetricGpu& gpu, const std::string& metric, const std::string& settingsKey,
                   glm::ivec2 sizePx, const JndSettings& settings, double refreshHz) {
  std::shared_ptr<void>& kept = gpu.kept(metric + " " + settingsKey);
  auto* jnd = static_cast<JndGpu*>(kept.get());
  if (jnd && jnd->sizePx() == sizePx) return *jnd;
  kept.reset();  // frees the memory before the next one allocates
  const auto made = std::make_shared<JndGpu>(gpu.context(), sizePx, settings, refreshHz);
  kept = made;
  return *made;
}

}  // namespace limen::perception
