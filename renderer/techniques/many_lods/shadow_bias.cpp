// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/shadow_bias.h"

#include <cmath>

namespace limen::techniques {

const SettingsTable<ShadowBias>& ShadowBias::table() {
  using S = ShadowBias;
  static const SettingsTable<S> kTable = {
      {&S::leaves,
       "leaves",
       {0.0, 64.0},
       "",
       "How much nearer to a light than a point its occluders are, radii of leaves"},
      {&S::pixels,
       "pixels",
       {0.0, 16.0},
       "px",
       "And by as many pixels, or with spheres as many nodes of the size allowed if that is more, times 1 + "
       "the "
       "surface's slope"},
      {&S::nearest,
       "nearest",
       {0.0, 64.0},
       "",
       "Points nearer to a light than this do not occlude, radii of leaves"}};
  return kTable;
}

double hemispherePixelSlope(int tilePx) { return std::sqrt(8.0) / tilePx; }

}  // namespace limen::techniques
