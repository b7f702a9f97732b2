// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"
#include "experiments/base/image.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/references/rectangle_union.h"

namespace limen::references {

/// When a texel of a shadow map counts as an occluder of a receiver.
struct BlockingRule {
  double constant = 0.0;  ///< share of the receiver's distance from the light's plane
  double slope = 0.0;     ///< texels over which the receiver's plane may change besides
  double maxSlope = 1e6;  ///< relative to distance and tangent, up to which that grows
  /// Against the receiver's plane at the texel's place, instead of against the receiver's depth; what of the
  /// light lies behind that plane is hidden then.
  bool plane = false;
};

/// Which neighbours a micropatch is stretched to.
enum class PatchStretch { None, LeftBottom, Diagonal };
constexpr EnumNames<PatchStretch, 3> enumNames(PatchStretch) {
  return {{{{PatchStretch::None, "none"},
            {PatchStretch::LeftBottom, "left_bottom"},
            {PatchStretch::Diagonal, "diagonal"}}}};
}

/// A receiver in light space, the light's centre at the origin.
struct PatchReceiver {
  glm::dvec3 position, normal;  ///< the normal on the side of the light's centre
};

/// The micropatches of a shadow map seen from the light's centre: texels of a level, each a rectangle at one
/// depth, unprojected from the map and projected from a receiver onto the light, in double precision. Written
/// from the description in Schwarz 2009, section 4.1, apart from the techniques that it is a reference for:
/// no search area decides what counts, and no umbra is taken for closed.
class MicropatchesOfMap {
 public:
  /// `depths`: linear depth of the finest level, square. Level i: the nearest depth of 2^i x 2^i texels.
  MicropatchesOfMap(const Image& depths, const frame::LightFrustum& frustum, glm::dvec2 lightSize, int level,
                    const BlockingRule& rule, PatchStretch stretch);

  /// Adds what micropatches hide from the receiver, in unit light coordinates, cut off at the light.
  void gather(const PatchReceiver& receiver, RectangleUnion& hidden) const;
  /// The side of the receiver's plane from which it can be lit, in unit light coordinates, normalised.
  HalfPlane litSide(const PatchReceiver& receiver) const;
  /// Visible share of the light. `scratch` is overwritten.
  double visibility(const PatchReceiver& receiver, RectangleUnion& scratch) const;

 private:
  struct Test;
  double depth(int x, int y) const {
    return depths_[static_cast<size_t>(y) * static_cast<size_t>(side_) + static_cast<size_t>(x)];
  }
  /// Tangents at texel coordinates of the level.
  glm::dvec2 tangent(glm::dvec2 texel) const { return frustum_.low + texel * texel_; }

  int side_ = 0, level_;
  std::vector<double> depths_;  // of the level
  double nearest_ = 1e300;
  frame::LightFrustum frustum_;
  glm::dvec2 texel_;  // extents of the level's texels, tangents
  glm::dvec2 lightSize_;
  BlockingRule rule_;
  PatchStretch stretch_;
};

}  // namespace limen::references
