// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/prefiltered_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

/// The resolution of a float, from which values are rounded.
constexpr int kValueBits = 24;

constexpr const char* kPrefilterPass = "frame/prefiltered_map";

int layersOf(const PrefilterSettings& settings) {
  if (settings.basis != DepthBasis::Fourier) return 1;
  return settings.withDepths ? 2 * settings.terms + 1 : settings.terms;
}

int channelsOf(const PrefilterSettings& settings) {
  return settings.basis == DepthBasis::Exponential ? 1 : 2;
}

LayerAverages::Form arrayOf(const PrefilterSettings& settings) {
  const int channels = channelsOf(settings);
  return {settings.prefilter,
          settings.map.resolution,
          layersOf(settings),
          channels,
          settings.form,
          channels == 1 ? gl::Format::R32F : gl::Format::RG32F,
          SummedAreaTable::texelLayout(channels, SumForm::Float)};
}

SumForm formOf(const PrefilterSettings& settings) {
  return settings.prefilter == Prefilter::Sums ? settings.form : SumForm::Float;
}

gl::ShaderDefines fillDefines(const PrefilterSettings& settings) {
  gl::ShaderDefines defines = PrefilteredMap::defines(settings);
  defines["TEXEL"] = SummedAreaTable::texelLayout(channelsOf(settings), formOf(settings));
  return defines;
}

/// The part of a convex polygon where dot(plane, corner) >= 0.
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, glm::dvec3 plane, double offset) {
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(plane, a) - offset, db = glm::dot(plane, b) - offset;
    if (da >= 0.0) out.push_back(a);
    if ((da >= 0.0) != (db >= 0.0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

}  // namespace

std::string PrefilterSettings::key() const {
  return map.key() + fmt::format("/{}/{}/{}/{}/{}/{}/{}/{}", static_cast<int>(basis),
                                 static_cast<int>(prefilter), static_cast<int>(form), bits, exponent, terms,
                                 periodShare, withDepths);
}

int sumBits(int resolution) {
  return std::min(kValueBits,
                  32 - 2 * (static_cast<int>(std::bit_width(static_cast<unsigned>(resolution))) - 1));
}

double deepestSeen(const scene::Scene& scene, const LightFrustum& frustum) {
  const glm::dmat4 toLight = scene.lights.at(0).toLightSpace();
  double deepest = frustum.near;
  for (const glm::uvec3& triangle : scene.mesh.triangles) {
    std::vector<glm::dvec3> polygon;
    for (int corner = 0; corner < 3; ++corner)
      polygon.push_back(glm::dvec3(toLight * glm::dvec4(scene.mesh.positions[triangle[corner]], 1.0)) -
                        glm::dvec3(frustum.offset, 0.0));
    if (std::max({polygon[0].z, polygon[1].z, polygon[2].z}) <= deepest) continue;
    polygon = clipped(polygon, {0.0, 0.0, 1.0}, frustum.near);
    for (int axis = 0; axis < 2; ++axis) {
      glm::dvec3 low(0.0, 0.0, -frustum.low[axis]), high(0.0, 0.0, frustum.high[axis]);
      low[axis] = 1.0, high[axis] = -1.0;
      polygon = clipped(clipped(polygon, low, 0.0), high, 0.0);
    }
    for (const glm::dvec3& corner : polygon) deepest = std::max(deepest, corner.z);
  }
  return deepest;
}

gl::ShaderDefines PrefilteredMap::defines(const PrefilterSettings& settings) {
  gl::ShaderDefines defines;
  if (settings.prefilter == Prefilter::Mips)
    defines["MIPS"] = "1";
  else
    defines = SummedAreaTable::defines(settings.form);
  defines[settings.basis == DepthBasis::Moments       ? "BASIS_MOMENTS"
          : settings.basis == DepthBasis::Exponential ? "BASIS_EXPONENTIAL"
                                                      : "BASIS_FOURIER"] = "1";
  if (settings.withDepths) defines["WITH_DEPTHS"] = "1";
  return defines;
}

PrefilteredMap::PrefilteredMap(Frame& frame, PrefilterSettings settings)
    : settings_(settings),
      frustum_(LightCasters(frame.scene()).fit(glm::dvec2(0.0), settings.map.resolution)),
      deepest_(deepestSeen(frame.scene(), frustum_)),
      fill_(frame.context().programs().compute("renderer/frame/prefiltered_map.comp.glsl",
                                               fillDefines(settings))),
      averages_(frame.context(), arrayOf(settings), "the prefiltered map",
                "choose a smaller map, or fewer terms") {
  // A scene without depth, or without casters, still needs a scale.
  deepest_ = std::max(deepest_, frustum_.near * 1.001);
  if (settings_.bits == 0) settings_.bits = sumBits(settings.map.resolution);
  frame.passes().setBytesHeld(kPrefilterPass, bytes());
}

void PrefilteredMap::configure(const gl::Program& program) const {
  program.set("depthNear", static_cast<float>(frustum_.near));
  program.set("depthScale", static_cast<float>(1.0 / (deepest_ - frustum_.near)));
  program.set("exponent", static_cast<float>(settings_.exponent));
  program.set("terms", settings_.terms);
  program.set("periodShare", static_cast<float>(settings_.periodShare));
  program.set("sumsUnit", 1.0F / static_cast<float>((1U << settings_.bits) - 1U));
}

void PrefilteredMap::make(Frame& frame) {
  const auto& map = frame.get<ShadowMap>(settings_.map);
  const auto scope = frame.passes().open(kPrefilterPass);
  const int resolution = settings_.map.resolution;
  configure(fill_);
  fill_.set("resolution", resolution);
  map.texture().bindTexture(kPrefilteredDepthsUnit);
  texture().bindImage(kPrefilteredImage, gl::Access::Write);
  fill_.dispatch(glm::ivec2(resolution));
  averages_.build();
}

}  // namespace limen::frame
