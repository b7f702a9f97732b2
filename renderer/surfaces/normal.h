// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/bezier.h"

namespace limen::surfaces {

/// Where a normal came from; tried in this order until one gives a direction. (Schwarz 2009, section 6.1.1,
/// names degenerate places and no remedy; SC-04.)
enum class NormalRung : uint8_t {
  Field,        ///< the patch's own normal field
  Tangents,     ///< cross product of the derivatives
  Limit,        ///< its first-order change on the way into the domain: one side collapsed to a point
  Inward,       ///< cross product a little way inside the domain
  CornerPlane,  ///< area vector of the corners
  None          ///< the patch has no area; the normal is (0, 0, 1)
};
inline constexpr size_t kNormalRungs = 6;
using NormalHistogram = std::array<size_t, kNormalRungs>;

struct SurfaceNormal {
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit
  NormalRung rung = NormalRung::None;
};

struct NormalSettings {
  /// The sine of the angle between the derivatives, and their lengths as shares of the control points'
  /// diagonal, below which they count as degenerate. Half the digits: cancellation takes as much again.
  double tolerance = 1e-8;
  double inward = 1e-3;  ///< step of NormalRung::Inward, domain units
};

SurfaceNormal normalAt(const PatchSet& set, const Patch& patch, const DomainPoint& at,
                       const NormalSettings& settings = {});

/// The normal of the geometry alone, whatever normal field the patch has.
SurfaceNormal geometricNormal(const PatchSet& set, const Patch& patch, const DomainPoint& at,
                              const NormalSettings& settings = {});

}  // namespace limen::surfaces
