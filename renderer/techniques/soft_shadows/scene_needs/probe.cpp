// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/probe.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "renderer/frame/g_buffer.h"

namespace limen::techniques {
namespace {

constexpr uint32_t kCoarseLevel = 2;

glm::ivec2 reduced(glm::ivec2 sizePx, int divisor) { return glm::max(sizePx / divisor, glm::ivec2(1)); }

template <class Difference>
double meanOverShadow(const Probed& a, const Probed& b, Difference difference) {
  double sum = 0.0, pixels = 0.0;
  for (size_t i = 0; i < a.visibility.size(); ++i) {
    const uint32_t kind = a.counted.work[4 * i];
    if (kind != Processed && kind != Umbra) continue;
    sum += difference(double(a.visibility[i]), double(b.visibility[i]));
    pixels += 1.0;
  }
  return pixels > 0.0 ? sum / pixels : 0.0;
}

ParameterValues valuesOf(const ShadowSetting& setting) {
  const std::vector<Parameter>& declared = TechniqueRegistry::instance().get(techniqueOf(setting)).parameters;
  return std::visit(
      [&]<class S>(const S& chosen) { return ParameterValues(declared, S::table().write(chosen)); }, setting);
}

}  // namespace

std::string techniqueOf(const ShadowSetting& setting) {
  if (std::holds_alternative<MapSettings>(setting)) return "soft_shadows/hard";
  return std::holds_alternative<BitmaskSettings>(setting) ? "soft_shadows/bitmask"
                                                          : "soft_shadows/backprojection";
}

std::unique_ptr<Technique> makeTechnique(const ShadowSetting& setting) {
  return TechniqueRegistry::instance().get(techniqueOf(setting)).make(valuesOf(setting));
}

std::string describe(const ShadowSetting& setting) {
  const std::string technique = techniqueOf(setting);
  const ParameterValues defaults(TechniqueRegistry::instance().get(technique).parameters, {});
  const ParameterValues values = valuesOf(setting);
  std::string text = technique;
  for (const auto& [name, value] : values.all()) {
    const ParameterValue* usual = defaults.find(name);
    if (!usual || *usual != value) text += ", " + name + "=" + limen::toText(value);
  }
  return text;
}

ShadowProbe::ShadowProbe(frame::Frame& frame, int divisor)
    : frame_(frame.context(), frame.scene(), frame.gpuScene(), reduced(frame.sizePx(), divisor),
             frame.timeS(), frame.raster()) {}

Probed ShadowProbe::run(const ShadowSetting& setting) {
  const std::unique_ptr<Technique> technique = makeTechnique(setting);
  technique->prepare(frame_);
  technique->count(frame_);
  frame_.begin();
  technique->render(frame_);
  frame_.end();
  Probed out;
  out.visibility = technique->product().read().data;
  out.counted = dynamic_cast<const CountsPixels&>(*technique).counted();
  const glm::ivec2 size = out.counted.sizePx;
  const auto kindAt = [&](size_t i) { return out.counted.work[4 * i]; };
  const auto levelAt = [&](size_t i) { return out.counted.work[4 * i + 3]; };
  double coarse = 0.0, pairs = 0.0, changes = 0.0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const size_t i = size_t(y) * size_t(size.x) + size_t(x);
      if (kindAt(i) != Processed) continue;
      out.processed += 1.0;
      out.examined += out.counted.search[4 * i + 1];
      coarse += levelAt(i) >= kCoarseLevel ? 1.0 : 0.0;
      for (const size_t next : {x + 1 < size.x ? i + 1 : i, y + 1 < size.y ? i + size_t(size.x) : i}) {
        if (next == i || kindAt(next) != Processed) continue;
        pairs += 1.0;
        changes += levelAt(next) != levelAt(i) ? 1.0 : 0.0;
      }
    }
  out.coarseShare = out.processed > 0.0 ? coarse / out.processed : 0.0;
  out.levelChangeShare = pairs > 0.0 ? changes / pairs : 0.0;
  return out;
}

double ShadowProbe::penumbraTexels(const frame::ShadowMapSettings& map) {
  frame_.begin();
  const auto& pyramid = frame_.get<frame::MinMaxPyramid>(map);
  const frame::LightFrustum frustum = pyramid.frustum();
  const Image nearest = pyramid.minimum().read(pyramid.levels() - 1);
  const Image receivers = frame_.get<frame::Receivers>().texture().read();
  frame_.end();
  double farthest = 0.0;
  for (size_t i = 0; i < receivers.pixels(); ++i)
    if (receivers.data[4 * i + 3] >= 0.0F) farthest = std::max(farthest, double(receivers.data[4 * i + 2]));
  const double caster = std::max(double(nearest.data.at(0)), frustum.near);
  if (farthest <= caster) return 0.0;
  const glm::dvec2 texels = frame_.scene().lights.at(0).size * (1.0 / caster - 1.0 / farthest) /
                            (frustum.high - frustum.low) * double(map.resolution);
  return std::max(texels.x, texels.y);
}

double meanDifference(const Probed& a, const Probed& b) {
  return meanOverShadow(a, b, [](double v, double w) { return std::abs(v - w); });
}

double meanLightGained(const Probed& a, const Probed& b) {
  return meanOverShadow(a, b, [](double v, double w) { return std::max(w - v, 0.0); });
}

}  // namespace limen::techniques
