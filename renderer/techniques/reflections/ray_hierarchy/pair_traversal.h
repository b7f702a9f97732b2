// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/compute/stream_reduction.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/reflections/ray_hierarchy/host_buffers.h"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"
#include "renderer/techniques/reflections/ray_hierarchy/traversal_settings.h"

namespace limen::techniques {

/// Rays of a frame's size as the hierarchy takes them, one a pixel.
struct RayTextures {
  const gl::Texture* origins;     ///< RGBA32F, w > 0: a ray starts here
  const gl::Texture* directions;  ///< RGBA32F; unit, but for rays to a light
  const gl::Texture* from;        ///< R32UI, the triangle that each leaves and cannot meet
};

/// What the hierarchy's leaves are.
enum class HierarchyLeaves {
  Rays,  ///< rays, of each of which the nearest triangle is found
  /// Cones: w of an origin is the radius there, w of a direction the growth of the radius per unit of
  /// distance. Of each node of the last level all triangles that its cones may meet are gathered.
  Cones
};

/// Nearest triangles of rays without a structure over the triangles: a hierarchy over the rays, and all
/// triangles through it, level by level (Roger 2008, sections 3.3 and 3.4).
class PairTraversal {
 public:
  PairTraversal(frame::Frame& frame, const TraversalSettings& settings, bool shadows,
                HierarchyLeaves leaves = HierarchyLeaves::Rays);

  /// Once a frame, before the others: spheres around triangles, batches as earlier frames advise.
  void beginFrame(frame::Frame& frame);
  /// Finds the nearest triangle of each ray. With `light`, a point that all rays reach after their
  /// direction's length: sets the distance of a ray's hit to 0 if something stands in its way; the hierarchy
  /// is over the reversed rays, which all start at that point (Roger 2008, section 3.3.5). Passes are named
  /// after `name`.
  void trace(frame::Frame& frame, const RayTextures& rays, const std::string& name,
             const glm::vec3* light = nullptr);
  void endFrame();

  /// NearestHit per pixel (meet.glsl), then one whose distance is not 0 if results are worthless.
  const gl::Buffer& hits() const { return hits_; }

  // Of cones. A tile is a node of the last level, numbered by rows.
  /// Pairs of each tile, then GatheredTail, then for each tile whether it lacks pairs that found no room.
  const gl::Buffer& tiles() const { return hits_; }
  /// Three numbers for each pair that was gathered, in any order: tile, rank within it, triangle.
  const gl::Buffer& gathered() const { return *gathered_; }
  uint32_t gatheredRoom() const { return static_cast<uint32_t>(capacity_); }
  uint32_t tileCount() const { return tileCount_; }
  const gl::Buffer& spheres() const { return *spheres_; }
  /// Nodes and cones are cut off at this distance from where they start; infinite if never called.
  void setFarthest(float distance) { farthest_ = distance; }

  int64_t bytes() const;

  struct Counts {
    HierarchyControl control;
    uint64_t tests = 0;
    int batches = 0;
  };
  /// Of the last frame; waits for the GPU.
  Counts counts() const;
  /// For tests: the nodes' eight floats each, level by level from the rays; first node and size of a level.
  const gl::Buffer& nodes() const { return *nodes_; }
  uint32_t levelFirst(uint32_t level) const { return levelFirst_[level]; }
  glm::ivec2 levelSize(uint32_t level) const;
  /// For tests: pairs of the last level (node, triangle) that the last batch ended with; waits for the GPU.
  std::vector<glm::uvec2> lastPairs() const;
  uint32_t startLevel() const { return startLevel_; }
  uint32_t leafLevel() const { return leafLevel_; }

 private:
  struct Batch {
    uint32_t first, count;
  };
  struct Programs {
    const gl::Program *start = nullptr, *expand = nullptr, *finishStart = nullptr, *finish = nullptr,
                      *resolve = nullptr;
  };
  void setLevels(const gl::Program& program) const;
  void build(const RayTextures& rays, const glm::vec3* light);
  enum class Buffers { Streams, Rays };
  const SeparateReduction* separate() const { return std::get_if<SeparateReduction>(&settings_.reduction); }
  const SpilledPairs* spills() const { return std::get_if<SpilledPairs>(&settings_.overflow); }
  void compilePrograms(gl::ProgramCache& cache, bool shadows);
  void configure(const frame::Frame& frame, const Programs& programs) const;
  void bind(frame::Frame& frame, Buffers use, const gl::Buffer* out) const;
  void dispatchCounted(const gl::Program& program, size_t offset) const;
  void start(frame::Frame& frame, uint32_t number, const Programs& programs, const std::string& name);
  void descend(frame::Frame& frame, uint32_t level, uint32_t number, const Programs& programs,
               const std::string& name);
  void reduce(const gl::Buffer& into, uint32_t most, bool counted) const;
  void step(uint32_t level, uint32_t batch, uint32_t mode) const;
  void resolve(frame::Frame& frame, const Programs& programs) const;
  void finish(frame::Frame& frame, const gl::Program& program) const;
  void runLaterBatches(frame::Frame& frame, uint32_t number, const Programs& programs);
  void halveBatches();
  std::unique_ptr<gl::PassList::Scope> timedLevel(frame::Frame& frame, const std::string& name,
                                                  uint32_t level) const;

  TraversalSettings settings_;
  HierarchyLeaves leaves_;
  float farthest_ = 3.0e38F;
  uint32_t tileCount_ = 0;
  glm::ivec2 sizePx_;
  uint32_t triangleCount_, startLevel_ = 0, leafLevel_ = 0;
  std::vector<uint32_t> levelFirst_;
  int mostIterations_;
  uint32_t regionLevel_ = 31;
  glm::ivec2 regions_{1};  ///< of groups without room; 1 on a GPU
  std::vector<Batch> batches_;
  uint32_t mostBatches_ = kHierarchyMostBatches;
  const gl::Program *spheresProgram_, *buildProgram_, *controlProgram_;
  Programs nearest_, shadow_;
  std::optional<gl::Buffer> nodes_, spheres_, control_, left_;
  std::array<std::optional<gl::Buffer>, 2> streams_;  ///< read and written in turn
  std::array<std::optional<HostBuffer>, 2> waiting_;  ///< pairs for later batches
  std::optional<gl::Buffer> sparse_, reduced_;
  std::optional<compute::StreamReduction> reduction_;
  std::optional<gl::Buffer> gathered_;
  gl::Buffer hits_;
  LateReadback readback_;
  int64_t capacity_ = 0;
  size_t reading_ = 0, waitsIn_ = 0;
  bool timesLevels_ = false;
  uint64_t testsOfFrame_ = 0;
};

}  // namespace limen::techniques
