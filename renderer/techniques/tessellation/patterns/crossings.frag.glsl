// SPDX-License-Identifier: BSD-3-Clause
// +1 where the line of sight enters a surface, -1 where it leaves. See crossings.h.
in vec3 normal;
in float distance_;
flat in uint material;
layout(location = 0) out float crossing;

void main() { crossing = gl_FrontFacing ? 1.0 : -1.0; }
