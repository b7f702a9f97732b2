// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "experiments/base/enum_names.h"
#include "renderer/compute/reduction_bindings.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

namespace limen::compute {

/// Most items of a stream.
inline constexpr uint32_t kMostStreamItems = 1U << 30;

/// How the valid items of a stream are packed.
enum class ReductionForm {
  Scatter,  ///< LookBack on a GPU, ScanScatter on a software renderer
  /// One dispatch that reads each item once and writes each valid one once: a tile waits for the counts of
  /// those before it (Merrill and Garland 2016); PrefixSum says why that ends on any device.
  LookBack,
  ScanScatter,      ///< counts of tiles, sums over these, scatter: three dispatches that read items twice
  BlockSequential,  ///< an invocation takes a whole block, item by item; sums over blocks, scatter
                    ///< (Roger 2008, section 4.6)
  Append,           ///< a tile takes its place by an atomic addition: items come in no particular order
  // Without scatter: each place of the output searches for its item.
  Horn,           ///< Hillis-Steele scan of the whole stream, dichotomic search in it (Horn 2005)
  GlobalSearch,   ///< the same with Blelloch's scan (Sengupta et al. 2006)
  Hierarchical,   ///< scan and search within blocks, which are then joined (Roger 2008, section 4.3)
  GeometryShader  ///< a geometry shader drops invalid items; transform feedback captures the others
};
constexpr EnumNames<ReductionForm, 9> enumNames(ReductionForm) {
  return {{{{ReductionForm::Scatter, "scatter"},
            {ReductionForm::LookBack, "look_back"},
            {ReductionForm::ScanScatter, "scan_scatter"},
            {ReductionForm::BlockSequential, "block_sequential"},
            {ReductionForm::Append, "append"},
            {ReductionForm::Horn, "horn"},
            {ReductionForm::GlobalSearch, "global_search"},
            {ReductionForm::Hierarchical, "hierarchical"},
            {ReductionForm::GeometryShader, "geometry_shader"}}}};
}

/// How sums are made where a scan of the thesis is meant; scan.h has both over whole arrays.
enum class ScanAlgorithm {
  HillisSteele,  ///< log2 n steps, n log2 n additions
  Blelloch       ///< up and down a tree: 2 log2 n steps, 2 n additions
};
constexpr EnumNames<ScanAlgorithm, 2> enumNames(ScanAlgorithm) {
  return {{{{ScanAlgorithm::HillisSteele, "hillis_steele"}, {ScanAlgorithm::Blelloch, "blelloch"}}}};
}

/// How a place of the output finds its item.
enum class ItemSearch {
  Fixed,    ///< halves the range a fixed number of times, log2 of its size
  Improved  ///< Roger 2008, figure 4.7: the sums say how far off a guess is at least
};
constexpr EnumNames<ItemSearch, 2> enumNames(ItemSearch) {
  return {{{{ItemSearch::Fixed, "fixed"}, {ItemSearch::Improved, "improved"}}}};
}

/// How the blocks of Hierarchical are joined.
enum class BlockJoin {
  Compute,     ///< an invocation for each item moves it
  LinesTwice,  ///< each block is drawn as a line, twice: what passes the end of a row and what begins the
               ///< next
  LinesSplit   ///< each block is drawn as a line that a geometry shader splits at the end of a row
};
constexpr EnumNames<BlockJoin, 3> enumNames(BlockJoin) {
  return {{{{BlockJoin::Compute, "compute"},
            {BlockJoin::LinesTwice, "lines_twice"},
            {BlockJoin::LinesSplit, "lines_split"}}}};
}

struct ReductionSettings {
  ReductionForm form = ReductionForm::Scatter;
  int lanes = 1;         ///< words of an item: 1 or 2 (uvec2)
  bool flagged = false;  ///< valid are the items whose flag is not 0, rather than those that differ from
                         ///< kInvalidItem in their first word
  int blockSize = 64;    ///< BlockSequential, Hierarchical: items, a power of two from 8 to 512
  ScanAlgorithm blockScan = ScanAlgorithm::HillisSteele;  ///< Hierarchical
  ItemSearch search = ItemSearch::Improved;               ///< Horn, GlobalSearch, Hierarchical
  BlockJoin join = BlockJoin::Compute;                    ///< Hierarchical
  /// Lines: width of the texture that they are drawn into, a power of two of at least blockSize. What it
  /// holds is then copied to the output.
  int rowWidth = 2048;
  bool countFetches = false;  ///< see StreamReduction::fetches(); slower
  // LookBack, ScanScatter, Append: a group of so many invocations takes so many times 16 bytes for each.
  // Without subgroups of 32 invocations a group has 256, and 4 rows at most. 0: what was fastest on a GPU for
  // the stream's length.
  int group = 0, rows = 0;
  bool tickets = false;  ///< LookBack: tiles in the order in which groups start, in place of their numbers
  int looks = 2;  ///< LookBack, by subgroups: times four tiles that an invocation looks back at together
  bool emulateSubgroups = false;  ///< a group of 32 stands for one of the device's subgroups: for tests
};

/// A stream. Buffers have at least bytesFor(most, lanes) bytes; those of flags bytesFor(most, 1).
struct StreamInput {
  const gl::Buffer& items;
  uint32_t most;                      ///< items, or the most there can be if only the GPU knows their number
  const gl::Buffer* flags = nullptr;  ///< one word an item; see ReductionSettings::flagged
  /// Holds the number of items at byte `countOffset` (a multiple of 4); more than `most` counts as `most`.
  /// Null: there are `most`. ReducedCount::written of an earlier reduction lies at byte 4.
  const gl::Buffer* count = nullptr;
  int64_t countOffset = 4;
};

/// Where the valid items go. None of the buffers may be one of the input's.
struct StreamOutput {
  const gl::Buffer& items;
  uint32_t capacity;        ///< items that fit; valid ones beyond are counted as lost and written nowhere
  const gl::Buffer& count;  ///< a ReducedCount
  uint32_t groupSize = 64;  ///< items to a work group in ReducedCount::groupsX to groupsZ
};

/// Packs the valid items of a stream, in their order unless the form says otherwise (Roger 2008, chapter 4).
/// The number of items stays on the GPU.
class StreamReduction {
 public:
  /// Of at most `most` items, up to kMostStreamItems. Compiles and allocates; throws Error if a form cannot
  /// run here.
  StreamReduction(gl::Context& context, uint32_t most, const ReductionSettings& settings = {});
  ~StreamReduction();
  StreamReduction(StreamReduction&&) noexcept;

  /// Reads `in`, writes `out`. Issues barriers for shader storage before, between and after its dispatches,
  /// and after them for indirect commands as well. Nothing waits for the GPU. Binds storage buffers 0 to 5.
  void run(const StreamInput& in, const StreamOutput& out) const;

  /// The form that runs: never Scatter.
  ReductionForm form() const;
  bool ordered() const { return form() != ReductionForm::Append; }
  /// Sums and marks of validity that searches fetched in the last run, with ReductionSettings::countFetches;
  /// 0 for forms that do not search. Modulo 2^32. Waits for the GPU.
  uint32_t fetches() const;
  /// Held besides input and output.
  int64_t bytes() const;

  /// Whole 16 bytes, as shaders read.
  static int64_t bytesFor(uint32_t items, int lanes) { return (int64_t{items} * lanes * 4 + 15) / 16 * 16; }

  /// One of the forms. Implemented in the sources of each.
  class BackEnd;

 private:
  ReductionForm form_;
  uint32_t most_;
  ReductionSettings settings_;
  std::unique_ptr<BackEnd> backEnd_;
};

}  // namespace limen::compute
