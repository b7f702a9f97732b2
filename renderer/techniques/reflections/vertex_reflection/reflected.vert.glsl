// SPDX-License-Identifier: BSD-3-Clause
// A vertex of the reflected mesh at its reflection point. IN_VERTEX_SHADER: solved here (Roger 2008, section 2.2.3);
// otherwise by solve_vertices.comp.glsl. TESSELLATED: what the tessellation stages take.
#include "renderer/techniques/reflections/vertex_reflection/reflected.glsl"

layout(location = 0) in vec3 position;
#ifndef IN_VERTEX_SHADER
layout(std430, binding = kReflectedVerticesBuffer) readonly buffer Reflected { vec4 reflected[]; };
#endif
#ifdef TESSELLATED
out vec3 cornerPosition;
out vec4 cornerReflected;
#else
out vec3 reflectedPosition, reflectionPoint;
out float pathLength, validity;
uniform mat4 anchorToClip;
#endif

void main() {
#ifdef IN_VERTEX_SHADER
  const vec4 found = reflectedVertex(position, vec4(0.0));
#else
  const vec4 found = reflected[gl_VertexID];
#endif
#ifdef TESSELLATED
  cornerPosition = position;
  cornerReflected = found;
#else
  reflectedPosition = position;
  reflectionPoint = found.xyz;
  pathLength = length(found.xyz - position);
  validity = usable(found) ? 1.0 : 0.0;
  gl_Position = anchorToClip * vec4(found.xyz, 1.0);
#endif
}
