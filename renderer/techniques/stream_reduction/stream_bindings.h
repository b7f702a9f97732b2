// SPDX-License-Identifier: BSD-3-Clause
// What the shader that shows a stream is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kStreamItemsBuffer = 0u;
const uint kStreamCountBuffer = 1u;
const uint kStreamCopyBuffer = 2u;  // what a copy writes
const int kStreamCopyGroup = 256;
const uint kStreamImage = 0u;
// Second words of pairs differ from the first ones by these bits.
const uint kPairBits = 0x5a5a5a5au;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
