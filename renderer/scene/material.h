// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace limen::scene {

/// Solid texture: reflectance as a function of position in space. Factor of
/// the albedo: 1 + contrast * s with s in [-1, 1]; the product is clamped to 0..1.
struct Pattern {
  enum class Kind {
    None,
    Checker,    ///< s = +1 and -1 in cubes of edge `size`
    ValueNoise  ///< random values on a lattice of pitch `size`, interpolated (quintic); octaves halve both
  };
  Kind kind = Kind::None;
  double size = 0.1;       ///< world units, > 0
  double contrast = 0.5;   ///< 0..1
  int octaves = 4;         ///< ValueNoise only
  glm::dvec3 origin{0.0};  ///< a lattice point, world space
};

/// How a surface's normal or lighting is determined if not by its triangles alone.
enum class SurfaceKind {
  Mesh,          ///< vertex normals if the mesh has them, otherwise flat
  BicubicPatch,  ///< normal of the patch Scene::patches[Material::patch] at the parameters in attributes.xy
  Aperture       ///< lit through a horizon cone: attributes = (axis, angle in rad) per vertex
};

/// A diffuse surface that may reflect and refract as well (Roger 2008, section 1.2). Further properties are
/// added with the techniques that need them.
struct Material {
  std::string name;
  glm::vec3 albedo{0.7F};  ///< linear reflectance of the diffuse part, 0..1
  Pattern pattern{};
  SurfaceKind surface = SurfaceKind::Mesh;
  uint32_t patch = 0;  ///< BicubicPatch only
  /// Share of the light that is reflected along the mirror direction, per channel, 0..1; 0: no mirror.
  glm::vec3 mirror{0.0F};
  /// True: `mirror` is the share at normal incidence, and grows towards 1 at grazing angles (Schlick).
  bool fresnel = false;
  /// Half-angle of the cone around the mirror direction from which light is gathered [rad], 0 to pi / 2; 0: a
  /// perfect mirror.
  float glossRad = 0.0F;
  /// Share of the light that passes through the surface, refracted, per channel, 0..1; 0: opaque.
  glm::vec3 transmittance{0.0F};
  /// Of the side that the normal points away from, relative to the other; > 0.
  float refractiveIndex = 1.5F;
  /// Radiance that leaves the front side in all directions, per channel, >= 0; for techniques of global
  /// illumination.
  glm::vec3 emission{0.0F};

  bool reflects() const { return mirror != glm::vec3(0.0F); }
  bool refracts() const { return transmittance != glm::vec3(0.0F); }
  bool emits() const { return emission != glm::vec3(0.0F); }
};

}  // namespace limen::scene
