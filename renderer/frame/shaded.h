// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

class ShadowMap;

/// Biases of the hard shadow, as in soft_shadows/hard: shares of the depth, texels of slope, and the
/// largest slope over depth.
inline constexpr float kShadowBias = 1e-4F, kShadowSlopeBias = 1.0F, kShadowMaxSlope = 10.0F;

/// Forms of the highlight (Roger 2008, section 1.2.3), each times the cosine of the light that its
/// reflectance holds in the denominator.
struct BlinnHighlight {
  static constexpr const char *kKind = "blinn",
                              *kSummary =
                                  "power of the cosine between the normal and the middle of light and view";
  static const SettingsTable<BlinnHighlight>& table();
};
struct PhongHighlight {
  static constexpr const char *kKind = "phong",
                              *kSummary = "power of the cosine between the light and the mirrored view";
  static const SettingsTable<PhongHighlight>& table();
};
struct CookTorranceHighlight {
  static constexpr const char *kKind = "cook_torrance",
                              *kSummary = "microfacets; `shininess` has no part in it";
  double roughness = 0.2, reflectance = 0.04;
  static const SettingsTable<CookTorranceHighlight>& table();
};

/// How Shaded lights a scene. The light is the scene's first; a scene without one has ambient light only.
struct ShadedSetting {
  double ambient = 0.2;   ///< ambient share of the albedo
  double diffuse = 0.8;   ///< share times the cosine towards the light's centre; no fall-off with distance
  double specular = 0.0;  ///< strength of the highlight, added
  double shininess = 32.0;
  std::variant<BlinnHighlight, PhongHighlight, CookTorranceHighlight> highlight;
  double background = 0.05;     ///< linear grey; 0.05 is the dark grey 63 of 255 of sRGB
  bool smoothNormals = true;    ///< vertex or patch normals where the mesh has them
  bool pattern = true;          ///< solid textures of the materials
  bool shadow = false;          ///< hard shadow by a map of frame.casters() from the light's centre
  int shadowResolution = 1024;  ///< texels per side, a power of two
  double eyeDtS = 0.0;          ///< highlights as seen by the camera this long ago
  std::string key() const;

  /// Covers all members except shadowResolution and eyeDtS, which the caller sets.
  static const SettingsTable<ShadedSetting>& table();
};

/// The line `shading` of settings tables that include these settings.
template <class S>
Binding<S> shadingBinding(ShadedSetting S::*member) {
  return {member, "shading", "How the picture is lit"};
}

/// The picture of a frame: RGBA32F, row 0 at the top, linear display-referred radiance (0..1 for albedos and
/// lighting shares that sum to 1; highlights may exceed 1), alpha 1. Background pixels hold the constant from
/// the settings. Normals are turned to the camera. Terrain is lit through its apertures (Schwarz
/// 2009, 10.3.5).
class Shaded : public FrameInput {
 public:
  static constexpr const char* kName = "shaded";
  Shaded(Frame& frame, ShadedSetting setting);
  void make(Frame& frame) override;
  const gl::Texture& texture() const { return texture_; }

 private:
  ShadedSetting setting_;
  bool lit_;
  const gl::Program& program_;
  gl::Texture texture_;
};

/// For passes that shade pixels with shading.glsl and find the light's share of each in their own way: its
/// defines, and its uniforms and storage.
gl::ShaderDefines shadingDefines(const ShadedSetting& setting, const Frame& frame);
void configureShading(const gl::Program& program, const Frame& frame, const ShadedSetting& setting);
/// Uniforms of hard_shadow.glsl, and the map, of `resolution` texels a side, from frame.casters().
void configureHardShadow(const gl::Program& program, const ShadowMap& map, int resolution);

}  // namespace limen::frame
