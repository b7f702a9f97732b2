// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/patterns/pattern_batches.h"

#include <epoxy/gl.h>

#include <bit>

namespace limen::techniques {
namespace {

const std::string kFolder = "renderer/techniques/tessellation/patterns/";

int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

int patternsOf(surfaces::Domain domain, int levels, bool adapted) {
  return adapted ? levels : power(levels, surfaces::sidesOf(domain));
}

bool has(const frame::Frame& frame, surfaces::Domain domain) {
  for (const surfaces::Patch& patch : frame.scene().surfaces.patches)
    if (patch.domain == domain) return true;
  return false;
}

gl::ShaderDefines counting(gl::ShaderDefines defines) {
  defines["COUNT"] = "1";
  return defines;
}

/// Draws without instances, in the order of batches.comp.glsl.
std::vector<PatternCommand> commandsOf(const frame::Frame& frame, PatternMeshes& meshes, int levels,
                                       bool adapted) {
  std::vector<PatternCommand> out;
  for (const surfaces::Domain domain : {surfaces::Domain::Rectangle, surfaces::Domain::Triangle}) {
    if (!has(frame, domain)) continue;
    for (int key = 0; key < patternsOf(domain, levels, adapted); ++key) {
      surfaces::Factors factors{};
      for (int side = 0, rest = key; side < surfaces::sidesOf(domain); ++side, rest /= levels)
        factors[static_cast<size_t>(side)] = 1 << (adapted ? key : rest % levels);
      const std::optional<PatternMeshes::Mesh> mesh = meshes.meshOf(domain, factors);
      if (!mesh)
        throw Error("the patterns of all tuples of factors do not fit", "capacity",
                    "raise it, lower factors.most, or use patterns: adapted");
      out.push_back({mesh->indices, 0, mesh->firstIndex, mesh->firstVertex, 0});
    }
  }
  return out;
}

}  // namespace

PatternBatches::PatternBatches(frame::Frame& frame, const PatchBuffers& patches, PatternMeshes& meshes,
                               int most, bool adapted)
    : patches_(patches),
      adapted_(adapted),
      levels_(std::bit_width(static_cast<unsigned>(most - 1)) + 1),
      rectanglePatterns_(has(frame, surfaces::Domain::Rectangle)
                             ? patternsOf(surfaces::Domain::Rectangle, levels_, adapted)
                             : 0),
      patternCount_(rectanglePatterns_ + (has(frame, surfaces::Domain::Triangle)
                                              ? patternsOf(surfaces::Domain::Triangle, levels_, adapted)
                                              : 0)),
      countProgram_(
          frame.context().programs().compute(kFolder + "batches.comp.glsl", counting(patches.defines()))),
      placeProgram_(frame.context().programs().compute(kFolder + "batches.comp.glsl", patches.defines())),
      commandsProgram_(frame.context().programs().compute(kFolder + "commands.comp.glsl")),
      counts_(compute::PrefixSum::bytesFor(static_cast<uint32_t>(patternCount_), 1), nullptr),
      offsets_(compute::PrefixSum::bytesFor(static_cast<uint32_t>(patternCount_), 1), nullptr),
      instances_(int64_t{patches.count()} * 4, nullptr),
      commands_(commandsOf(frame, meshes, levels_, adapted)),
      scan_(frame.context(), static_cast<uint32_t>(patternCount_)) {}

void PatternBatches::run(const FactorPass& factors) const {
  const auto dispatch = [&](const gl::Program& program, uint32_t items) {
    program.use();
    glDispatchCompute((items + uint32_t(kTessellationGroup) - 1) / uint32_t(kTessellationGroup), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  };
  const auto overPatches = [&](const gl::Program& program) {
    program.set("patchCount", patches_.count());
    program.set("adaptedPatterns", adapted_ ? 1 : 0);
    program.set("levels", levels_);
    program.set("firstOfTriangles", static_cast<uint32_t>(rectanglePatterns_));
    dispatch(program, patches_.count());
  };
  const auto bind = [&] {
    patches_.bindStorage();
    factors.factors().bindStorage(kFactorsBuffer);
    counts_.bindStorage(kPatternCountsBuffer);
    offsets_.bindStorage(kPatternOffsetsBuffer);
  };
  counts_.clearUint(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  bind();
  overPatches(countProgram_);
  scan_.run(counts_, offsets_, static_cast<uint32_t>(patternCount_));
  bind();
  commands_.bindStorage(kPatternCommandsBuffer);
  commandsProgram_.set("patternCount", static_cast<uint32_t>(patternCount_));
  dispatch(commandsProgram_, static_cast<uint32_t>(patternCount_));
  counts_.clearUint(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  instances_.bindStorage(kPatternInstancesBuffer);
  overPatches(placeProgram_);
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

}  // namespace limen::techniques
