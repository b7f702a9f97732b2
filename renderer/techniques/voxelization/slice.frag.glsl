// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) out float occupied;

void main() { occupied = 1.0; }
