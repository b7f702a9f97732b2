// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/scan.h"

#include <bit>
#include <cassert>
#include <limits>

#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

/// Bits of the operator's identity.
uint32_t identityOf(ScanOperator operation, ScanNumbers numbers) {
  const bool floats = numbers == ScanNumbers::Float;
  switch (operation) {
    case ScanOperator::Add:
      return 0;
    case ScanOperator::Multiply:
      return floats ? std::bit_cast<uint32_t>(1.0F) : 1;
    case ScanOperator::Minimum:
      return floats ? std::bit_cast<uint32_t>(std::numeric_limits<float>::infinity()) : 0xffffffffU;
    case ScanOperator::Maximum:
      return floats ? std::bit_cast<uint32_t>(-std::numeric_limits<float>::infinity()) : 0;
  }
  return 0;
}

/// Blelloch's tree has a root of its own even over one value.
uint32_t paddedCount(uint32_t count) { return std::max(std::bit_ceil(count), 2U); }

}  // namespace

Scan::Scan(gl::Context& context, uint32_t capacity, const ScanSettings& settings)
    : settings_(settings),
      capacity_(capacity),
      work_{gl::Buffer(int64_t{paddedCount(capacity)} * 4, nullptr),
            gl::Buffer(
                settings.algorithm == ScanAlgorithm::HillisSteele ? int64_t{paddedCount(capacity)} * 4 : 0,
                nullptr)} {
  const auto program = [&](const char* stage) {
    gl::ShaderDefines defines{
        {stage, "1"},
        {"NUMBER", settings.numbers == ScanNumbers::Float ? "float" : "uint"},
        {"IDENTITY", std::to_string(identityOf(settings.operation, settings.numbers)) + "u"}};
    if (settings.numbers == ScanNumbers::Float) defines["FLOATS"] = "1";
    defineEnum(defines, "OPERATION", settings.operation);
    return &context.programs().compute("renderer/compute/scan.comp.glsl", defines);
  };
  load_ = program("LOAD"), store_ = program("STORE");
  const bool doubling = settings.algorithm == ScanAlgorithm::HillisSteele;
  step_ = program(doubling ? "DOUBLING" : "UP");
  down_ = doubling ? nullptr : program("DOWN");
}

int Scan::steps(uint32_t count) const {
  const int levels = std::countr_zero(paddedCount(count));
  return 2 + (down_ ? 2 : 1) * levels;
}

void Scan::run(const gl::Buffer& values, const gl::Buffer& results, uint32_t count) const {
  assert(count <= capacity_);
  assert(values.bytes() >= int64_t{count} * 4 && results.bytes() >= int64_t{count} * 4);
  const uint32_t padded = paddedCount(count);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  values.bindStorage(kScanInBuffer);
  results.bindStorage(kScanOutBuffer);
  size_t to = 0;
  const auto dispatch = [&](const gl::Program& program, uint32_t invocations, uint32_t distance) {
    program.use();
    program.set("count", count);
    program.set("padded", padded);
    program.set("distance_", distance);
    work_[1 - to].bindStorage(kScanFromBuffer);
    work_[to].bindStorage(kScanToBuffer);
    dispatchGroups((invocations + kScanStepGroup - 1) / kScanStepGroup);
  };
  dispatch(*load_, padded, 0);
  if (down_) {
    for (uint32_t distance = 1; distance < padded; distance *= 2)
      dispatch(*step_, padded / (2 * distance), distance);
    for (uint32_t distance = padded / 2; distance > 0; distance /= 2)
      dispatch(*down_, padded / (2 * distance), distance);
  } else {
    for (uint32_t distance = 1; distance < padded; distance *= 2) {
      to = 1 - to;
      dispatch(*step_, padded, distance);
    }
  }
  // Trees give exclusive results, doubling inclusive ones.
  const bool inclusive = settings_.range == ScanRange::Inclusive;
  store_->set("shift", down_ && inclusive ? 1 : !down_ && !inclusive ? -1 : 0);
  to = 1 - to;
  dispatch(*store_, count, 0);
}

}  // namespace limen::compute
