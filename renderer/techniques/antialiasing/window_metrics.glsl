// SPDX-License-Identifier: BSD-3-Clause
// How many further samples the geometry in a pixel's window asks for, before scaling (Holländer 2013, section 4.3.1).
// The including shader defines kSamples and fills the window. METRIC_FORM_PRINTED: as the thesis prints the formulas;
// otherwise in forms that do not lose their digits to cancellation.

float windowDepths[kSamples];
vec3 windowNormals[kSamples];  // unit

// Share of the window's mean normal; the first normal where they cancel each other.
vec3 meanNormal() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kSamples; ++i) sum += windowNormals[i];
#if METRIC_FORM == METRIC_FORM_PRINTED
  return normalize(sum);
#else
  return dot(sum, sum) > 1e-6 ? normalize(sum) : windowNormals[0];
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
float depthRange() {
  float nearest = windowDepths[0], farthest = windowDepths[0];
  for (int i = 1; i < kSamples; ++i) {
    nearest = min(nearest, windowDepths[i]);
    farthest = max(farthest, windowDepths[i]);
  }
  return farthest - nearest;
}

// NC: opening of the cone of normals around their mean, whichever side they face.
float normalCone() {
  const vec3 mean = meanNormal();
#if METRIC_FORM == METRIC_FORM_PRINTED
  float least = 1.0;
  for (int i = 0; i < kSamples; ++i) least = min(least, abs(dot(mean, windowNormals[i])));
  return sqrt(1.0 - least);
#else
  float widest = 0.0;
  for (int i = 0; i < kSamples; ++i)
    widest = max(widest, min(oneMinusCosine(mean, windowNormals[i]), oneMinusCosine(-mean, windowNormals[i])));
  return sqrt(widest);
#endif
}

// DV: variance of depths.
float depthVariance() {
#if METRIC_FORM == METRIC_FORM_PRINTED
  precise float sum = 0.0, squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    sum += windowDepths[i];
    squares += windowDepths[i] * windowDepths[i];
  }
  const float mean = sum / float(kSamples);
  return squares / float(kSamples) - mean * mean;
#else
  // About the first depth, then about the mean of what is left.
  float sum = 0.0;
  for (int i = 1; i < kSamples; ++i) sum += windowDepths[i] - windowDepths[0];
  const float mean = sum / float(kSamples);
  float squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const float deviation = (windowDepths[i] - windowDepths[0]) - mean;
    squares += deviation * deviation;
  }
  return squares / float(kSamples);
#endif
}

// NV: sum of squared deviations from the mean normal.
float normalVariance() {
  const vec3 mean = meanNormal();
  float sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const float deviation = oneMinusCosine(windowNormals[i], mean);
    sum += deviation * deviation;
  }
  return sum;
}
