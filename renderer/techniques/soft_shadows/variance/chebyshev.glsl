// SPDX-License-Identifier: BSD-3-Clause
// Largest share of a distribution with these first two moments that can lie at or beyond `depth` (Cantelli's one-sided
// form of Chebyshev's inequality).
float chebyshev(vec2 moments, float depth, float minVariance) {
  const float beyond = depth - moments.x;
  // A receiver before the mean may be wholly lit, for all that two moments say.
  if (!(beyond > 0.0)) return 1.0;
  const float variance = max(moments.y - moments.x * moments.x, minVariance);
  return variance / (variance + beyond * beyond);
}

// What is below `cut` becomes 0 and the rest is stretched to 0..1: light that leaks below it goes, and penumbrae darken.
float withoutBleeding(float visibility, float cut) { return clamp((visibility - cut) / (1.0 - cut), 0.0, 1.0); }
