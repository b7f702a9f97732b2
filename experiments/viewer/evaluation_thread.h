// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "experiments/base/image.h"
#include "experiments/base/quantity.h"
#include "experiments/scene_rendering.h"
#include "experiments/viewer/mailbox.h"
#include "experiments/viewer/presenter.h"
#include "experiments/viewer/setup.h"
#include "perception/vision/display.h"

namespace limen::viewer {

/// What a person would see, painted over the picture.
enum class Overlay {
  None,
  Thresholds,        ///< luminance increments that the predictor does not see, of the first picture
  SingleThresholds,  ///< the single threshold map of Schwarz 2009, section 9.4, for comparison
  Popping            ///< what is noticed when the second picture, or the reference, is replaced by the first
};

/// Whether an overlay shows thresholds in cd/m2, of either kind.
constexpr bool isThresholds(Overlay overlay) {
  return overlay == Overlay::Thresholds || overlay == Overlay::SingleThresholds;
}

/// Settled products whose error, and its visibility, are wanted.
struct EvaluationRequest {
  uint64_t number = 0;  ///< returned with every result
  ViewSetup setup;
  techniques::ProductKind kind = techniques::ProductKind::Visibility;
  std::shared_ptr<const Image> product, second;  ///< `second`: null, or of the second technique, same kind
  std::shared_ptr<const experiments::ViewImages> view;
  Overlay overlay = Overlay::None;
  perception::DisplayProfile display;  ///< on which it is viewed
};

struct ErrorFigure {
  std::string metric, unit;
  double value = 0.0, second = 0.0;  ///< of the first and the second technique; NaN where there is none
  Direction direction = Direction::LowerIsBetter;
};

/// Where errors lie.
struct ErrorMap {
  std::shared_ptr<const ScreenPicture> picture;
  std::shared_ptr<const Image> values;
  double white = 1.0;    ///< value of the brightest colour
  double largest = 0.0;  ///< finite value
};

struct EvaluationResult {
  uint64_t number = 0;
  std::string step;     ///< "samples 64 of 1024": what the figures are based on so far; "" once complete
  std::string error;    ///< why there are no figures
  double bound = -1.0;  ///< half-width of the 99.9 % interval of a reference's pixel, < 0: exact
  std::vector<ErrorFigure> figures;        ///< the general ones first, then by name
  std::shared_ptr<const Image> reference;  ///< product of the reference
  std::shared_ptr<const ScreenPicture> referencePicture;
  std::map<std::string, ErrorMap> maps, secondMaps;  ///< of either technique, by name
  Overlay overlayKind = Overlay::None;
  std::shared_ptr<const ScreenPicture> overlay;
  std::string overlayNote;  ///< figures of what the overlay shows, or why there is none
};

/// Renders references and compares products with them in its own thread and OpenGL context: however slow a
/// reference is, it delays neither window nor picture. References that can start coarse are refined step by
/// step, and errors are evaluated at every step. Only the newest request counts; work on a reference that is
/// no longer wanted is cancelled if the reference allows it (see experiments/base/cancel.h).
class EvaluationThread {
 public:
  explicit EvaluationThread(std::function<void()> wake);
  ~EvaluationThread();
  EvaluationThread(const EvaluationThread&) = delete;
  EvaluationThread& operator=(const EvaluationThread&) = delete;

  void ask(EvaluationRequest request);
  std::optional<EvaluationResult> take() { return results_.take(); }
  /// Whether there is nothing to do.
  bool idle() const { return idle_ && !requests_.waiting(); }
  /// Asks the thread to end and cancels its work.
  void close();
  /// Whether it has ended; waits for that until `end`.
  bool waitUntil(std::chrono::steady_clock::time_point end) const {
    return ended_.wait_until(end) == std::future_status::ready;
  }
  /// References made so far, coarse steps included.
  int64_t referencesMade() const { return made_; }

 private:
  class Work;
  void run(const std::function<void()>& wake);

  Mailbox<EvaluationRequest> requests_;
  Mailbox<EvaluationResult> results_;
  std::atomic<int64_t> made_ = 0;
  std::atomic<bool> idle_ = true;
  std::mutex guard_;
  std::string asked_;        // identity of the reference that was asked for last
  std::stop_source cancel_;  // of the work on it
  std::promise<void> end_;
  std::future<void> ended_ = end_.get_future();
  std::jthread thread_;  // last: it uses the others
};

}  // namespace limen::viewer
