// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/ray_tracing/ray_tree.h"
#include "renderer/ray_tracing/rebuilt_tree.h"
#include "renderer/techniques/visibility_fields/receiver_rays.h"

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
  int64_t bytesHeld() const {
    return rays_->bytes() + objectOf_->bytes() + (indices_ ? indices_->bytes() : 0);
  }
  /// Dispatches `program` over the frame for all rows of the rays' cells: at once, or one by one on a
  /// software renderer, which limits the steps of an invocation.
  static void dispatchRows(const gl::Program& program, frame::Frame& frame, int rows);

 private:
  std::unique_ptr<ray_tracing::RayTree> rays_;
  const ray_tracing::RebuiltTree* rebuilt_ = nullptr;  ///< `rays_`, if parts move
  std::optional<gl::Buffer> indices_;                  ///< of the objects' triangles, for it
  std::optional<gl::Buffer> objectOf_;
};

/// The triangles of all objects where they rest, numbered as in the scene.
ray_tracing::RayScene raysOfObjects(frame::Frame& frame, const ReceiverRays& rays);

/// The triangles that belong to no object, numbered as in the scene.
ray_tracing::RayScene raysWithoutObjects(frame::Frame& frame, const ReceiverRays& rays);

}  // namespace limen::techniques
