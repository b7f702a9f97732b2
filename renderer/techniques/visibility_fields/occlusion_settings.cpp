// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/occlusion_settings.h"

#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

namespace limen::techniques {

static_assert(static_cast<int>(Falloff::Binary) == kFalloffBinary &&
              static_cast<int>(Falloff::Linear) == kFalloffLinear &&
              static_cast<int>(Falloff::Exponential) == kFalloffExponential);

const SettingsTable<OcclusionRays>& OcclusionRays::table() {
  using S = OcclusionRays;
  static const SettingsTable<S> kTable = {included(&S::receiver), falloffBinding(&S::falloff),
                                          falloffRadiusBinding(&S::radius)};
  return kTable;
}

void OcclusionRays::configure(const gl::Program& program, frame::Frame& frame) const {
  receiver.configure(program, frame);
  program.set("falloff", static_cast<int>(falloff));
  program.set("falloffRadius", static_cast<float>(radius * frame.gpuScene().diagonal()));
}

}  // namespace limen::techniques
