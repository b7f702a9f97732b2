// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/path_recorder.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace limen::viewer {
namespace {

using scene::Camera;
using scene::CameraPath;
using Keys = std::vector<CameraPath::Key>;

/// The deviation in tolerances, the largest of all quantities; at most 1 is within tolerance.
double misfit(const Camera& camera, const Camera& sample, const PathTolerance& tolerance) {
  const double distance = glm::length(sample.target - sample.eye);
  return std::max({glm::length(camera.eye - sample.eye) / (tolerance.position * distance),
                   glm::length(camera.target - sample.target) / (tolerance.position * distance),
                   glm::length(camera.up - sample.up) / (tolerance.up * glm::length(sample.up)),
                   std::abs(camera.verticalFovDeg - sample.verticalFovDeg) / tolerance.fovDeg});
}

/// Chooses samples as keys.
class Reduction {
 public:
  Reduction(const Keys& samples, const PathTolerance& tolerance) : samples_(samples), tolerance_(tolerance) {}

  CameraPath run() {
    chosen_ = {0, samples_.size() - 1};
    while (refine()) {
    }
    dropRedundant();
    return pathOf(chosen_);
  }

 private:
  CameraPath pathOf(const std::vector<size_t>& chosen) const {
    CameraPath path;
    for (const size_t index : chosen) path.keys.push_back(samples_[index]);
    return path;
  }

  /// The worst-fitting sample strictly between two, if any is outside the tolerance.
  std::optional<size_t> worstBetween(const CameraPath& path, size_t from, size_t to) const {
    std::optional<size_t> worst;
    double most = 1.0;
    for (size_t i = from + 1; i < to; ++i) {
      const double off = misfit(path.at(samples_[i].timeS), samples_[i].camera, tolerance_);
      // Negated so that NaN counts as outside.
      if (!(off <= most)) most = off, worst = i;
    }
    return worst;
  }

  /// Adds the worst sample of each span that is outside; false if none is. Terminates, since a sample that is
  /// a key fits.
  bool refine() {
    const CameraPath path = pathOf(chosen_);
    std::vector<size_t> more;
    for (size_t i = 1; i < chosen_.size(); ++i)
      if (const auto worst = worstBetween(path, chosen_[i - 1], chosen_[i])) more.push_back(*worst);
    const size_t before = chosen_.size();
    chosen_.insert(chosen_.end(), more.begin(), more.end());
    std::inplace_merge(chosen_.begin(), chosen_.begin() + static_cast<long>(before), chosen_.end());
    return !more.empty();
  }

  /// Later keys of the refinement can make earlier ones superfluous.
  void dropRedundant() {
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (size_t i = 1; i + 1 < chosen_.size();)
        if (fitsWithout(i))
          chosen_.erase(chosen_.begin() + static_cast<long>(i)), dropped = true;
        else
          ++i;
    }
  }

  bool fitsWithout(size_t i) const {
    // A key determines the velocities of its neighbours, and these the spans on their far sides; spans
    // further away stay the same, though their velocities need one more key on either side.
    const size_t first = i < 4 ? 0 : i - 4, last = std::min(i + 4, chosen_.size() - 1);
    std::vector<size_t> near;
    for (size_t k = first; k <= last; ++k)
      if (k != i) near.push_back(chosen_[k]);
    const CameraPath path = pathOf(near);
    return !worstBetween(path, chosen_[i < 2 ? 0 : i - 2], chosen_[std::min(i + 2, chosen_.size() - 1)]);
  }

  const Keys& samples_;
  const PathTolerance& tolerance_;
  std::vector<size_t> chosen_;
};

}  // namespace

bool isWithin(const Camera& camera, const Camera& sample, const PathTolerance& tolerance) {
  return misfit(camera, sample, tolerance) <= 1.0;
}

CameraPath reducedPath(const Keys& samples, const PathTolerance& tolerance) {
  if (samples.size() < 3) return {samples};
  return Reduction(samples, tolerance).run();
}

void PathRecorder::add(double timeS, const Camera& camera) {
  if (!std::isfinite(timeS)) return;
  if (!samples_.empty() && !(timeS > last_.timeS)) return;
  last_ = {timeS, camera};
  if (samples_.empty() || timeS - samples_.back().timeS >= intervalS_ * (1.0 - 1e-9))
    samples_.push_back(last_);
}

Keys PathRecorder::samples() const {
  Keys out = samples_;
  if (!out.empty() && last_.timeS > out.back().timeS) out.push_back(last_);
  for (size_t i = out.size(); i-- > 0;) out[i].timeS -= out[0].timeS;
  return out;
}

}  // namespace limen::viewer
