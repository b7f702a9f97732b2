// SPDX-License-Identifier: BSD-3-Clause
// Term k of the truncated Fourier series of the step that is 0 below t = 0 and 1 above, t = z - p, without its constant 1/2.
// `texel`: (cos, sin) of the term at z, or an average of them; `receiver`: those at p. The series' period is 2: t must
// stay within (-1, 1).
float stepTerm(int k, vec2 texel, vec2 receiver) {
  return 2.0 * fourierWeight(k) * (texel.y * receiver.x - texel.x * receiver.y);
}
