// SPDX-License-Identifier: BSD-3-Clause
flat in uint first;
layout(location = 0) out uint triangle;

void main() { triangle = first + uint(gl_PrimitiveID); }
