// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction where shaders can scatter: scan + scatter in one dispatch, two or three, and the unordered
// append (Roger 2008, sections 4.4 and 4.5).
#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

/// Of 32 invocations that can add up and shuffle.
bool hasSubgroups() {
  if (!epoxy_has_gl_extension("GL_KHR_shader_subgroup")) return false;
  constexpr GLint kNeeded = GL_SUBGROUP_FEATURE_BASIC_BIT_KHR | GL_SUBGROUP_FEATURE_ARITHMETIC_BIT_KHR |
                            GL_SUBGROUP_FEATURE_SHUFFLE_BIT_KHR;
  GLint size = 0, stages = 0, features = 0;
  glGetIntegerv(GL_SUBGROUP_SIZE_KHR, &size);
  glGetIntegerv(GL_SUBGROUP_SUPPORTED_STAGES_KHR, &stages);
  glGetIntegerv(GL_SUBGROUP_SUPPORTED_FEATURES_KHR, &features);
  return size == 32 && (stages & GL_COMPUTE_SHADER_BIT) != 0 && (features & kNeeded) == kNeeded;
}

struct TileShape {
  int group, rows;
};

/// Measured on an H200: long tiles pay where there are enough to fill it twice. Their groups need more memory
/// than every device has.
TileShape tileShape(uint32_t most, const ReductionSettings& settings, ReductionForm form) {
  if (settings.group > 0 && settings.rows > 0) return {settings.group, settings.rows};
  if (!hasSubgroups() || form != ReductionForm::LookBack) return {256, 4};
  constexpr uint64_t kManyWords = 1U << 21;
  if (uint64_t{most} * static_cast<uint32_t>(settings.lanes) < kManyWords) return {512, 2};
  GLint shared = 0;
  glGetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &shared);
  return shared > 36 * 1024 ? TileShape{512, 8} : TileShape{256, 8};
}

class ScatterForm : public StreamReduction::BackEnd {
 public:
  ScatterForm(gl::Context& context, uint32_t most, const ReductionSettings& settings, ReductionForm form)
      : shape_(tileShape(most, settings, form)),
        perTile_(static_cast<uint32_t>(shape_.group * shape_.rows * 4 / settings.lanes)),
        tilesAtMost_((tilesOf(most) + 3) / 4 * 4),  // four states are read at a time
        state_((2 * int64_t{tilesAtMost_} + kReductionTiles) * 4, nullptr) {
    // Each dispatch leaves cleared what the next one needs so.
    state_.clearUint(kReductionNothing);
    const auto program = [&](const char* stage, const char* also = nullptr) {
      gl::ShaderDefines defines = reductionDefines(settings);
      defines[stage] = "1";
      if (also) defines[also] = "1";
      defines["GROUP"] = std::to_string(shape_.group);
      defines["ROWS"] = std::to_string(shape_.rows);
      defines["LOOKS"] = std::to_string(settings.looks);
      if (settings.tickets && form == ReductionForm::LookBack) defines["TICKETS"] = "1";
      if (settings.emulateSubgroups) defines["EMULATED_SUBGROUPS"] = "1";
      if (settings.emulateSubgroups || hasSubgroups()) defines["SUBGROUPS"] = "1";
      return &context.programs().compute("renderer/compute/reduction_scatter.comp.glsl", defines);
    };
    if (form == ReductionForm::ScanScatter) {
      const bool addUp = tilesOf(most) <= kMostTilesAddedUp;
      first_ = program("COUNT");
      if (!addUp) tiles_ = program("TILES");
      last_ = program("SCATTER", addUp ? "ADD_UP" : nullptr);
    } else {
      last_ = program(form == ReductionForm::Append ? "APPEND" : "LOOK_BACK");
    }
  }

  void run(const StreamInput& in, const StreamOutput& out) const override {
    bindStream(in, out);
    state_.bindStorage(kReductionStateBuffer);
    const auto dispatch = [&](const gl::Program* program, uint32_t groups, GLbitfield barrier) {
      if (!program) return;
      program->use();
      setStream(*program, in, out);
      dispatchGroups(groups, barrier);
    };
    const uint32_t tiles = tilesOf(in.most);
    dispatch(first_, tiles, GL_SHADER_STORAGE_BARRIER_BIT);
    dispatch(tiles_, 1, GL_SHADER_STORAGE_BARRIER_BIT);
    last_->set("tilesAtMost", tilesAtMost_);
    last_->set("tilesAt", kReductionTiles + (odd_ ? tilesAtMost_ : 0));
    last_->set("clearedAt", kReductionTiles + (odd_ ? 0 : tilesAtMost_));
    odd_ = !odd_;
    // StreamReduction::run() has the last barrier: each takes 0.7 us on an H200, even where nothing is to be
    // waited for.
    dispatch(last_, tiles, 0);
  }

  int64_t bytes() const override { return state_.bytes(); }

 private:
  /// With more, sums of all tiles before each are made in a dispatch of their own.
  static constexpr uint32_t kMostTilesAddedUp = 4096;

  /// At least one, which writes the count.
  uint32_t tilesOf(uint32_t items) const { return items == 0 ? 1 : (items - 1) / perTile_ + 1; }

  TileShape shape_;
  uint32_t perTile_, tilesAtMost_;
  mutable bool odd_ = false;  // dispatches so far
  const gl::Program *first_ = nullptr, *tiles_ = nullptr, *last_ = nullptr;
  gl::Buffer state_;
};

}  // namespace

std::unique_ptr<StreamReduction::BackEnd> makeScatterForm(gl::Context& context, uint32_t most,
                                                          const ReductionSettings& settings,
                                                          ReductionForm form) {
  return std::make_unique<ScatterForm>(context, most, settings, form);
}

}  // namespace limen::compute
