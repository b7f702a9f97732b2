// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// How what the camera sees reflects light: diffusely, and by a lobe around the mirrored direction, the
/// modified Phong model: reflectance (1 - share) albedo / pi + share (n + 2) / (2 pi) cos^n, whose lobe
/// reflects `share` of what arrives along the normal and less from elsewhere, so that energy is kept. Source:
/// Lafortune and Willems 1994; Holländer 2013, section 3.6.2, shows glossy scenes and names no model.
struct ReceiverSurface {
  double gloss = 0.0;
  double exponent = 30.0;
  static const SettingsTable<ReceiverSurface>& table();
};
inline constexpr const char* kReceiverText = "How what the camera sees reflects light";

/// Uniforms of glossy.glsl, and `eyePosition`.
void configureReceivers(const gl::Program& program, const frame::Frame& frame,
                        const ReceiverSurface& surface);

}  // namespace limen::techniques
