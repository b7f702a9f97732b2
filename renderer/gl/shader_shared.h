// SPDX-License-Identifier: BSD-3-Clause
// Base of the headers that C++ and GLSL share (*_bindings.h): constants are `const uint` or `const int`; C++
// wraps them in its namespace where __cplusplus is defined. The shader reader takes each header once and
// drops #pragma once.
#pragma once

#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace limen {
using uint = std::uint32_t;
using glm::vec3;
using glm::vec4;
#endif

// Work groups of the shaders that make a pixel each: kGroupSide x kGroupSide, as Program::dispatch() takes
// for granted.
const int kGroupSide = 8;

#ifdef __cplusplus
}  // namespace limen
#endif
