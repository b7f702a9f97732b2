// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/occlusion_settings.h"

#include <cmath>

#include "experiments/base/error.h"
#include "renderer/techniques/visibility_fields/occlusion_pass_bindings.h"

namespace limen::techniques {

static_assert(static_cast<int>(Falloff::Binary) == kFalloffBinary &&
              static_cast<int>(Falloff::Linear) == kFalloffLinear &&
              static_cast<int>(Falloff::Exponential) == kFalloffExponential);

const SettingsTable<OcclusionRays>& OcclusionRays::table() {
  using S = OcclusionRays;
  static const SettingsTable<S> kTable = {
      {&S::rays,
       "rays",
       {1, 1024},
       "rays",
       "Rays per pixel, a square number: a concentric map's texels",
       "Gaitatzes 2012, section 4.7.1"},
      {&S::turned, "turned", "Turn each pixel's rays about its normal by a random angle", "bench"},
      {&S::seed, "seed", {0, 1000000}, "", "Seed of the angles"},
      {&S::falloff, "falloff",
       "Visibility by distance: 0 within the radius; rising to 1 at the radius; 1 - exp(-distance / radius)",
       "Gaitatzes 2012, equation 3 (form not given there)"},
      {&S::radius,
       "radius",
       {0.0001, 10.0},
       "",
       "Distance of the falloff, as a share of the scene's diagonal",
       "Gaitatzes 2012, equation 3 (value not given there)"},
      {&S::selfOcclusion, "self_occlusion", "Objects occlude themselves, and not only others",
       "Gaitatzes 2012, section 4.4.2"},
      {&S::objects, "objects", "What of the scene is one rigid object"}};
  return kTable;
}

int OcclusionRays::side() const { return static_cast<int>(std::lround(std::sqrt(double(rays)))); }

void OcclusionRays::check() const {
  if (int64_t{side()} * side() != rays)
    throw Error("'rays' is " + std::to_string(rays) + ", not a square number", "rays",
                "give " + std::to_string(side() * side()));
}

void OcclusionRays::configure(const gl::Program& program, const frame::Frame& frame) const {
  program.set("sizePx", frame.sizePx());
  program.set("raySide", side());
  program.set("turned", turned ? 1 : 0);
  program.set("seed", static_cast<uint32_t>(seed));
  program.set("falloff", static_cast<int>(falloff));
  program.set("falloffRadius", static_cast<float>(radius * frame.gpuScene().diagonal()));
  program.set("selfOcclusion", selfOcclusion ? 1 : 0);
  program.set("eyePosition", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
}

}  // namespace limen::techniques
