// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/receiver_surface.h"

namespace limen::techniques {

const SettingsTable<ReceiverSurface>& ReceiverSurface::table() {
  using S = ReceiverSurface;
  static const SettingsTable<S> kTable = {
      {&S::gloss,
       "share",
       {0.0, 1.0},
       "",
       "Share of the light that a lobe around the mirrored direction reflects",
       "Holländer 2013, section 3.6.2 (glossy scenes; no model is given)"},
      {&S::exponent,
       "exponent",
       {1.0, 1000.0},
       "",
       "Exponent of the lobe's cosine",
       "Lafortune and Willems 1994"}};
  return kTable;
}

void configureReceivers(const gl::Program& program, const frame::Frame& frame,
                        const ReceiverSurface& surface) {
  program.set("glossShare", static_cast<float>(surface.gloss));
  program.set("glossExponent", static_cast<float>(surface.exponent));
  program.set("eyePosition", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
}

}  // namespace limen::techniques
