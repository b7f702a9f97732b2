// SPDX-License-Identifier: BSD-3-Clause
// What bezier_samples.comp.glsl is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

const uint kBezierPointsBuffer = 0u;
const uint kBezierSamplesBuffer = 1u;
const uint kBezierResultsBuffer = 2u;
