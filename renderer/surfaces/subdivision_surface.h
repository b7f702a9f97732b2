// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/subdivision_stencils.h"

namespace limen::surfaces {

/// Swings about an axis: by amplitude sin(2 pi time / period + phase).
struct Joint {
  glm::dvec3 pivot{0.0}, axis{1.0, 0.0, 0.0};  ///< axis: unit
  double amplitudeRad = 0.0, periodS = 1.0, phaseRad = 0.0;
  /// Of positions at a time, about the pivot.
  glm::dmat4 at(double timeS) const;
};

/// What moves a vertex of a control mesh: it follows `joint` to the extent of its weight, and rests
/// otherwise.
struct JointBinding {
  uint32_t joint = 0;
  float weight = 0.0F;  ///< 0..1
};

/// Values at the corners of a control mesh's faces, subdivided by the rules of positions with boundaries
/// along seams: edges at whose ends its two faces have different values.
struct CornerAttributes {
  std::vector<glm::dvec3> values;            ///< texture coordinates, 0..1, and one more
  std::vector<std::vector<uint32_t>> faces;  ///< of values, corner by corner as the control mesh's
};

/// A control mesh whose limit surface is drawn, with linear blend skinning.
struct SubdivisionSurface {
  PolygonMesh cage;
  SubdivisionScheme scheme = SubdivisionScheme::Loop;
  uint32_t part = 0;  ///< of Scene::parts
  std::vector<Joint> joints;
  std::vector<JointBinding> bindings;  ///< empty, or one for each vertex of the cage
  std::optional<CornerAttributes> attributes;
};

/// A mesh of the values themselves, its sharp edges the cage's. Throws Error where faces do not agree.
PolygonMesh attributeMesh(const PolygonMesh& cage, const CornerAttributes& attributes);

/// The cage's vertices at a time.
std::vector<glm::dvec3> skinned(const SubdivisionSurface& surface, double timeS);

}  // namespace limen::surfaces
