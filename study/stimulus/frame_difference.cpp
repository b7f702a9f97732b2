// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/frame_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "perception/metrics/color_video_vdp.h"
#include "perception/metrics/metric.h"
#include "perception/metrics/metric_gpu.h"
#include "study/stimulus/stimulus_renderer.h"

namespace limen::study {
namespace {

using perception::MetricInfo;

const MetricInfo& metric(const std::string& name) { return perception::MetricRegistry::instance().get(name); }

/// Light of coded pictures, whose values are multiples of 1/255.
Image decoded(const Image& codes, const perception::DisplayProfile& display) {
  std::array<float, 256> light{};
  for (size_t code = 0; code < light.size(); ++code)
    light[code] = static_cast<float>(display.decode(static_cast<double>(code) / 255.0));
  Image out = codes;
  for (float& value : out.data) value = light[static_cast<size_t>(std::lround(255.0F * value))];
  return out;
}

double measure(const std::string& name, const Image& test, const Image& reference,
               const std::map<std::string, ParameterValue>& given = {},
               perception::MetricGpu* gpu = nullptr) {
  const MetricInfo& info = metric(name);
  perception::ComparisonInput input;
  input.test = &test;
  input.reference = &reference;
  input.gpu = gpu;
  return info.compare(input, ParameterValues(info.parameters, given)).value;
}

}  // namespace

nlohmann::json toJson(const FrameDifference& difference) {
  nlohmann::json out = {{"mean_de94", difference.meanDe94},
                        {"flip", difference.flip},
                        {"ssim", difference.ssim},
                        {"rmse", difference.rmse},
                        {"rmse_coded", difference.rmseCoded},
                        {"color_video_vdp", difference.colorVideoVdp}};
  if (difference.colorVideoVdpClip) out["color_video_vdp_clip"] = *difference.colorVideoVdpClip;
  return out;
}

FrameComparer::FrameComparer(gl::Context& context, glm::ivec2 windowPx,
                             const perception::DisplayProfile& display)
    : context_(context),
      windowPx_(windowPx),
      display_(display),
      gpu_(std::make_unique<perception::MetricGpu>(context)) {}

FrameComparer::~FrameComparer() = default;

double FrameComparer::flipPixelsPerDegree() const {
  const Parameter& parameter = metric("flip").parameters.get().front();
  return std::clamp(display_.pixelsPerDegree(), *parameter.minimum, *parameter.maximum);
}

nlohmann::json FrameComparer::settings(bool clip) {
  nlohmann::json out = {{"flip_pixels_per_degree", "display"}};
  for (const char* name : {"de94", "flip", "ssim", "rmse", "color_video_vdp"})
    out[std::string(name) + "_version"] = metric(name).version;
  if (clip) out["color_video_vdp_clip_s"] = kClipS;
  return out;
}

double FrameComparer::compareClip(StimulusRenderer& renderer) const {
  const Timeline& timeline = renderer.timeline();
  const int reach = framesFor(kClipS, timeline.refreshHz);
  const int first = std::max(timeline.changed - reach, 0);
  const int end = std::min(timeline.changed + reach, timeline.frames);
  // Pictures at rest and the frames before the change are asked for again and again.
  struct Held {
    double timeS = -1.0;
    Image light;
  };
  std::array<Held, 2> held;
  const auto shown = [&](int frame, bool after) {
    const double timeS = timeline.sceneTimeS(frame);
    Held& one = held[after ? 1 : 0];
    if (one.timeS != timeS || one.light.data.empty())
      one = {timeS, decoded(renderer.readBackState(timeS, after), display_)};
    return one.light;
  };
  const perception::LightPair pair = {windowPx_, end - first, timeline.refreshHz,
                                      [&](int i) { return shown(first + i, timeline.showsAfter(first + i)); },
                                      [&](int i) { return shown(first + i, false); }};
  return 10.0 - perception::colorVideoVdpJod(context_, pair, display_);
}

FrameDifference FrameComparer::compare(const Stimulus& stimulus, bool clip) {
  StimulusRenderer renderer(context_, stimulus, windowPx_, display_, &scenes_);
  const double timeS = renderer.timeline().changeSceneTimeS;
  const Image testCodes = renderer.readBackState(timeS, true),
              referenceCodes = renderer.readBackState(timeS, false);
  const Image test = decoded(testCodes, display_), reference = decoded(referenceCodes, display_);
  FrameDifference out;
  out.meanDe94 = measure("de94", test, reference, {{"statistic", std::string("mean")}});
  out.flip = measure("flip", test, reference, {{"pixels_per_degree", flipPixelsPerDegree()}}, gpu_.get());
  out.ssim = measure("ssim", test, reference);
  out.rmse = measure("rmse", test, reference);
  out.rmseCoded = measure("rmse", testCodes, referenceCodes);
  const perception::LightPair pair = {windowPx_, 1, 0.0, [&](int) { return test; },
                                      [&](int) { return reference; }};
  out.colorVideoVdp = 10.0 - perception::colorVideoVdpJod(context_, pair, display_);
  if (clip) out.colorVideoVdpClip = compareClip(renderer);
  return out;
}

}  // namespace limen::study
