// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/light_rays.h"

#include <algorithm>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

namespace limen::techniques {

static_assert(static_cast<int>(LightForm::Rectangle) == kLightRectangle &&
              static_cast<int>(LightForm::Sphere) == kLightSphere);

const SettingsTable<LightRays>& LightRays::table() {
  using S = LightRays;
  static const SettingsTable<S> kTable = {included(&S::receiver),
                                          {&S::light, "light",
                                           "Shape of the light: the scene's rectangle, or a sphere about its "
                                           "centre whose diameter is its longer side",
                                           "Gaitatzes 2012, section 4.7.2 (spheres)"}};
  return kTable;
}

void LightRays::makeInputs(frame::Frame& frame) {
  ReceiverRays::makeInputs(frame);
  frame.get<frame::Receivers>();
}

void LightRays::configure(const gl::Program& program, frame::Frame& frame) const {
  receiver.configure(program, frame);
  frame.get<frame::Receivers>().texture().bindTexture(kFieldReceiversUnit);
  const scene::AreaLight& of = frame.scene().lights.at(0);
  program.set("lightForm", static_cast<int>(light));
  program.set("lightCentre", glm::vec3(of.centre - frame.gpuScene().anchor()));
  program.set("lightX", glm::vec3(0.5 * of.size.x * of.axisX));
  program.set("lightY", glm::vec3(0.5 * of.size.y * of.axisY));
  program.set("lightRadius", static_cast<float>(0.5 * std::max(of.size.x, of.size.y)));
}

}  // namespace limen::techniques
