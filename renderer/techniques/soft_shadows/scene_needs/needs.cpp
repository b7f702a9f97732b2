// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/scene_needs/needs.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"

namespace limen::techniques {
namespace {

/// Candidates that take longer than this many times the cheapest eligible one are timed once only.
constexpr double kWorthASecondRound = 2.0;

glm::ivec2 smallSize(glm::ivec2 fullPx, int picturePx) {
  const double scale = std::min(std::sqrt(picturePx / (double(fullPx.x) * fullPx.y)), 1.0);
  return glm::max(glm::ivec2(glm::round(glm::dvec2(fullPx) * scale)), glm::ivec2(1));
}

/// Renders single frames of a frame's view, in a size of their own.
class Renderings {
 public:
  Renderings(frame::Frame& like, glm::ivec2 sizePx) : like_(like), sizePx_(sizePx) {}

  Image render(const Candidate& candidate) const {
    const std::unique_ptr<Technique> technique = makeTechnique(candidate);
    frame::Frame frame = frameOf();
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    return technique->product().read();
  }

  /// Seeds differ in all pairs, so that no two comparisons share their noise.
  ReferencePair references(int samples, int64_t firstSeed) const {
    const auto traced = [&](int64_t seed) {
      return render({"soft_shadows/ray_traced", {{"samples", int64_t{samples}}, {"seed", seed}}});
    };
    ReferencePair out{traced(firstSeed), traced(firstSeed + 1), {}};
    frame::Frame frame = frameOf();
    frame.begin();
    out.receivers = frame.get<frame::Receivers>().texture().read();
    frame.end();
    return out;
  }

 private:
  frame::Frame frameOf() const {
    return {like_.context(), like_.scene(), like_.gpuScene(), sizePx_, like_.timeS(), like_.raster()};
  }

  frame::Frame& like_;
  glm::ivec2 sizePx_;
};

void measureErrors(frame::Frame& frame, std::span<const Candidate> candidates, const NeedsOptions& options,
                   SceneNeedsFound& out) {
  out.pictureSizePx = smallSize(frame.sizePx(), options.picturePx);
  const Renderings small(frame, out.pictureSizePx);
  const ReferencePair truth = small.references(options.reference.samples, 1);
  out.referenceNoise = truth.noise();
  for (const Candidate& candidate : candidates) {
    std::string obstacle = obstacleTo(candidate, frame.scene());
    try {
      if (obstacle.empty())
        out.tried.push_back({candidate, estimateError(small.render(candidate), truth), {}});
    } catch (const Error& error) {
      obstacle = error.message();
    }
    if (!obstacle.empty()) out.notTried.push_back(describe(candidate) + ": " + obstacle);
  }
  if (out.tried.empty())
    throw Error("no candidate can be tried with this scene", out.notTried.empty() ? "" : out.notTried.front(),
                "give others");
}

/// In two rounds, the second backwards, so that a drifting clock rate affects all alike.
void measureTimes(CandidateClock& clock, double targetRmse, std::vector<Tried>& tried) {
  std::vector<std::vector<double>> frames(tried.size());
  const auto time = [&](size_t i) {
    const std::vector<double> more = clock.framesMs(tried[i].candidate);
    frames[i].insert(frames[i].end(), more.begin(), more.end());
    tried[i].time = estimateTime(frames[i]);
  };
  for (size_t i = 0; i < tried.size(); ++i) time(i);
  std::vector<size_t> again = eligible(tried, targetRmse);
  const auto ms = [&](size_t i) { return tried[i].time.medianMs; };
  const double cheapest =
      ms(*std::min_element(again.begin(), again.end(), [&](size_t a, size_t b) { return ms(a) < ms(b); }));
  for (auto i = again.rbegin(); i != again.rend(); ++i)
    if (ms(*i) <= kWorthASecondRound * cheapest) time(*i);
}

FullSizeCheck checkAtFullSize(frame::Frame& frame, const Candidate& chosen, const NeedsReference& reference,
                              CandidateClock& clock) {
  const Renderings full(frame, frame.sizePx());
  const ReferencePair truth = full.references(reference.checkSamples, 3);
  const Image product = full.render(chosen);
  return {estimateError(product, truth), truth.noise(), estimateTime(clock.framesMs(chosen)),
          errorMap(product, truth)};
}

}  // namespace

const SettingsTable<NeedsReference>& NeedsReference::table() {
  using S = NeedsReference;
  static const SettingsTable<S> kTable = {
      {&S::samples, "samples", oneOf({16, 64, 256, 1024, 4096}), "rays",
       "Shadow rays per receiver of each of two references, in the small picture"},
      {&S::checkSamples, "check_samples", oneOf({16, 64, 256, 1024, 4096}), "rays",
       "The same in the check at full size"}};
  return kTable;
}

SceneNeedsFound findNeeds(frame::Frame& frame, std::span<const Candidate> candidates,
                          const NeedsOptions& options, CandidateClock& clock) {
  SceneNeedsFound out;
  out.times = clock.label();
  out.reference = options.reference;
  measureErrors(frame, candidates, options, out);
  measureTimes(clock, options.targetRmse, out.tried);
  out.verdict = decide(out.tried, options.targetRmse);
  out.check = checkAtFullSize(frame, out.chosen().candidate, options.reference, clock);
  return out;
}

}  // namespace limen::techniques
