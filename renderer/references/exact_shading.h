// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/shaded.h"
#include "renderer/references/triangle_tree.h"

namespace limen::references {

/// A point of a surface, relative to the anchor.
struct ExactPoint {
  uint32_t triangle = ExactRay::kNoTriangle;
  glm::dvec3 position{0.0}, view{0.0};      ///< view: unit, to where it is seen from
  glm::dvec3 flatNormal{0.0}, normal{0.0};  ///< unit, on the viewer's side
  bool isFront = true;                      ///< the viewer sees the triangle's front
};

/// What frame::Shaded and the tracers of mirrors make of a surface, in double precision and written apart
/// from them.
class ExactShading {
 public:
  /// All must outlive it. Throws Error if the scene has surfaces other than plain meshes.
  ExactShading(const scene::Scene& scene, const Triangles& triangles, const TriangleTree& tree,
               glm::dvec3 anchor, const frame::ShadedSetting& setting);

  const scene::Material& material(uint32_t triangle) const;
  ExactPoint point(const ExactRay& ray, const ExactHit& hit) const;
  /// The surface's own light. `shadow`: a ray to the light's centre decides whether it is lit.
  glm::dvec3 colour(const ExactPoint& point, bool shadow) const;
  /// Diffuse reflectance at a point.
  glm::dvec3 albedo(const ExactPoint& point) const {
    return albedo(material(point.triangle), point.position);
  }
  glm::dvec3 background() const { return glm::dvec3(setting_.background); }

 private:
  glm::dvec3 albedo(const scene::Material& material, glm::dvec3 position) const;

  const scene::Scene& scene_;
  const Triangles& triangles_;
  const TriangleTree& tree_;
  glm::dvec3 anchor_;
  frame::ShadedSetting setting_;
  std::vector<uint32_t> materialOf_;
};

/// The highlight's reflectance times pi and the cosine of the light, for a light in front of the surface;
/// unit vectors.
double exactHighlight(const frame::ShadedSetting& setting, glm::dvec3 normal, glm::dvec3 light,
                      glm::dvec3 view);
/// Unit direction in which a mirror sends what it gets from `view`: about the shading normal, or about the
/// triangle's own where that would lead beneath the surface.
glm::dvec3 exactMirrored(const ExactPoint& point);
/// Unit direction in which light is followed through a surface: Snell's law at the shading normal (straight
/// on where that would lead back), or exactMirrored() where nothing passes.
struct ExactRefraction {
  glm::dvec3 direction{0.0};
  bool passes = false;
};
ExactRefraction exactRefracted(const scene::Material& material, const ExactPoint& point);
/// Share of the light that a mirror reflects towards the view.
glm::dvec3 exactMirrorShare(const scene::Material& material, const ExactPoint& point);

}  // namespace limen::references
