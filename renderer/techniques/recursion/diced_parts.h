// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/surfaces/tessellated_surface.h"
#include "renderer/techniques/recursion/part_settings.h"
#include "renderer/techniques/recursion/recursion_bindings.h"
#include "renderer/techniques/tessellation/surface_vertex_array.h"
#include "renderer/techniques/tessellation/patch_buffers.h"
#include "renderer/techniques/tessellation/surface_picture.h"

namespace limen::techniques {

/// A recursion's finished parts as grids of triangles. What is dispatched and drawn comes from its counters
/// (RecursionCounters), which the host does not read.
class DicedParts {
 public:
  /// Holds as many parts as have settings.capacity vertices, one for each patch at least.
  DicedParts(frame::Frame& frame, const PatchBuffers& patches, const PartSettings& settings);
  uint32_t partCapacity() const { return capacity_; }

  /// Between rounds: what comes next is dispatched over the parts that were queued; at last, over those that
  /// are finished.
  void advance(const gl::Buffer& counters) const;
  /// The picture of the parts.
  void render(frame::Frame& frame, const gl::Buffer& parts, const gl::Buffer& counters);
  const gl::Texture& picture() const { return picture_.texture(); }
  std::shared_ptr<surfaces::TessellatedSurface> surface(frame::Frame& frame, const gl::Buffer& parts,
                                                        const gl::Buffer& counters) const;

 private:
  void dice(frame::Frame& frame, const gl::Buffer& parts, const gl::Buffer& counters) const;

  const PatchBuffers& patches_;
  int grid_;
  bool lists_;  ///< rasterised in compute
  SurfacePicture picture_;
  uint32_t capacity_;
  const gl::Program *roundsProgram_, *diceProgram_, *drawProgram_;
  gl::Buffer listed_;
  std::optional<gl::Buffer> vertices_, indices_;
  std::optional<SurfaceVertexArray> array_;
};

/// Refuses scenes with patches that are not of degree 3.
void requireCubic(const surfaces::PatchSet& set);
/// All patches as parts to begin with.
std::vector<RecursionPart> wholePatches(const surfaces::PatchSet& set);

}  // namespace limen::techniques
