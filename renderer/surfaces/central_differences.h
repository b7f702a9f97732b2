// SPDX-License-Identifier: BSD-3-Clause
// Splits by central differences in place of Bézier control points (Catmull 1974, Clark 1979; Schwarz 2009,
// section 7.2.2; SC-39): the middle of a cubic from its ends and its second differences there, with additions
// and divisions by powers of two alone.
#pragma once

#include "renderer/surfaces/recursion.h"

namespace limen::surfaces {

/// A bicubic patch at a corner: point, and second differences over the part that has the corner.
template <class Vector>
struct CentralRecord {
  Vector p{}, uu{}, vv{}, uuvv{};
};

/// Between two corners that differ in u; differences over the whole part.
template <class Vector>
CentralRecord<Vector> middleAlongU(const CentralRecord<Vector>& a, const CentralRecord<Vector>& b) {
  const Vector uu = 0.5 * (a.uu + b.uu), uuvv = 0.5 * (a.uuvv + b.uuvv);
  return {0.5 * (a.p + b.p) - 0.125 * uu, uu, 0.5 * (a.vv + b.vv) - 0.125 * uuvv, uuvv};
}
template <class Vector>
CentralRecord<Vector> middleAlongV(const CentralRecord<Vector>& a, const CentralRecord<Vector>& b) {
  const Vector vv = 0.5 * (a.vv + b.vv), uuvv = 0.5 * (a.uuvv + b.uuvv);
  return {0.5 * (a.p + b.p) - 0.125 * vv, 0.5 * (a.uu + b.uu) - 0.125 * uuvv, vv, uuvv};
}
/// The same corner over half of the part along u or v.
template <class Vector>
CentralRecord<Vector> halvedAlongU(const CentralRecord<Vector>& a) {
  return {a.p, 0.25 * a.uu, a.vv, 0.25 * a.uuvv};
}
template <class Vector>
CentralRecord<Vector> halvedAlongV(const CentralRecord<Vector>& a) {
  return {a.p, a.uu, 0.25 * a.vv, 0.25 * a.uuvv};
}

/// Refines bicubic patches, rational ones as well, into halves like SplitPolicy::Halves. Flat are sides at
/// whose ends the second difference is small (Clark 1979); settings.flatness is not used. Throws Error for
/// other patches.
TessellatedSurface refinedByCentralDifferences(const PatchSet& set, const SurfaceView& view,
                                               const RecursionSettings& settings, glm::dvec3 anchor,
                                               RecursionCounts& counts);

}  // namespace limen::surfaces
