// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/jnd_error.h"

#include <algorithm>

#include "renderer/frame/shaded.h"

namespace limen::techniques {
namespace {

constexpr const char* kMetric = "jnd";

ParameterValues settingsOf(const JndTarget& target, const perception::MetricInfo& metric) {
  return {metric.parameters, perception::ViewingSettings::table().write(target.viewing), kMetric};
}

perception::LitSurfaces surfacesOf(frame::Frame& frame) {
  frame::ShadedSetting albedo, direct;
  albedo.ambient = 1.0, albedo.diffuse = 0.0, albedo.background = -1.0;
  direct.ambient = 0.0, direct.diffuse = 1.0, direct.background = 0.0;
  frame.begin();
  const perception::LitSurfaces out{&frame.get<frame::Shaded>(albedo).texture(),
                                    &frame.get<frame::Shaded>(direct).texture()};
  frame.end();
  return out;
}

}  // namespace

JndErrors::JndErrors(frame::Frame& like, const JndTarget& target, const ReferencePair& truth,
                     perception::Depicts depicts)
    : frame_(like.context(), like.scene(), like.gpuScene(), like.sizePx(), like.timeS(), like.raster()),
      gpu_(like.context()),
      metric_(perception::MetricRegistry::instance().get(kMetric)),
      settings_(settingsOf(target, metric_)),
      depicts_(depicts),
      mask_(truth.first.width, truth.first.height, 1),
      mean_(truth.first) {
  if (depicts == perception::Depicts::ShareOfLight) surfaces_ = surfacesOf(frame_);
  const std::string wanted = limen::toText(target.figure);
  while (metric_.figures.at(figure_).name != wanted) ++figure_;
  for (size_t i = 0; i < mask_.pixels(); ++i) {
    mask_.data[i] = truth.mask.data[i] > 0.0F ? 1.0F : 0.0F;
  }
  for (size_t i = 0; i < mean_.data.size(); ++i)
    mean_.data[i] = 0.5F * (truth.first.data[i] + truth.second.data[i]);
  noise_ = between(truth.first, truth.second);
}

double JndErrors::between(const Image& test, const Image& reference) {
  perception::ComparisonInput input;
  input.test = &test;
  input.reference = &reference;
  input.mask = &mask_;
  input.gpu = &gpu_;
  input.depicts = depicts_;
  if (depicts_ == perception::Depicts::ShareOfLight) input.surfaces = &surfaces_;
  return metric_.compare(input, settings_).figures.at(figure_);
}

ErrorEstimate JndErrors::estimate(const Image& product) {
  const double jnd = between(product, mean_);
  // value() + noise() is the root of the mean square plus twice its sampling noise.
  const double upper = jnd + 0.5 * noise_;
  const double pixels = std::count(mask_.data.begin(), mask_.data.end(), 1.0F);
  return {.meanSquare = jnd * jnd,
          .samplingNoise = 0.5 * (upper * upper - jnd * jnd),
          .standardError = 0.0,
          .pixels = static_cast<int64_t>(pixels)};
}

}  // namespace limen::techniques
