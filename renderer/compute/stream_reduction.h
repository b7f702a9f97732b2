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
  ScanScatter,  ///< counts of tiles, sums over these, scatter: three dispatches that read items twice
  Append        ///< a tile takes its place by an atomic addition: items come in no particular order
};
constexpr EnumNames<ReductionForm, 4> enumNames(ReductionForm) {
  return {{{{ReductionForm::Scatter, "scatter"},
            {ReductionForm::LookBack, "look_back"},
            {ReductionForm::ScanScatter, "scan_scatter"},
            {ReductionForm::Append, "append"}}}};
}

struct ReductionSettings {
  ReductionForm form = ReductionForm::Scatter;
  int lanes = 1;         ///< words of an item: 1 or 2 (uvec2)
  bool flagged = false;  ///< valid are the items whose flag is not 0, rather than those that differ from
                         ///< kInvalidItem in their first word
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
