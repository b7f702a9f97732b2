// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/incremental_voxels/depth_tiles.h"
#include "renderer/incremental_voxels/depth_view.h"
#include "renderer/incremental_voxels/sampled_volume.h"

namespace limen::incremental_voxels {

/// How far before the seen surface a voxel's middle must lie for the voxel to be empty. Source: Gaitatzes
/// 2012, section 7.4.1, whose text and listing differ.
struct TightBias {
  static constexpr const char *kKind = "tight",
                              *kSummary = "the voxel's extent along the view, from its middle";
};
struct RadiusBias {
  static constexpr const char *kKind = "radius",
                              *kSummary = "half the voxel's diagonal: 0.866 sides (the text)";
};
struct ListingBias {
  static constexpr const char *kKind = "listing", *kSummary = "3 sides (listing 7.1, for cubic voxels)";
};
struct FixedBias {
  static constexpr const char *kKind = "sides", *kSummary = "a number of sides of a voxel";
  double sides = 1.0;
  static const SettingsTable<FixedBias>& table();
};
using CleanUpBias = std::variant<TightBias, RadiusBias, ListingBias, FixedBias>;

/// World units.
double biasOf(const CleanUpBias& bias, const DepthView& view, const voxels::VoxelGrid& grid);

/// Which pixels have to see through a voxel.
enum class Proof {
  Centre,    ///< the one that sees its middle
  Support,   ///< that one, and none of up to 16 that the voxel may cover, spread evenly, sees a surface in it
  Footprint  ///< all of those: a voxel that is hidden in part stays
};
constexpr EnumNames<Proof, 3> enumNames(Proof) {
  return {{{{Proof::Centre, "centre"}, {Proof::Support, "support"}, {Proof::Footprint, "footprint"}}}};
}

struct CleanUpSettings {
  CleanUpBias bias = RadiusBias{};
  Proof proof = Proof::Support;
  bool sky = true;
  static const SettingsTable<CleanUpSettings>& table();
};

/// Empties voxels of which depth images show that there is nothing in them. Source: Gaitatzes 2012, section
/// 7.4.1, whose formula for the depth has the wrong sign: here depths are near / z. In place, as each voxel
/// is one invocation's.
class CleanUp {
 public:
  /// `views`: bound to the shaders; `used` of them, the first, tell of voxels.
  /// `tiledPx`: sizes of the used views, if tiles of their depths are to decide whole bricks first, which
  /// changes no voxel; otherwise empty.
  CleanUp(gl::Context& context, const CleanUpSettings& settings, const SampledVolume& volume, int views,
          int used, const std::vector<glm::ivec2>& tiledPx = {});
  /// Opens no pass. Waits for nothing.
  void run(const SampledVolume& volume, const std::vector<DepthView>& views, glm::dvec3 anchor) const;
  /// Only in these bricks (brickCounts()).
  void run(const SampledVolume& volume, const std::vector<DepthView>& views, glm::dvec3 anchor,
           const gl::Buffer& bricks, int count) const;
  int64_t bytes() const { return tiles_ ? tiles_->bytes() : 0; }

 private:
  void dispatch(const gl::Program& program, const SampledVolume& volume, const std::vector<DepthView>& views,
                glm::dvec3 anchor, int bricks) const;
  CleanUpSettings settings_;
  std::optional<DepthTiles> tiles_;
  const gl::Program &everywhere_, &listed_;
};

/// Bricks along each axis of a grid. A brick has 32 x 8 x 8 voxels; its number counts along x first, then y.
glm::ivec3 brickCounts(const voxels::VoxelGrid& grid);
/// Uniforms of views and biases of shaders that include disproof.glsl.
void configureDisproof(const gl::Program& program, const CleanUpSettings& settings,
                       const std::vector<DepthView>& views, const voxels::VoxelGrid& grid, glm::dvec3 anchor);
gl::ShaderDefines disproofDefines(const CleanUpSettings& settings, const SampledVolume& volume, int views,
                                  int used, bool tiled = false);
void dispatchBricks(const gl::Program& program, const voxels::VoxelGrid& grid, int bricks);

}  // namespace limen::incremental_voxels
