// SPDX-License-Identifier: BSD-3-Clause
flat out uint patchOfVertex;

void main() { patchOfVertex = uint(gl_VertexID); }
