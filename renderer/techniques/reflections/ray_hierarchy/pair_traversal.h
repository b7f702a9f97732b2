// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/reflections/ray_hierarchy/cone_sphere.h"
#include "renderer/techniques/reflections/ray_hierarchy/late_readback.h"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

namespace limen::techniques {

constexpr EnumNames<BundleMerge, 2> enumNames(BundleMerge) {
  return {{{{BundleMerge::Mean, "mean"}, {BundleMerge::Pairwise, "pairwise"}}}};
}
constexpr EnumNames<BundleTest, 3> enumNames(BundleTest) {
  return {{{{BundleTest::Tight, "tight"}, {BundleTest::Robust, "robust"}, {BundleTest::Printed, "printed"}}}};
}

/// What happens to pairs that find no room. Whatever is chosen, those that still find none are followed to
/// the rays at once, one group each time: slower, but no frame loses any, and none waits for the CPU.
struct HalvedBatches {
  static constexpr const char *kKind = "halved_batches",
                              *kSummary = "halve batches of triangles that overflowed, from a later frame on";
  int mostBatches = 256;
  static const SettingsTable<HalvedBatches>& table();
};
struct SpilledPairs {
  static constexpr const char *kKind = "spilled_pairs",
                              *kSummary = "pairs without room wait in the CPU's memory for later batches";
  int room = 4194304;
  static const SettingsTable<SpilledPairs>& table();
};
struct FixedBatches {
  static constexpr const char *kKind = "fixed_batches", *kSummary = "batches of a fixed number of triangles";
  int triangles = 1048576;
  static const SettingsTable<FixedBatches>& table();
};
using Overflow = std::variant<HalvedBatches, SpilledPairs, FixedBatches>;

struct TraversalSettings {
  BundleMerge merge = BundleMerge::Mean;
  BundleTest test = BundleTest::Tight;
  int startNodes = 256;
  int leafSide = 1;
  int capacity = 4194304;
  Overflow overflow = HalvedBatches{};
  static const SettingsTable<TraversalSettings>& table();
};

/// Rays of a frame's size as the hierarchy takes them, one a pixel.
struct RayTextures {
  const gl::Texture* origins;     ///< RGBA32F, w > 0: a ray starts here
  const gl::Texture* directions;  ///< RGBA32F, unit; w: of shadow rays the distance up to which things count
  const gl::Texture* from;        ///< R32UI, the triangle that each leaves and cannot meet
};

/// Nearest triangles of rays without a structure over the triangles: a hierarchy over the rays, and all
/// triangles through it, level by level (Roger 2008, sections 3.3 and 3.4).
class PairTraversal {
 public:
  PairTraversal(frame::Frame& frame, const TraversalSettings& settings, bool shadows);

  /// Once a frame, before the others: spheres around triangles, batches as earlier frames advise.
  void beginFrame(frame::Frame& frame);
  /// Finds the nearest triangle of each ray, or, if `shadow`, sets the distance of a ray's hit to 0 if
  /// something stands in its way. Passes are named after `name`.
  void trace(frame::Frame& frame, const RayTextures& rays, const std::string& name, bool shadow);
  void endFrame();

  /// NearestHit per pixel (meet.glsl), then one whose distance is not 0 if results are worthless.
  const gl::Buffer& hits() const { return hits_; }
  int64_t bytes() const;

  struct Counts {
    HierarchyControl control;
    uint64_t tests = 0;
    int batches = 0, traces = 0;
  };
  /// Of the last frame; waits for the GPU.
  Counts counts() const;
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
  glm::ivec2 levelSize(uint32_t level) const;
  void setLevels(const gl::Program& program) const;
  void build(const RayTextures& rays, bool clears);
  void traverse(const Batch& batch, uint32_t number, const Programs& programs);
  void step(uint32_t level, uint32_t batch, bool begins) const;
  void resolve(const Programs& programs, uint32_t region);
  void halveBatches();

  TraversalSettings settings_;
  glm::ivec2 sizePx_;
  uint32_t triangleCount_, startLevel_ = 0, leafLevel_ = 0;
  std::vector<uint32_t> levelFirst_;
  int mostIterations_;
  std::vector<Batch> batches_;
  uint32_t mostBatches_ = kHierarchyMostBatches;
  const gl::Program *spheresProgram_, *buildProgram_, *controlProgram_;
  Programs nearest_, shadow_;
  std::optional<gl::Buffer> nodes_, spheres_, pairs_, control_, left_;
  gl::Buffer hits_;
  LateReadback readback_;
  uint64_t testsOfFrame_ = 0;
  int traces_ = 0;
};

}  // namespace limen::techniques
