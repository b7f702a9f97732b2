// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/pass_list.h"

#include <epoxy/gl.h>

#include <cassert>
#include <stdexcept>

namespace limen::gl {

PassList::~PassList() {
  if (!queries_.empty()) glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

PassList::Scope::Scope(PassList& list, size_t index) : list_(list), index_(index) {
  list_.mark(index_, true);
}
PassList::Scope::~Scope() { list_.mark(index_, false); }

size_t PassList::indexOf(const std::string& name) {
  for (size_t i = 0; i < passes_.size(); ++i)
    if (passes_[i].name == name) return i;
  passes_.push_back({name, 0, false});
  return passes_.size() - 1;
}

PassList::Scope PassList::open(const std::string& name) {
  const size_t index = indexOf(prefix_ + name);
  // The last slot is the frame's own; a pass added after recording began has none.
  if (clock_ != Clock::None && frame_ < capacity_ && index + 1 >= slots_)
    throw std::logic_error("pass '" + name + "' ran for the first time in a timed frame");
  passes_[index].ran = true;
  return {*this, index};
}

void PassList::setBytesHeld(const std::string& name, int64_t bytes) {
  passes_[indexOf(prefix_ + name)].bytesHeld = bytes;
}

void PassList::mark(size_t slot, bool begin) {
  if (clock_ == Clock::None || frame_ < 0 || frame_ >= capacity_) return;
  const bool wholeFrame = slot + 1 == slots_;
  if (what_ == (wholeFrame ? Recorded::Passes : Recorded::Frames)) return;
  const size_t index = (static_cast<size_t>(frame_) * slots_ + slot) * 2 + (begin ? 0 : 1);
  used_[index / 2] = 1;
  if (clock_ == Clock::Gpu) {
    glQueryCounter(queries_[index], GL_TIMESTAMP);
  } else {
    glFinish();
    marks_[index] = HostClock::now();
  }
}

void PassList::beginFrame() {
  for (Pass& pass : passes_) pass.ran = false;
  if (clock_ == Clock::None) return;
  ++frame_;
  mark(slots_ - 1, true);
}

void PassList::endFrame() { mark(slots_ - 1, false); }

void PassList::startRecording(Clock clock, int frames, Recorded what) {
  clock_ = clock;
  what_ = what;
  frame_ = -1;
  capacity_ = frames;
  slots_ = passes_.size() + 1;
  const size_t marks = static_cast<size_t>(frames) * slots_ * 2;
  used_.assign(marks / 2, 0);
  if (clock == Clock::Gpu && queries_.size() < marks) {
    const size_t old = queries_.size();
    queries_.resize(marks);
    glCreateQueries(GL_TIMESTAMP, static_cast<GLsizei>(marks - old), queries_.data() + old);
  }
  if (clock == Clock::Wall) marks_.assign(marks, {});
}

std::vector<PassTime> PassList::finishRecording() {
  glFinish();
  std::vector<PassTime> times;
  for (int frame = 0; frame <= frame_ && frame < capacity_; ++frame)
    for (size_t slot = 0; slot < slots_; ++slot) {
      const size_t index = (static_cast<size_t>(frame) * slots_ + slot) * 2;
      if (!used_[index / 2]) continue;
      int64_t nanoseconds = 0;
      if (clock_ == Clock::Gpu) {
        GLuint64 begin = 0, end = 0;
        glGetQueryObjectui64v(queries_[index], GL_QUERY_RESULT, &begin);
        glGetQueryObjectui64v(queries_[index + 1], GL_QUERY_RESULT, &end);
        nanoseconds = static_cast<int64_t>(end - begin);
      } else {
        nanoseconds =
            std::chrono::duration_cast<std::chrono::nanoseconds>(marks_[index + 1] - marks_[index]).count();
      }
      times.push_back({frame, slot + 1 == slots_ ? "frame" : passes_[slot].name, nanoseconds});
    }
  clock_ = Clock::None;
  frame_ = -1;
  return times;
}

}  // namespace limen::gl
