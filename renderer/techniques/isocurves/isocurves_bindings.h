// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of isocurves are bound to, beside the patches of tessellation_bindings.h. For C++ and
// GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kIsocurveGroup = 64;
const int kMostIsocurves = 4096;    // of a patch, and points on each
const int kIsocurveParts = 16;      // of a patch, each with a group of its own, or
const int kIsocurveSharers = 16;    // groups on a software renderer, which ends an invocation's loops after
const int kIsocurveRounds = 65535;  // rounds

const uint kIsocurveDepthImage = 0u;  // reversed depth as bits, 0: nothing
const uint kIsocurveIdsImage = 1u;
const uint kIsocurveNormalsImage = 2u;
const uint kIsocurveCountsImage = 3u;  // points that fell into the pixel
const uint kIsocurveDriftBuffer = 3u;  // largest drift, px, as bits; most steps of a curve; pieces
                                       // filled; most loop rounds of a group that draws pieces

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
