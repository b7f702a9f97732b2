// SPDX-License-Identifier: BSD-3-Clause
// Real spherical harmonics up to the second order, of a unit vector.
float harmonic(int term, vec3 d) {
  switch (term) {
    case 0: return 0.28209479;
    case 1: return 0.48860251 * d.y;
    case 2: return 0.48860251 * d.z;
    case 3: return 0.48860251 * d.x;
    case 4: return 1.09254843 * d.x * d.y;
    case 5: return 1.09254843 * d.y * d.z;
    case 6: return 0.31539157 * (3.0 * d.z * d.z - 1.0);
    case 7: return 1.09254843 * d.x * d.z;
    default: return 0.54627422 * (d.x * d.x - d.y * d.y);
  }
}

// What the cosine makes of an order, over pi (Ramamoorthi and Hanrahan 2001).
float cosineShare(int term) { return term == 0 ? 1.0 : term < 4 ? 2.0 / 3.0 : 0.25; }
