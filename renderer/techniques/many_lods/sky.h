// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// An environment that lights a scene from all around: radiance that changes linearly with height between
/// horizon and zenith, another one below the horizon, and a sun, a lobe peak exp((cos - 1) / width^2) around
/// its direction. All of it has closed-form integrals, which tests use. Source: the bench's own; Holländer
/// 2013, section 3.6.2, takes environment maps that are not given.
struct SkySettings {
  static constexpr const char *kKind = "sky", *kSummary = "an environment around the scene";
  double zenith = 0.5, horizon = 1.0, ground = 0.1;
  double sun = 20.0, sunWidthDeg = 5.0, sunElevationDeg = 45.0, sunAzimuthDeg = 30.0;
  static const SettingsTable<SkySettings>& table();

  glm::dvec3 sunDirection() const;
  double radiance(glm::dvec3 direction) const;  ///< of a unit vector; y is up
};

/// Uniforms of sky.glsl.
void configureSky(const gl::Program& program, const SkySettings& sky);

/// Distant lights that stand for it, by a low-discrepancy pattern with the density of its radiance.
struct SkyLight {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, towards it
  double irradiance = 0.0;              ///< of a surface that faces it
};
std::vector<SkyLight> skyLights(const SkySettings& sky, int count);

}  // namespace limen::techniques
