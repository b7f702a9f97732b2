// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/view_atlas.h"

namespace limen::many_lods {

/// How a group counts those of its invocations that split or draw.
enum class FlagScan { Ballot, Sweep };
constexpr EnumNames<FlagScan, 2> enumNames(FlagScan) {
  return {{{{FlagScan::Ballot, "ballot"}, {FlagScan::Sweep, "sweep"}}}};
}
/// Value of FLAG_SCAN in flag_scan.glsl: a ballot where the driver has one, else the sweep.
int flagScanForm(FlagScan scan);

struct InPlaceSettings {
  static constexpr const char *kKind = "in_place",
                              *kSummary = "from the root, drawn where they are found, without a list";
  int finders = 128;
  int viewsPerGroup = 4;
  int finished = 4;
  FlagScan scan = FlagScan::Ballot;
  bool discard = false;
  static const SettingsTable<InPlaceSettings>& table();
  /// Throws Error if the stack does not fit shared memory for any tree.
  void check() const;
};

/// Empties atlas and counts, and binds what programs need that draw cuts where they find them. Storage
/// buffers as in many_lods_bindings.h.
void beginInPlace(const gl::Program& program, const gl::Buffer& nodes, const gl::Buffer& views,
                  const ViewAtlas& atlas, const ViewAtlas::Settings& settings, const gl::Buffer& counts);

/// Cuts that are drawn where they are found: a group holds the nodes of a few views that are still to be
/// looked at on a stack in shared memory, takes as many as it has finders from its top, pushes the children
/// of those that are too coarse in their order, and draws the others when enough have come together. No list
/// is kept, so that each frame starts from the root; tiles are those of MultiCut and ViewAtlas
/// (AtlasForm::Depth).
///
/// Bound on the stack: finders x (1 + depth) entries. Entries are pushed in the order in which they were
/// popped, so that levels never fall towards the top; a round leaves as many entries behind as there are
/// finders at most, one level deeper than those that the round before left. Splits beyond it would not be
/// done, and counted; there have been none. Source: Holländer 2013, section 3.7.2.
class InPlaceCuts {
 public:
  InPlaceCuts(gl::Context& context, uint32_t views, int depth, const InPlaceSettings& settings,
              Discs discs = Discs::Spheres);

  /// Clears `atlas` and draws the cuts. Binds storage buffers 0, 1, 3, 5 and 7.
  void draw(const gl::Buffer& nodes, const gl::Buffer& views, const ViewAtlas& atlas,
            const ViewAtlas::Settings& settings) const;

  uint32_t stackBound() const { return stack_; }
  const gl::Buffer& countsBuffer() const { return counts_; }  ///< InPlaceCounts of the last draw()
  InPlaceCounts counts() const;                               ///< waits for the GPU; of the last draw()
  int64_t bytes() const { return counts_.bytes(); }

 private:
  InPlaceSettings settings_;
  uint32_t views_, leaves_, stack_;
  gl::Buffer counts_;
  const gl::Program& program_;
};

}  // namespace limen::many_lods
