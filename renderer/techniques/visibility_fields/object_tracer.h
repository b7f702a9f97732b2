// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/ray_tracing/triangle_grid.h"
#include "renderer/techniques/visibility_fields/receiver_rays.h"
#include "renderer/techniques/visibility_fields/traced_triangles.h"

namespace limen::techniques {

/// How rays find triangles.
struct TreeTracer {
  static constexpr const char *kKind = "tree", *kSummary = "through a wide hierarchy of bounding boxes";
  static const SettingsTable<TreeTracer>& table();
};
struct GridTracer {
  static constexpr const char *kKind = "grid", *kSummary = "through the cells of a uniform grid";
  double density = 4.0;
  static const SettingsTable<GridTracer>& table();
};
using TracerSetting = std::variant<TreeTracer, GridTracer>;
template <class S>
Binding<S> tracerBinding(TracerSetting S::*member) {
  return {member, "tracer", "How rays find triangles",
          "Gaitatzes 2012, sections 4.7.1 (grid) and 4.7.2 (tree)"};
}

/// The objects' triangles for shaders that include object_trace.glsl.
class ObjectTracer {
 public:
  void prepare(frame::Frame& frame, const ReceiverRays& rays, const TracerSetting& tracer);
  static gl::ShaderDefines defines(const TracerSetting& tracer);
  /// Where parts move, builds the tree anew from where vertices are, whatever poses fields are placed in.
  /// Before a pass is opened, in each frame.
  void update(frame::Frame& frame);
  void bind(const gl::Program& program) const;
  int64_t bytesHeld() const { return (tree_ ? tree_->bytes() : grid_->bytes()) + objectOf_->bytes(); }
  /// Dispatches `program` over the frame for all rows of the rays' cells: at once, or one by one on a
  /// software renderer, which limits the steps of an invocation.
  static void dispatchRows(const gl::Program& program, frame::Frame& frame, int rows);

 private:
  std::optional<TracedTriangles> tree_;
  std::optional<ray_tracing::TriangleGrid> grid_;  ///< in place of `tree_`
  std::optional<gl::Buffer> objectOf_;
};

/// Over the triangles of all objects.
TracedTriangles treeOfObjects(frame::Frame& frame, const ReceiverRays& rays);

/// Over the triangles that belong to no object.
TracedTriangles treeWithoutObjects(frame::Frame& frame, const ReceiverRays& rays);

}  // namespace limen::techniques
