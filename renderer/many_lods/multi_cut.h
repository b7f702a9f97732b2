// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {

/// From the root in every frame. Source: Holländer 2013, section 3.5.2.
struct BasicCuts {
  static constexpr const char *kKind = "basic", *kSummary = "from the root in every frame";
  static const SettingsTable<BasicCuts>& table();
};
/// From the cut of the frame before, until every node is right.
struct IncrementalCuts {
  static constexpr const char *kKind = "incremental", *kSummary = "from the last frame's cut, to the end";
  static const SettingsTable<IncrementalCuts>& table();
};
/// From the cut of the frame before, by a few edges of the tree.
struct LazyCuts {
  static constexpr const char *kKind = "lazy", *kSummary = "from the last frame's cut, by a few edges";
  int edges = 1;
  static const SettingsTable<LazyCuts>& table();
};
/// As LazyCuts by the listing as printed: it loses and doubles parts of the surface.
struct LiteralCuts {
  static constexpr const char *kKind = "literal",
                              *kSummary = "lazy by the printed listing, which breaks the cut";
  int edges = 1;
  static const SettingsTable<LiteralCuts>& table();
};
using CutMode = std::variant<IncrementalCuts, LazyCuts, BasicCuts, LiteralCuts>;

/// The cuts of one tree for many views, made on the GPU (ManyLoDs). The list has an entry (node, view) for
/// each node of each cut, what is culled included, sorted by view and then from left to right in the tree:
/// siblings that are both in a cut are neighbours. So a lazy merge knows whether both are there, lists are
/// compacted in order by sums over tiles, and the same input gives the same list. Each step rewrites the
/// list: it classifies entries, sums up over tiles, and writes; it is dispatched indirectly by what the step
/// before left, and nothing is read back.
///
/// Basic and incremental cuts are those of the recursion from the root, as children of valid nodes are valid
/// (node_predicate.h): an entry with a valid parent climbs as long as it is a first child, and is dropped
/// where it is a second one. Lazy cuts merge where both children are there; every cut covers each leaf once
/// in every frame. Splits that the list has no room for are not done, and counted: those of later views
/// first. Source: Holländer 2013, sections 3.5.2 and 3.5.3; order, exact merge and budget are the bench's
/// own.
class MultiCut {
 public:
  /// `capacity`: of the list, entries, >= views. Throws Error if the device cannot hold it.
  MultiCut(gl::Context& context, uint32_t views, int depth, uint32_t capacity, const CutMode& mode);

  /// The cuts for `nodes` (spheres of a tree) and `views` (CutView each). Binds storage buffers 0 to 5. Ends
  /// with a barrier for storage and commands. `counting`: counts tests and merges as well.
  void update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting = false);
  /// The next update starts from the root.
  void restart() { fresh_ = true; }

  const gl::Buffer& listBuffer() const { return list_; }        ///< both halves
  const gl::Buffer& controlBuffer() const { return control_; }  ///< CutControl, then the steps
  int64_t bytes() const;
  uint32_t capacity() const { return capacity_; }
  uint32_t viewCount() const { return views_; }

  /// Wait for the GPU.
  CutControl control() const;
  std::vector<glm::uvec2> list() const;  ///< node, view

 private:
  void step(const gl::Program& classify, uint32_t number, uint32_t last, bool always);
  const gl::Program& classifier(uint32_t rule, bool counting) const {
    return *classify_[2 * rule + counting];
  }

  CutMode mode_;
  uint32_t views_, leaves_, capacity_;
  uint32_t fullSteps_;
  bool fresh_ = true;
  gl::Buffer list_, codes_, tiles_, control_;
  const gl::Program *restart_, *begin_, *scan_, *emit_;
  std::vector<const gl::Program*> classify_;
};

/// The same by recursion from the root on the CPU, for one view, from left to right.
std::vector<uint32_t> recursiveCut(const std::vector<glm::vec4>& spheres, int depth, const CutView& view);

/// What is wrong with cuts: leaves of all views that are under no node, and that are under more than one.
struct CutFaults {
  uint64_t uncovered = 0, doubled = 0;
};
CutFaults faultsOf(const std::vector<glm::uvec2>& list, uint32_t views, int depth);

}  // namespace limen::many_lods
