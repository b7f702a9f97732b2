// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/prefix_sum.h"

#include <epoxy/gl.h>

#include <cassert>

#include "renderer/compute/compute_bindings.h"

namespace limen::compute {

namespace {

constexpr const char* kPath = "renderer/compute/prefix_sum.comp.glsl";

ScanForm chosenForm(ScanForm form, const gl::Context& context) {
  if (form != ScanForm::Auto) return form;
  return context.device().software ? ScanForm::ReduceThenScan : ScanForm::LookBack;
}

uint32_t tileCount(uint32_t count, int lanes) {
  const uint32_t perTile = static_cast<uint32_t>(kScanGroup * kScanRows * 4 / lanes);
  return count / perTile + 1;  // count + 1 results
}

}  // namespace

PrefixSum::PrefixSum(gl::Context& context, uint32_t capacity, int lanes, ScanForm form)
    : form_(chosenForm(form, context)),
      lanes_(lanes),
      capacity_(capacity),
      tiles_(int64_t{tileCount(capacity, lanes)} * 2 * 4 * lanes, nullptr),
      // Twice the state of each tile. Each dispatch leaves cleared what the next one needs so.
      state_(int64_t{tileCount(capacity, lanes)} * 2 * 4, nullptr) {
  assert(lanes == 1 || lanes == 2);
  state_.clearUint(kScanTileNothing);
  const auto program = [&](const char* stage) {
    return &context.programs().compute(kPath, {{stage, "1"}, {"LANES", std::to_string(lanes)}});
  };
  if (form_ == ScanForm::LookBack) {
    first_ = program("LOOK_BACK");
    alone_ = program("ALONE");
  } else {
    first_ = program("REDUCE");
    second_ = program("TILES");
    third_ = program("SCAN");
  }
}

uint32_t PrefixSum::tilesOf(uint32_t count) const { return tileCount(count, lanes_); }

void PrefixSum::run(const gl::Buffer& values, const gl::Buffer& sums, uint32_t count) const {
  assert(count <= capacity_);
  assert(values.bytes() >= bytesFor(count, lanes_) && sums.bytes() >= bytesFor(count, lanes_));
  const uint32_t tiles = tilesOf(count);
  values.bindStorage(kScanValuesBuffer);
  sums.bindStorage(kScanSumsBuffer);
  tiles_.bindStorage(kScanTilesBuffer);
  state_.bindStorage(kScanStateBuffer);
  const auto dispatch = [&](const gl::Program& program, uint32_t groups) {
    program.use();
    program.set("count", count);
    program.set("tileCount", tiles);
    // Rows of groups, as no dimension has more than 65,535.
    const uint32_t rows = (groups + 65534) / 65535;
    glDispatchCompute((groups + rows - 1) / rows, rows, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  if (alone_ && tiles == 1) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    dispatch(*alone_, 1);
  } else if (form_ == ScanForm::LookBack) {
    const uint32_t most = tilesOf(capacity_);
    first_->set("statesAtMost", most);
    first_->set("statesAt", odd_ ? most : 0);
    first_->set("clearedAt", odd_ ? 0 : most);
    odd_ = !odd_;
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    dispatch(*first_, tiles);
  } else {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    dispatch(*first_, tiles);
    dispatch(*second_, 1);
    dispatch(*third_, tiles);
  }
}

}  // namespace limen::compute
