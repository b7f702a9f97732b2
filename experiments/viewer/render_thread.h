// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "experiments/base/image.h"
#include "experiments/scene_rendering.h"
#include "experiments/viewer/live_technique.h"
#include "experiments/viewer/mailbox.h"
#include "experiments/viewer/presenter.h"
#include "experiments/viewer/setup.h"
#include "renderer/gl/context.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {

/// What the render thread is to show.
struct RenderRequest {
  uint64_t number = 0;  ///< returned with the result
  ViewSetup setup;
  std::string view;                    ///< debug view in place of the first product; "": the product
  std::optional<glm::ivec2> pickedPx;  ///< pixel whose values are wanted
  bool moving = false;      ///< a control is held or the camera moves: settled frames would only delay it
  bool continuous = false;  ///< render continuously, to show times
};

/// Values of one image at the picked pixel.
struct PickedValues {
  std::string name;
  std::vector<double> values;
};

/// The output of one technique.
struct Rendered {
  std::string error;    ///< why there is no picture, "" if there is one
  std::string failure;  ///< what is wrong with the picture shown
  std::shared_ptr<const ScreenPicture> picture;
  techniques::ProductKind kind = techniques::ProductKind::Visibility;
  std::vector<PassFigure> passes;
  double frameMs = -1.0;           ///< < 0: not timed yet
  bool onCpu = false;              ///< timed with the host's clock
  std::vector<std::string> views;  ///< names of debug views
  double viewWhite = 0.0;          ///< value of the brightest colour if a debug view of values is shown

  // Settled frames only: from a newly made technique, as in a sweep.
  std::shared_ptr<const Image> product;
  std::string productHash;  ///< see experiments/product.h
  int64_t nonFinite = 0;
  double prepareMs = -1.0;
  std::vector<techniques::Counter> counters;
  std::vector<std::string> remarks;
  std::vector<PickedValues> picked;  ///< of the product, debug views and, for the first, the G-buffer
};

struct RenderResult {
  uint64_t number = 0;
  ViewSetup setup;  ///< what was rendered
  bool settled = false;
  std::string error;               ///< of the scene
  std::vector<Rendered> rendered;  ///< one or two; none if the scene is in error
  std::set<std::string> traits;
  scene::CameraPath path;  ///< of the camera, whatever the chosen time
  scene::Camera camera;
  scene::Bounds bounds;
  size_t triangles = 0;
  std::shared_ptr<const experiments::ViewImages> view;  ///< settled frames only
};

/// Shaders reloaded since the previous report.
struct ShaderNews {
  std::vector<std::string> rebuilt;
  std::vector<std::string>
      failures;  ///< the driver's messages, with file and line; the previous program stays in use
};

/// Renders the newest request in an OpenGL context of its own, created as in a sweep, so that what is seen is
/// what a sweep measures, and nothing it does blocks the window. After the last request it renders once more
/// with newly made techniques (settled), reads product and counters, and idles.
class RenderThread {
 public:
  /// `wake` is called from the thread when there is a result or a reload. `shaderRoot`: source tree whose
  /// shaders are read instead of the program's own and watched for changes; "": none.
  RenderThread(std::function<void()> wake, const std::string& shaderRoot);
  ~RenderThread();
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  void ask(RenderRequest request) { requests_.put(std::move(request)); }
  std::optional<RenderResult> take() { return results_.take(); }
  std::optional<ShaderNews> takeNews() { return news_.take(); }
  /// Of the context; waits until there is one. Throws Error if it cannot be created.
  gl::DeviceInfo device() const { return device_.get(); }
  /// Asks the thread to end: work that checks cancelToken() (experiments/base/cancel.h) returns early.
  void close();
  /// Whether it has ended; waits for that until `end`.
  bool waitUntil(std::chrono::steady_clock::time_point end) const {
    return ended_.wait_until(end) == std::future_status::ready;
  }
  /// Frames rendered so far.
  int64_t frames() const { return frames_; }

 private:
  class Work;
  void run(const std::function<void()>& wake, const std::string& shaderRoot);

  Mailbox<RenderRequest> requests_;
  Mailbox<RenderResult> results_;
  Mailbox<ShaderNews> news_;
  std::promise<gl::DeviceInfo> deviceMade_;
  std::shared_future<gl::DeviceInfo> device_;
  std::atomic<int64_t> frames_ = 0;
  std::stop_source cancel_;
  std::promise<void> end_;
  std::future<void> ended_ = end_.get_future();
  std::jthread thread_;  // last: it uses the others
};

}  // namespace limen::viewer
