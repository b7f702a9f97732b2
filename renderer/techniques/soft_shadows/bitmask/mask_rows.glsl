// SPDX-License-Identifier: BSD-3-Clause
// Entering samples row by row into a mask of a grid. The jittered pattern has two rows of samples in each row of bits, one of
// even and one of odd columns. Needs occlusion_mask.glsl; empty for
// samples that lie anywhere.
#ifdef SAMPLES_ALONG
const int kSamplesAlong = SAMPLES_ALONG;

// Bits of the samples of row j, kSamplesAlong of them.
void addRow(int j, uint row) {
#if SAMPLES_ALONG == 32
  mask[j] |= row;
#elif SAMPLES_ALONG == 8
  mask[j >> 2] |= row << (8 * (j & 3));
#else
  mask[j >> 1] |= row << (16 * (j & 1));
#endif
}

// Jittered pattern: row j of bits from those of its even and its odd columns' samples.
uint joinedColumns(uint even, uint odd) { return (even & 0x5555u) | (odd & 0xaaaau); }
#endif
