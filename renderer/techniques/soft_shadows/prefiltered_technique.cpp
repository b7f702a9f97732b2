// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

#include "renderer/techniques/soft_shadows/common_counters.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines windowDefines(const AnyWindow& window, const frame::PrefilterSettings& prefilter) {
  gl::ShaderDefines defines = frame::PrefilteredMap::defines(prefilter);
  defines[std::holds_alternative<FixedWindow>(window)      ? "WINDOW_FIXED"
          : std::holds_alternative<SearchedWindow>(window) ? "WINDOW_SEARCHED"
                                                           : "WINDOW_CONVOLVED"] = "1";
  return defines;
}

void setWindow(const gl::Program& program, const FixedWindow& window) {
  program.set("filterRadius", static_cast<float>(window.radius));
}

void setWindow(const gl::Program& program, const SearchedWindow& window) {
  program.set("searchScale", static_cast<float>(window.scale));
  program.set("searchTaps", window.taps);
}

void setWindow(const gl::Program& program, const ConvolvedWindow& window) {
  program.set("searchScale", static_cast<float>(window.scale));
  program.set("searchThreshold", static_cast<float>(window.threshold));
}

}  // namespace

TechniqueInfo PrefilteredTechnique::info(std::string name, std::string summary) {
  std::vector<Quantity> counters = quantities();
  counters.push_back(structureBytes());
  return {.name = std::move(name),
          .version = 1,
          .summary = std::move(summary),
          .source = "Schwarz 2009, section 3.2.1 (SS-03)",
          .product = ProductKind::Visibility,
          .needs = {"area_light"},
          .counters = std::move(counters)};
}

PrefilteredTechnique::PrefilteredTechnique(const std::string& name, const PrefilteredSettings& common,
                                           const AnyWindow& window, const frame::PrefilterSettings& prefilter)
    : VisibilityTechnique(common.map, common.bias,
                          "renderer/techniques/soft_shadows/" + name + "/" + name + ".comp.glsl",
                          "soft_shadows/" + name, windowDefines(window, prefilter)),
      prefilter_(prefilter),
      window_(window) {}

const frame::LightFrustum& PrefilteredTechnique::bindMap(frame::Frame& frame) {
  map_ = &frame.get<frame::PrefilteredMap>(prefilter_);
  const auto& map = frame.get<frame::ShadowMap>(mapSettings());
  map.texture().bindTexture(kShadowMapUnit);
  map_->bind(kAveragesUnit);
  return map.frustum();
}

void PrefilteredTechnique::configure(const gl::Program& program) const {
  map_->configure(program);
  std::visit([&](const auto& window) { setWindow(program, window); }, window_);
}

std::vector<Counter> PrefilteredTechnique::count(frame::Frame& frame) {
  std::vector<Counter> all = VisibilityTechnique::count(frame);
  all.push_back({structureBytes().name, static_cast<double>(map_->bytes())});
  return all;
}

}  // namespace limen::techniques
