// SPDX-License-Identifier: BSD-3-Clause
// How many further samples the geometry in a pixel's window asks for, before scaling (Holländer 2013, section 4.3.1).
// The including shader defines kSamples; normals are unit vectors. METRIC_FORM_PRINTED: as the thesis prints the formulas;
// otherwise in forms that do not lose their digits to cancellation.

// Direction of the mean normal; the first normal where they cancel each other.
vec3 meanNormal(vec3 normals[kSamples]) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kSamples; ++i) sum += normals[i];
#if METRIC_FORM == METRIC_FORM_PRINTED
  return normalize(sum);
#else
  return dot(sum, sum) > 1e-6 ? normalize(sum) : normals[0];
#endif
}

// 1 - dot(a, b) of unit vectors.
float oneMinusCosine(vec3 a, vec3 b) {
#if METRIC_FORM == METRIC_FORM_PRINTED
  return 1.0 - dot(a, b);
#else
  const vec3 between = a - b;
  return 0.5 * dot(between, between);
#endif
}

// MM: depth range.
float depthRange(float depths[kSamples]) {
  float nearest = depths[0], farthest = depths[0];
  for (int i = 1; i < kSamples; ++i) {
    nearest = min(nearest, depths[i]);
    farthest = max(farthest, depths[i]);
  }
  return farthest - nearest;
}

// NC: opening of the cone of normals around their mean, whichever side they face.
float normalCone(vec3 normals[kSamples]) {
  const vec3 mean = meanNormal(normals);
#if METRIC_FORM == METRIC_FORM_PRINTED
  float least = 1.0;
  for (int i = 0; i < kSamples; ++i) least = min(least, abs(dot(mean, normals[i])));
  return sqrt(1.0 - least);
#else
  float widest = 0.0;
  for (int i = 0; i < kSamples; ++i)
    widest = max(widest, min(oneMinusCosine(mean, normals[i]), oneMinusCosine(-mean, normals[i])));
  return sqrt(widest);
#endif
}

// DV: variance of depths.
float depthVariance(float depths[kSamples]) {
#if METRIC_FORM == METRIC_FORM_PRINTED
  precise float sum = 0.0, squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    sum += depths[i];
    squares += depths[i] * depths[i];
  }
  const float mean = sum / float(kSamples);
  return squares / float(kSamples) - mean * mean;
#else
  // About the first depth, then about the mean of what is left.
  float sum = 0.0;
  for (int i = 1; i < kSamples; ++i) sum += depths[i] - depths[0];
  const float mean = sum / float(kSamples);
  float squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const float deviation = (depths[i] - depths[0]) - mean;
    squares += deviation * deviation;
  }
  return squares / float(kSamples);
#endif
}

// NV: sum of squared deviations from the mean normal.
float normalVariance(vec3 normals[kSamples]) {
  const vec3 mean = meanNormal(normals);
  float sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const float deviation = oneMinusCosine(normals[i], mean);
    sum += deviation * deviation;
  }
  return sum;
}
