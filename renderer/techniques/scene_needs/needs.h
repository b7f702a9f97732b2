// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "perception/metrics/metric.h"
#include "renderer/techniques/scene_needs/candidate_clock.h"
#include "renderer/techniques/scene_needs/decision.h"
#include "renderer/techniques/scene_needs/target.h"

namespace limen::techniques {

/// What candidates are compared with, and where.
struct NeedsSubject {
  /// The reference with this many samples of this seed; two of different seeds share no noise.
  std::function<Candidate(int samples, int64_t seed)> reference;
  bool exact = false;   ///< the reference takes no samples: `samples` and `seed` are ignored
  std::string samples;  ///< what they are: "rays per receiver"
  /// 1 channel, above 0 where products are compared. Called within a frame.
  std::function<Image(frame::Frame&)> mask;
  perception::Depicts depicts = perception::Depicts::Light;  ///< the product, to a viewer
};

/// The references that candidates are compared with.
struct NeedsReference {
  int samples = 256;      ///< of each of two references, in the small picture; see NeedsSubject
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

/// All candidates as the check has them: compared and timed at full size.
struct WholeSetCheck {
  std::vector<Tried> tried;  ///< the choice among them
  std::vector<std::string> notTried;
  size_t choice = 0;  ///< of `tried`
  Verdict best;       ///< what full size would have chosen

  /// What the choice takes and errs more than the best; below 0: less. [ms], and in the target's unit.
  double regretMs() const { return tried[choice].time.medianMs - tried[best.chosen].time.medianMs; }
  double regretError() const { return tried[choice].error.value() - tried[best.chosen].error.value(); }
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
  std::optional<WholeSetCheck> wholeSet;
  std::string samples;  ///< as in NeedsSubject; "": the reference is exact
  std::string times;    ///< what they are
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
                          const NeedsSubject& subject, const NeedsOptions& options, CandidateClock& clock);

/// Compares one candidate with the references at full size and times it.
FullSizeCheck checkAtFullSize(frame::Frame& frame, const Candidate& candidate, const NeedsSubject& subject,
                              const NeedsOptions& options, CandidateClock& clock);
/// Compares and times `choice` and all candidates at full size. Throws Error if `choice` cannot be tried.
WholeSetCheck checkWholeSet(frame::Frame& frame, const Candidate& choice,
                            std::span<const Candidate> candidates, const NeedsSubject& subject,
                            const NeedsOptions& options, CandidateClock& clock);

}  // namespace limen::techniques
