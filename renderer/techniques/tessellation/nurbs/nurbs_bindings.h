// SPDX-License-Identifier: BSD-3-Clause
// What the shaders that evaluate NURBS are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kNurbsFunctions = 10;  // most that are not 0 at a parameter: of degree 9

struct NurbsRecord {  // std430
  uint firstPoint, pointsU, pointsV;
  uint degreeU, degreeV;
  uint firstKnotU, firstKnotV;
  uint firstU, firstV;  // parameters
  uint columns, rows;   // of samples
  uint firstVertex;
  uint material;
  uint unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(NurbsRecord) == 64);
#endif

// Of one direction at a parameter.
struct BasisRecord {  // std430
  uint first;         // control point of the first function
  float basis[kNurbsFunctions];
  float slope[kNurbsFunctions];
};
#ifdef __cplusplus
static_assert(sizeof(BasisRecord) == 84);
#endif

const uint kNurbsSurfacesBuffer = 0u;
const uint kNurbsPointsBuffer = 1u;
const uint kNurbsKnotsBuffer = 2u;
const uint kNurbsParametersBuffer = 3u;
const uint kNurbsBasisBuffer = 4u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif
