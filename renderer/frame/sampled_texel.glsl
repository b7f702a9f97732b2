// SPDX-License-Identifier: BSD-3-Clause
// Which finest texel stands for a coarse one, and where an atlas of all levels holds its depth. See sampled_pyramid.h.
// DEPTHS_CENTRE: that at its centre. DEPTHS_MEDIAN: one of four; where is not known, its centre stands for their places.

// Offsets within the texels of a level follow two rank-1 lattices: neighbours sample different places, any few of them spread
// evenly over a texel, and it takes few multiplications. The steps are fractions of 2^32: powers of the inverse of the real root
// of x^5 = x + 1, as in M. Roberts's R sequences (2018).
ivec2 latticeTexel(ivec2 texel, int level) {
  const uvec2 t = uvec2(texel), offset = uvec2(t.x * 3679390609u + t.y * 3152041523u, t.x * 2700274806u + t.y * 2313257605u) +
                                          uint(level) * uvec2(1981709691u, 1697680919u);
  return (texel << level) + ivec2((offset >> 1) >> (31 - level));
}

#if defined(DEPTHS_CENTRE) || defined(DEPTHS_MEDIAN)
ivec2 sampledTexel(ivec2 texel, int level) { return (texel << level) + ((1 << level) >> 1); }
#else
ivec2 sampledTexel(ivec2 texel, int level) { return latticeTexel(texel, level); }
#endif

// Place in the atlas of a texel of a level above 0; the levels stand above each other.
ivec2 sampledPlace(ivec2 texel, int level, int resolution) {
  return texel + ivec2(0, resolution - ((2 * resolution) >> level));
}
