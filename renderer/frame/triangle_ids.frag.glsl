// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) out uint triangle;

void main() { triangle = uint(gl_PrimitiveID); }
