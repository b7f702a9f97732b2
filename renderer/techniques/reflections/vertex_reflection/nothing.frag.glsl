// SPDX-License-Identifier: BSD-3-Clause
// For draws that only count.
void main() { discard; }
