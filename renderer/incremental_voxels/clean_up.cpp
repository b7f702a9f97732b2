// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/clean_up.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "renderer/incremental_voxels/incremental_bindings.h"

namespace limen::incremental_voxels {
namespace {

constexpr const char* kCleanUpShader = "renderer/incremental_voxels/clean_up.comp.glsl";
constexpr const char* kBiasNames[kMostDepthViews] = {"viewBias[0]", "viewBias[1]"};

gl::ShaderDefines with(gl::ShaderDefines defines, const char* name) {
  defines[name] = "1";
  return defines;
}

}  // namespace

const SettingsTable<FixedBias>& FixedBias::table() {
  static const SettingsTable<FixedBias> kTable = {{&FixedBias::sides,
                                                   "sides",
                                                   {0.0, 16.0},
                                                   "voxels",
                                                   "Bias as a share of a voxel's side",
                                                   "Gaitatzes 2012, section 7.4.1"}};
  return kTable;
}

const SettingsTable<CleanUpSettings>& CleanUpSettings::table() {
  using S = CleanUpSettings;
  static const SettingsTable<S> kTable = {
      {&S::bias, "bias", "How far a voxel's middle must lie before what is seen there",
       "Gaitatzes 2012, section 7.4.1"},
      {&S::proof, "proof", "Which pixels have to see through a voxel"},
      {&S::sky, "sky", "Pixels that see nothing see through voxels"}};
  return kTable;
}

double biasOf(const CleanUpBias& bias, const DepthView& view, const voxels::VoxelGrid& grid) {
  if (std::holds_alternative<RadiusBias>(bias)) return 0.5 * std::sqrt(3.0) * grid.voxelSize;
  if (std::holds_alternative<ListingBias>(bias)) return 3.0 * grid.voxelSize;
  if (const auto* fixed = std::get_if<FixedBias>(&bias)) return fixed->sides * grid.voxelSize;
  const glm::dmat4& m = view.fromAnchor;  // its third row: the view's axis
  return 0.5 * grid.voxelSize * (std::abs(m[0][2]) + std::abs(m[1][2]) + std::abs(m[2][2]));
}

glm::ivec3 brickCounts(const voxels::VoxelGrid& grid) {
  return (grid.resolution + glm::ivec3(31, kBrickSide - 1, kBrickSide - 1)) /
         glm::ivec3(32, kBrickSide, kBrickSide);
}

void configureDisproof(const gl::Program& program, const CleanUpSettings& settings,
                       const std::vector<DepthView>& views, const voxels::VoxelGrid& grid,
                       glm::dvec3 anchor) {
  configureViews(program, views, grid, anchor);
  for (size_t i = 0; i < views.size(); ++i)
    program.set(kBiasNames[i], static_cast<float>(biasOf(settings.bias, views[i], grid)));
  program.set("skyDisproves", settings.sky ? 1 : 0);
}

gl::ShaderDefines disproofDefines(const CleanUpSettings& settings, const SampledVolume& volume, int views,
                                  int used, bool tiled) {
  gl::ShaderDefines defines = volume.defines();
  if (tiled) defines["TILED"] = "1";
  defines["VIEWS"] = std::to_string(views);
  defines["USED_VIEWS"] = std::to_string(used);
  defineEnum(defines, "PROOF", settings.proof);
  return defines;
}

void dispatchBricks(const gl::Program& program, const voxels::VoxelGrid& grid, int bricks) {
  const glm::ivec3 counts = brickCounts(grid);
  program.set("brickCount", bricks);
  program.set("brickCountX", counts.x);
  program.set("brickCountY", counts.y);
  program.use();
  const uint32_t groups = static_cast<uint32_t>(std::max(bricks, 1)), rows = (groups + 65534) / 65535;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

CleanUp::CleanUp(gl::Context& context, const CleanUpSettings& settings, const SampledVolume& volume,
                 int views, int used, const std::vector<glm::ivec2>& tiledPx)
    : settings_(settings),
      everywhere_(context.programs().compute(
          kCleanUpShader, disproofDefines(settings, volume, views, used, !tiledPx.empty()))),
      listed_(context.programs().compute(
          kCleanUpShader,
          with(disproofDefines(settings, volume, views, used, !tiledPx.empty()), "LISTED_BRICKS"))) {
  if (!tiledPx.empty()) tiles_.emplace(context, tiledPx);
}

void CleanUp::run(const SampledVolume& volume, const std::vector<DepthView>& views, glm::dvec3 anchor) const {
  const glm::ivec3 counts = brickCounts(volume.grid());
  dispatch(everywhere_, volume, views, anchor, counts.x * counts.y * counts.z);
}

void CleanUp::run(const SampledVolume& volume, const std::vector<DepthView>& views, glm::dvec3 anchor,
                  const gl::Buffer& bricks, int count) const {
  bricks.bindStorage(kSampleSumsBuffer);
  dispatch(listed_, volume, views, anchor, count);
}

void CleanUp::dispatch(const gl::Program& program, const SampledVolume& volume,
                       const std::vector<DepthView>& views, glm::dvec3 anchor, int bricks) const {
  if (tiles_) {
    tiles_->run(views);
    tiles_->bind();
  }
  volume.bind(program);
  configureDisproof(program, settings_, views, volume.grid(), anchor);
  dispatchBricks(program, volume.grid(), bricks);
}

}  // namespace limen::incremental_voxels
