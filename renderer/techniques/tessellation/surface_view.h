// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/surfaces/tessellated_surface.h"

namespace limen::techniques {

/// How a frame looks at a tessellated surface.
surfaces::SurfaceView viewOf(const frame::Frame& frame);

}  // namespace limen::techniques
