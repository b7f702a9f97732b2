// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/raster_queue.h"

#include <epoxy/gl.h>

#include <array>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

/// Where the device cannot start a group for each band of a full queue.
constexpr int kFixedGroups = 4096;

bool startsAnyNumber() {
  GLint most = 0;
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &most);
  return most >= 1 << 30;  // the count may pass the capacity: what has no room is rasterised on the spot
}

}  // namespace

RasterQueue::RasterQueue(int capacity)
    : buffer_(int64_t{sizeof(RasterQueueHeader)} + int64_t{capacity} * 8, nullptr),
      indirect_(startsAnyNumber()) {
  buffer_.clearUint(0);
  const RasterQueueHeader empty = {0, 1, 1, 0};
  buffer_.write(0, sizeof(empty), &empty);
}

void RasterQueue::dispatch(const gl::Program& program) const {
  if (!indirect_) {
    program.dispatch({kFixedGroups, 1}, {1, 1});
    return;
  }
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer_.id());
  glDispatchComputeIndirect(offsetof(RasterQueueHeader, queued));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

}  // namespace limen::frame
