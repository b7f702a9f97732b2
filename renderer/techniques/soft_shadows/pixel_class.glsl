// SPDX-License-Identifier: BSD-3-Clause
// What became of a pixel: for shaders, and for pixel_class.h, which takes the same lines into C++.
const uint kNotReceiver = 0u;  // no surface that receives shadows
const uint kLit = 1u;          // found to be lit without a look at occluders
const uint kUmbra = 2u;        // found to be in umbra likewise
const uint kProcessed = 3u;    // visibility from occluders
const uint kOutside = 4u;      // looks past the map
const uint kCutShort = 5u;     // needs more loop iterations than the driver grants
const uint kClassCount = 6u;
