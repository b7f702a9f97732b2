// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/needs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/techniques/scene_needs/jnd_error.h"

namespace limen::techniques {
namespace {

using std::chrono::steady_clock;

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
    frame.setShownMirrors(like_.shownMirrors());
    technique->prepare(frame);
    frame.begin();
    technique->render(frame);
    frame.end();
    return technique->product().read();
  }

  /// Seeds differ in all pairs, so that no two comparisons share their noise.
  ReferencePair references(const NeedsSubject& subject, int samples, int64_t firstSeed) const {
    const auto sampled = [&](int64_t seed) { return render(subject.reference(samples, seed)); };
    ReferencePair out{sampled(firstSeed), {}, {}};
    out.second = subject.exact ? out.first : sampled(firstSeed + 1);
    frame::Frame frame = frameOf();
    frame.setShownMirrors(like_.shownMirrors());
    frame.begin();
    out.mask = subject.mask(frame);
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

/// Where and against what candidates are compared.
struct ComparedAt {
  glm::ivec2 sizePx{0};
  int samples = 0;
  int64_t firstSeed = 1;
};

/// What a search has tried so far.
struct Trials {
  std::vector<Tried> tried;
  std::vector<std::string> notTried;
  double referenceNoise = 0.0;
};

class Search {
 public:
  Search(frame::Frame& frame, const NeedsSubject& subject, const NeedsOptions& options, CandidateClock& clock,
         Trials& out)
      : frame_(frame), subject_(subject), options_(options), clock_(clock), out_(out) {}

  /// Errors and times, then second times of those that decide, backwards, so that a drifting clock rate
  /// affects all alike.
  void run(std::span<const Candidate> candidates, const ComparedAt& at) {
    const auto* jnd = std::get_if<JndTarget>(&options_.target);
    const Renderings renderings(frame_, at.sizePx);
    const ReferencePair truth = renderings.references(subject_, at.samples, at.firstSeed);
    std::optional<JndErrors> visible;
    if (jnd) visible.emplace(frame_, *jnd, truth, subject_.depicts);
    out_.referenceNoise = visible ? visible->noise() : truth.noise();
    const auto errorOf = [&](const Image& product) {
      return visible ? visible->estimate(product) : estimateError(product, truth);
    };
    for (const Candidate& candidate : candidates) {
      std::string obstacle = late() ? "no time was left" : obstacleTo(candidate, frame_.scene());
      try {
        if (obstacle.empty()) measure(candidate, renderings, errorOf);
      } catch (const Error& error) {
        obstacle = error.message();
      }
      if (!obstacle.empty()) out_.notTried.push_back(describe(candidate) + ": " + obstacle);
    }
    if (out_.tried.empty())
      throw Error("no candidate can be tried with this scene",
                  out_.notTried.empty() ? "" : out_.notTried.front(), "give others");
    timeAgain();
  }

 private:
  bool late() const {
    const std::chrono::duration<double> passed = steady_clock::now() - start_;
    return !out_.tried.empty() && passed.count() > options_.seconds;
  }

  template <class ErrorOf>
  void measure(const Candidate& candidate, const Renderings& renderings, const ErrorOf& errorOf) {
    const ErrorEstimate error = errorOf(renderings.render(candidate));
    framesMs_.push_back(clock_.framesMs(candidate));
    out_.tried.push_back({candidate, error, estimateTime(framesMs_.back())});
  }

  void timeAgain() {
    std::vector<Tried>& tried = out_.tried;
    const std::vector<size_t> deciding = eligible(tried, largestOf(options_.target));
    double cheapestMs = tried[deciding.front()].time.medianMs;
    for (const size_t i : deciding) cheapestMs = std::min(cheapestMs, tried[i].time.medianMs);
    for (auto i = deciding.rbegin(); i != deciding.rend() && !late(); ++i) {
      if (tried[*i].time.medianMs > kWorthASecondRound * cheapestMs) continue;
      const std::vector<double> more = clock_.framesMs(tried[*i].candidate);
      framesMs_[*i].insert(framesMs_[*i].end(), more.begin(), more.end());
      tried[*i].time = estimateTime(framesMs_[*i]);
    }
  }

  frame::Frame& frame_;
  const NeedsSubject& subject_;
  const NeedsOptions& options_;
  CandidateClock& clock_;
  Trials& out_;
  std::vector<std::vector<double>> framesMs_;  ///< of each in `tried`
  steady_clock::time_point start_ = steady_clock::now();
};

constexpr int64_t kCheckSeed = 3;  ///< other references than those of the choice

}  // namespace

FullSizeCheck checkAtFullSize(frame::Frame& frame, const Candidate& candidate, const NeedsSubject& subject,
                              const NeedsOptions& options, CandidateClock& clock) {
  const Renderings full(frame, frame.sizePx());
  const ReferencePair truth = full.references(subject, options.reference.checkSamples, kCheckSeed);
  const Image product = full.render(candidate);
  if (const auto* jnd = std::get_if<JndTarget>(&options.target)) {
    JndErrors visible(frame, *jnd, truth, subject.depicts);
    return {visible.estimate(product), visible.noise(), estimateTime(clock.framesMs(candidate)),
            errorMap(product, truth)};
  }
  return {estimateError(product, truth), truth.noise(), estimateTime(clock.framesMs(candidate)),
          errorMap(product, truth)};
}

WholeSetCheck checkWholeSet(frame::Frame& frame, const Candidate& choice,
                            std::span<const Candidate> candidates, const NeedsSubject& subject,
                            const NeedsOptions& options, CandidateClock& clock) {
  const std::string name = describe(choice);
  std::vector<Candidate> all = {choice};
  for (const Candidate& candidate : candidates)
    if (describe(candidate) != name) all.push_back(candidate);
  Trials trials;
  Search(frame, subject, options, clock, trials)
      .run(all, {frame.sizePx(), options.reference.checkSamples, kCheckSeed});
  if (describe(trials.tried.front().candidate) != name)
    throw Error("what was chosen cannot be rendered: " + trials.notTried.front());
  WholeSetCheck out;
  out.tried = std::move(trials.tried);
  out.notTried = std::move(trials.notTried);
  out.best = decide(out.tried, largestOf(options.target));
  return out;
}

const SettingsTable<NeedsReference>& NeedsReference::table() {
  using S = NeedsReference;
  static const SettingsTable<S> kTable = {
      {&S::samples, "samples", oneOf({16, 64, 256, 1024, 4096}), "rays",
       "Rays of each pixel in each of two references, in the small picture"},
      {&S::checkSamples, "check_samples", oneOf({16, 64, 256, 1024, 4096}), "rays",
       "The same in the check at full size"}};
  return kTable;
}

SceneNeedsFound findNeeds(frame::Frame& frame, std::span<const Candidate> candidates,
                          const NeedsSubject& subject, const NeedsOptions& options, CandidateClock& clock) {
  SceneNeedsFound out;
  out.times = clock.label();
  out.reference = options.reference;
  out.target = options.target;
  if (!subject.exact) out.samples = subject.samples;
  out.pictureSizePx = isJnd(options.target) ? frame.sizePx() : smallSize(frame.sizePx(), options.picturePx);
  Trials trials;
  Search(frame, subject, options, clock, trials)
      .run(candidates, {out.pictureSizePx, options.reference.samples, 1});
  out.tried = std::move(trials.tried);
  out.notTried = std::move(trials.notTried);
  out.referenceNoise = trials.referenceNoise;
  out.verdict = decide(out.tried, largestOf(options.target));
  out.check = checkAtFullSize(frame, out.chosen().candidate, subject, options, clock);
  return out;
}

}  // namespace limen::techniques
