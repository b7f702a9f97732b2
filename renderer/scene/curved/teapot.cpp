// SPDX-License-Identifier: BSD-3-Clause
// The control points are those of M. Newell (1975), which have been distributed freely since, for example in
// F. Crow, "The Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987; they are plain
// measurements in the public domain. Bottom included; the knob's top control points, which some copies move
// by 0.002 from the axis (a pinhole), lie on it. Written as profiles: body and lid are solids of revolution,
// handle and spout are tubes with a plane of symmetry.
#include "renderer/scene/curved/teapot.h"

#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

/// Control points of a quarter circle of radius r: (r, 0), (r, bulge), (bulge, r), (0, r); at a height. The
/// bulge is 0.56 r in the original, in one place rounded.
struct ProfilePoint {
  double radius, bulge, height;
};
using QuarterProfile = std::array<ProfilePoint, 4>;

/// From below to above, as seen walking along the outside.
constexpr std::array<QuarterProfile, 6> kProfiles = {{
    {{{0.0, 0.0, 0.0}, {1.425, 0.798, 0.0}, {1.5, 0.84, 0.075}, {1.5, 0.84, 0.15}}},  // bottom
    {{{1.5, 0.84, 0.15}, {1.5, 0.84, 0.225}, {2.0, 1.12, 0.45}, {2.0, 1.12, 0.9}}},   // lower body
    {{{2.0, 1.12, 0.9}, {2.0, 1.12, 1.35}, {1.75, 0.98, 1.875}, {1.5, 0.84, 2.4}}},   // upper body
    {{{1.5, 0.84, 2.4}, {1.4375, 0.805, 2.53125}, {1.3375, 0.749, 2.53125}, {1.4, 0.784, 2.4}}},  // rim
    {{{1.3, 0.728, 2.4}, {1.3, 0.728, 2.55}, {0.4, 0.224, 2.55}, {0.2, 0.112, 2.7}}},             // lid
    {{{0.2, 0.112, 2.7}, {0.0, 0.0, 2.85}, {0.8, 0.45, 3.15}, {0.0, 0.0, 3.15}}},                 // knob
}};

/// Half of a cross-section of a tube: inner (x, y), outer (x, y), half width in z.
struct Section {
  glm::dvec2 inner, outer;
  double halfWidth;
};
using Tube = std::array<Section, 7>;

constexpr Tube kHandle = {{{{-1.6, 2.025}, {-1.5, 2.25}, 0.3},
                           {{-2.3, 2.025}, {-2.5, 2.25}, 0.3},
                           {{-2.7, 2.025}, {-3.0, 2.25}, 0.3},
                           {{-2.7, 1.8}, {-3.0, 1.8}, 0.3},
                           {{-2.7, 1.575}, {-3.0, 1.35}, 0.3},
                           {{-2.5, 1.125}, {-2.65, 0.9375}, 0.3},
                           {{-2.0, 0.9}, {-1.9, 0.6}, 0.3}}};

constexpr Tube kSpout = {{{{1.7, 1.425}, {1.7, 0.6}, 0.66},
                          {{2.6, 1.425}, {3.1, 0.825}, 0.66},
                          {{2.3, 2.1}, {2.4, 2.025}, 0.25},
                          {{2.7, 2.4}, {3.3, 2.4}, 0.25},
                          {{2.8, 2.475}, {3.525, 2.49375}, 0.25},
                          {{2.9, 2.475}, {3.45, 2.5125}, 0.15},
                          {{2.8, 2.4}, {3.2, 2.4}, 0.15}}};

using Net = std::array<glm::dvec4, 16>;

/// u runs around the axis, counter-clockwise seen from above, v along the profile.
void addQuarter(surfaces::PatchSet& set, const QuarterProfile& profile, int quarter) {
  constexpr std::array<glm::dvec2, 4> kAlong = {{{1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}, {0.0, 1.0}}};
  const glm::dvec2 x = kAlong[static_cast<size_t>(quarter)], y = kAlong[static_cast<size_t>(quarter + 1) % 4];
  Net net;
  for (size_t j = 0; j < 4; ++j) {
    const auto [r, b, height] = profile[j];
    const std::array<glm::dvec2, 4> circle = {r * x, r * x + b * y, b * x + r * y, r * y};
    for (size_t i = 0; i < 4; ++i) net[i + 4 * j] = {circle[i].x, height, circle[i].y, 1.0};
  }
  addRectangle(set, 3, 3, net);
}

/// Four patches: both halves of sections 0 to 3 and 3 to 6. u runs along half a section, v along the tube.
/// The inner side lies to the left of the tube's direction as seen from +z.
void addTube(surfaces::PatchSet& set, const Tube& tube) {
  for (const size_t first : {size_t{0}, size_t{3}})
    for (const double side : {1.0, -1.0}) {
      Net net;
      for (size_t j = 0; j < 4; ++j) {
        const Section& at = tube[first + j];
        const double z = side * at.halfWidth;
        const std::array<glm::dvec4, 4> half = {glm::dvec4(at.inner, 0.0, 1.0), glm::dvec4(at.inner, z, 1.0),
                                                glm::dvec4(at.outer, z, 1.0), glm::dvec4(at.outer, 0.0, 1.0)};
        for (size_t i = 0; i < 4; ++i) net[(side > 0.0 ? i : 3 - i) + 4 * j] = half[i];
      }
      addRectangle(set, 3, 3, net);
    }
}

}  // namespace

surfaces::PatchSet teapot() {
  surfaces::PatchSet set;
  for (const QuarterProfile& profile : kProfiles)
    for (int quarter = 0; quarter < 4; ++quarter) addQuarter(set, profile, quarter);
  addTube(set, kHandle);
  addTube(set, kSpout);
  return set;
}

}  // namespace limen::scene
