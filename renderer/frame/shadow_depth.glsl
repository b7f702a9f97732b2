// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame_bindings.h"

// Light-space z from a reversed depth with an infinite far plane.
float linearDepth(float depth, float near) { return depth > 0.0 ? near / depth : kEmptyDepth; }
