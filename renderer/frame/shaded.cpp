// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/shaded.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/text.h"
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/frame/surface_point.h"

namespace limen::frame {

gl::ShaderDefines shadingDefines(const ShadedSetting& setting, const Frame& frame) {
  const bool lit = !frame.scene().lights.empty();
  gl::ShaderDefines defines = surfaceDefines(frame, setting.smoothNormals);
  if (lit) defines["LIT"] = "1";
  if (lit && setting.shadow) defines["SHADOW"] = "1";
  if (setting.pattern) defines["PATTERN"] = "1";
  if (std::holds_alternative<PhongHighlight>(setting.highlight)) defines["HIGHLIGHT_PHONG"] = "1";
  if (std::holds_alternative<CookTorranceHighlight>(setting.highlight))
    defines["HIGHLIGHT_COOK_TORRANCE"] = "1";
  return defines;
}

std::string ShadedSetting::key() const {
  std::string out;
  for (const double value :
       {ambient, diffuse, specular, shininess, background, double(shadowResolution), eyeDtS})
    out += shortestNumber(value) + "/";
  for (const bool flag : {smoothNormals, pattern, shadow}) out += flag ? '1' : '0';
  if (std::holds_alternative<PhongHighlight>(highlight)) out += "/phong";
  if (const auto* facets = std::get_if<CookTorranceHighlight>(&highlight))
    out += "/facets/" + shortestNumber(facets->roughness) + '/' + shortestNumber(facets->reflectance);
  return out;
}

const SettingsTable<BlinnHighlight>& BlinnHighlight::table() {
  static const SettingsTable<BlinnHighlight> kTable = {};
  return kTable;
}

const SettingsTable<PhongHighlight>& PhongHighlight::table() {
  static const SettingsTable<PhongHighlight> kTable = {};
  return kTable;
}

const SettingsTable<CookTorranceHighlight>& CookTorranceHighlight::table() {
  using S = CookTorranceHighlight;
  static const SettingsTable<S> kTable = {{&S::roughness,
                                           "roughness",
                                           {0.02, 1.0},
                                           "",
                                           "Root mean square slope of the microfacets (Beckmann)",
                                           "Roger 2008, equation 1.11"},
                                          {&S::reflectance,
                                           "reflectance",
                                           {0.0, 1.0},
                                           "",
                                           "At normal incidence (Schlick)",
                                           "Roger 2008, section 1.2.3"}};
  return kTable;
}

const SettingsTable<ShadedSetting>& ShadedSetting::table() {
  using S = ShadedSetting;
  static const SettingsTable<S> kTable = {
      Binding(&S::ambient, "ambient", Range{0.0, 1.0}, "", "Ambient share of the albedo")
          .formerly({"ambient"}),
      Binding(&S::diffuse, "diffuse", Range{0.0, 1.0}, "",
              "Share of the albedo times the cosine towards the light")
          .formerly({"diffuse"}),
      Binding(&S::specular, "specular", Range{0.0, 4.0}, "", "Strength of the highlight")
          .formerly({"specular"}),
      Binding(&S::shininess, "shininess", Range{1.0, 4096.0}, "", "Exponent of the highlight")
          .formerly({"shininess"}),
      {&S::highlight, "highlight", "Form of the highlight"},
      Binding(&S::background, "background", Range{0.0, 1.0}, "", "Linear grey of the background",
              "Schwarz 2009, section 10.4.1 (dark grey; value not given there)")
          .formerly({"background"}),
      Binding(&S::smoothNormals, "smooth_normals", "Use vertex or patch normals if a mesh has any",
              "Schwarz 2009, section 10.4.1")
          .formerly({"smooth_normals"}),
      Binding(&S::pattern, "pattern", "Apply the solid textures of the scene's materials")
          .formerly({"pattern"}),
      Binding(&S::shadow, "shadow", "Add a hard shadow of the first light").formerly({"shadow"})};
  return kTable;
}

Shaded::Shaded(Frame& frame, ShadedSetting setting)
    : setting_(std::move(setting)),
      lit_(!frame.scene().lights.empty()),
      program_(frame.context().programs().compute("renderer/frame/shaded.comp.glsl",
                                                  shadingDefines(setting_, frame))),
      texture_(gl::Format::RGBA32F, frame.sizePx()) {
  frame.passes().setBytesHeld("frame/shaded", texture_.bytes());
}

void configureShading(const gl::Program& program, const Frame& frame, const ShadedSetting& setting) {
  program.set("background", glm::vec3(static_cast<float>(setting.background)));
  program.set("ambient", static_cast<float>(setting.ambient));
  program.set("diffuse", static_cast<float>(setting.diffuse));
  program.set("specular", static_cast<float>(setting.specular));
  program.set("shininess", static_cast<float>(setting.shininess));
  if (const auto* facets = std::get_if<CookTorranceHighlight>(&setting.highlight)) {
    program.set("roughness", static_cast<float>(facets->roughness));
    program.set("normalReflectance", static_cast<float>(facets->reflectance));
  }
  const scene::Camera& seenBy =
      setting.eyeDtS == 0.0 ? frame.camera() : frame.scene().camera.at(frame.timeS() - setting.eyeDtS);
  configureSurfacePoints(program, frame, seenBy);
  if (!frame.scene().lights.empty()) {
    // Seen from the scene's centre: apertures are for a distant light.
    const scene::AreaLight& light = frame.scene().lights[0];
    const double distance = glm::length(light.centre - frame.gpuScene().anchor());
    program.set("sunRadius",
                static_cast<float>(std::atan2(0.5 * std::max(light.size.x, light.size.y), distance)));
    program.set("lightPosition", glm::vec3(light.centre - frame.gpuScene().anchor()));
  }
}

void configureHardShadow(const gl::Program& program, const ShadowMap& map, int resolution) {
  const LightFrustum& frustum = map.frustum();
  program.set("tangentLow", glm::vec2(frustum.low));
  program.set("tangentSize", glm::vec2(frustum.high - frustum.low));
  program.set("resolution", resolution);
  program.set("bias", kShadowBias);
  program.set("slopeBias", kShadowSlopeBias);
  program.set("maxSlope", kShadowMaxSlope);
  map.texture().bindTexture(kShadedShadowMapUnit);
}

void Shaded::make(Frame& frame) {
  const gl::Texture& ids = frame.get<TriangleIds>().texture();
  const gl::Texture* receivers = nullptr;
  const ShadowMap* map = nullptr;
  if (lit_ && setting_.shadow) {
    receivers = &frame.get<Receivers>().texture();
    map = &frame.casters().get<ShadowMap>(ShadowMapSettings{setting_.shadowResolution, Raster::Auto});
  }
  const auto scope = frame.passes().open("frame/shaded");
  configureShading(program_, frame, setting_);
  if (map) {
    configureHardShadow(program_, *map, setting_.shadowResolution);
    receivers->bindTexture(kShadedReceiversUnit);
  }
  ids.bindTexture(kShadedIdsUnit);
  texture_.bindImage(kShadedOutImage, gl::Access::Write);
  program_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::frame
