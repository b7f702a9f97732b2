// SPDX-License-Identifier: BSD-3-Clause
// Masks of all pixels in an array of images: layers of 128 samples, one set of layers after another.
#define KEPT_LAYERS ((MASK_WORDS + 3) / 4)

uvec4 wordsOf(int layer) {
  uvec4 words = uvec4(0u);
  for (int i = 0; i < min(MASK_WORDS, 4); ++i) words[i] = mask[4 * layer + i];
  return words;
}

// Samples that a set has as covered are covered here, too.
void addKeptMask(ivec2 pixel, int set) {
  for (int layer = 0; layer < KEPT_LAYERS; ++layer) {
    const uvec4 words = imageLoad(keptMasks, ivec3(pixel, set * KEPT_LAYERS + layer));
    for (int i = 0; i < min(MASK_WORDS, 4); ++i) mask[4 * layer + i] |= words[i];
  }
}
