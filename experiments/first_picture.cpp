// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/first_picture.h"

#include <epoxy/gl.h>

#include <chrono>

#include "renderer/frame/frame.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {
namespace {

using std::chrono::steady_clock;

double msSince(steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(steady_clock::now() - start).count();
}

/// Makes a context current when it goes out of scope.
class BackTo {
 public:
  explicit BackTo(gl::Context& context) : context_(context) {}
  ~BackTo() { context_.makeCurrent(); }
  BackTo(const BackTo&) = delete;
  BackTo& operator=(const BackTo&) = delete;

 private:
  gl::Context& context_;
};

}  // namespace

FirstPicture timeFirstPicture(gl::Context& current, const scene::Scene& scene, glm::ivec2 sizePx,
                              const Configuration& technique) {
  const BackTo back(current);
  const std::unique_ptr<gl::Context> fresh = gl::createHeadlessContext();
  const auto made = techniques::TechniqueRegistry::instance().get(technique.name).make(technique.values);
  glFinish();
  FirstPicture out;
  const auto start = steady_clock::now();
  const frame::GpuScene gpuScene(scene);
  glFinish();
  out.uploadMs = msSince(start);
  frame::Frame frame(*fresh, scene, gpuScene, sizePx);
  made->prepare(frame);
  frame.begin();
  made->render(frame);
  frame.end();
  glFinish();
  out.allMs = msSince(start);
  out.compileMs = fresh->programs().compileMs();
  fresh->checkDebugMessages();
  return out;
}

}  // namespace limen::experiments
