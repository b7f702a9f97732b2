// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/frame_stopwatch.h"

#include <epoxy/gl.h>

namespace limen::techniques {

FrameStopwatch::FrameStopwatch(bool software) : software_(software) {
  arrived_.reserve(kUnderWay);
  collected_.reserve(kUnderWay);
  if (software_) return;
  for (Slot& slot : slots_)
    glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(slot.queries.size()), slot.queries.data());
}

FrameStopwatch::~FrameStopwatch() {
  if (software_) return;
  for (const Slot& slot : slots_)
    glDeleteQueries(static_cast<GLsizei>(slot.queries.size()), slot.queries.data());
}

void FrameStopwatch::start(double tag) {
  if (software_) {
    glFinish();
    wallTag_ = tag;
    begun_ = std::chrono::steady_clock::now();
    running_ = true;
    return;
  }
  running_ = next_ - oldest_ < kUnderWay;
  if (!running_) return;
  Slot& slot = slots_[next_ % kUnderWay];
  slot.tag = tag;
  glQueryCounter(slot.queries[0], GL_TIMESTAMP);
}

void FrameStopwatch::stop() {
  if (!running_) return;
  running_ = false;
  if (software_) {
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun_;
    if (arrived_.size() == kUnderWay) arrived_.erase(arrived_.begin());
    arrived_.push_back({wallTag_, took.count()});
    return;
  }
  glQueryCounter(slots_[next_ % kUnderWay].queries[1], GL_TIMESTAMP);
  ++next_;
}

const std::vector<FrameStopwatch::Sample>& FrameStopwatch::collect() {
  collected_.clear();
  std::swap(arrived_, collected_);
  for (; oldest_ < next_; ++oldest_) {
    const Slot& slot = slots_[oldest_ % kUnderWay];
    GLint arrived = 0;
    glGetQueryObjectiv(slot.queries[1], GL_QUERY_RESULT_AVAILABLE, &arrived);
    if (!arrived) break;
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(slot.queries[0], GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(slot.queries[1], GL_QUERY_RESULT, &end);
    collected_.push_back({slot.tag, 1e-6 * static_cast<double>(end - begin)});
  }
  return collected_;
}

}  // namespace limen::techniques
