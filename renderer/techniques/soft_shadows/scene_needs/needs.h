// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "renderer/techniques/soft_shadows/scene_needs/candidate_clock.h"
#include "renderer/techniques/soft_shadows/scene_needs/decision.h"
#include "renderer/techniques/soft_shadows/scene_needs/target.h"

namespace limen::techniques {

/// The references that candidates are compared with.
struct NeedsReference {
  int samples = 256;      ///< rays per receiver of each of two references, in the small picture
  int checkSamples = 64;  ///< the same, in the check at full size
  static const SettingsTable<NeedsReference>& table();
};

struct NeedsOptions {
  NeedsTarget target = {};
  /// About as many pixels has the small picture, but no more than the full one. For an RMSE.
  int picturePx = 50000;
  NeedsReference reference = {};
  double seconds = std::numeric_limits<double>::infinity();  ///< after that, no further candidate is tried
};

/// The chosen candidate at full size, rendered, compared and timed anew.
struct FullSizeCheck {
  ErrorEstimate error;
  double referenceNoise = 0.0;
  TimeEstimate time;
  Image errors;  ///< absolute, of each pixel
};

/// What a view of a scene was found to need.
struct SceneNeedsFound {
  std::vector<Tried> tried;
  std::vector<std::string> notTried;  ///< candidate and reason
  Verdict verdict;
  NeedsReference reference;
  double referenceNoise = 0.0;
  glm::ivec2 pictureSizePx{0};
  FullSizeCheck check;
  std::string times;  ///< what they are
  NeedsTarget target;

  const Tried& chosen() const { return tried[verdict.chosen]; }
};

/// Measures the error of each candidate in a small picture of the frame's view and its time at full size,
/// decides, and checks the decision at full size. Waits for the GPU; the frame is not touched.
///
/// The small picture sees every nth point of the full one, and maps keep their resolution: what a candidate
/// finds for a point depends neither on the picture's size nor on neighbours, so that the error over these
/// points estimates that over all points. (With maps reduced along with the picture it would not: the error
/// grows with a texel's width. Level smoothing and budget maps do look at neighbours; no built-in candidate
/// has either.)
///
/// What is seen of an error does depend on the picture's size and on neighbours: for a target in JND there is
/// no small picture, candidates are compared at full size.
///
/// Throws Error if no candidate can be tried.
SceneNeedsFound findNeeds(frame::Frame& frame, std::span<const Candidate> candidates,
                          const NeedsOptions& options, CandidateClock& clock);

}  // namespace limen::techniques
