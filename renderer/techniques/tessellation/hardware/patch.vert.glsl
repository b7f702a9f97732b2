// SPDX-License-Identifier: BSD-3-Clause
layout(location = 0) in uint patchNumber;
out uint number;

void main() { number = patchNumber; }
