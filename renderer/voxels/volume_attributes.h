// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "experiments/base/enum_names.h"
#include "renderer/gl/texture.h"

namespace limen::voxels {

/// Attachments of a volume: four floats a voxel each, 1,024 bits in all (Gaitatzes 2012, section 6.2). All
/// are 0 in empty voxels. Means are over a voxel's entries: a triangle enters a voxel once, by Coverage::Thin
/// once for each axis along which it meets the voxel's middle line.
enum class VoxelAttribute {
  Occupancy,  ///< r: mean opacity, 1 minus the mean channel of Material::transmittance; g: number of entries
  Albedo,     ///< rgb: mean reflectance; a: 1
  Normal,  ///< xyz: mean unit normal by the order of the triangles' vertices, shorter than 1; a: mean opacity
  Light,   ///< rgb: mean radiance that leaves surfaces: the lamps' light reflected once, and emission; a: 1
  ShGrey,  ///< mean of that radiance's luminance (Rec. 709), and of its three channels, as a lobe of
           ///< spherical
  ShRed,   ///< harmonics: radiance times the cosine from the lit side's normal, clamped at 0, per unit of
           ///< area.
  ShGreen,  ///< Coefficients in the order (0,0), (1,-1), (1,0), (1,1): about y, z and x, without the phase of
  ShBlue    ///< Condon and Shortley. A voxel's intensity is the lobe times the area of surface in it
};
inline constexpr int kVoxelAttributes = 8;
constexpr EnumNames<VoxelAttribute, 8> enumNames(VoxelAttribute) {
  return {{{{VoxelAttribute::Occupancy, "occupancy"},
            {VoxelAttribute::Albedo, "albedo"},
            {VoxelAttribute::Normal, "normal"},
            {VoxelAttribute::Light, "light"},
            {VoxelAttribute::ShGrey, "sh_grey"},
            {VoxelAttribute::ShRed, "sh_red"},
            {VoxelAttribute::ShGreen, "sh_green"},
            {VoxelAttribute::ShBlue, "sh_blue"}}}};
}

/// Which voxels have sums while a volume is filled.
enum class VoxelSums {
  Occupied,  ///< occupied ones, numbered once all bits are known: triangles are gone through twice
  All        ///< all of the grid
};
constexpr EnumNames<VoxelSums, 2> enumNames(VoxelSums) {
  return {{{{VoxelSums::Occupied, "occupied"}, {VoxelSums::All, "all"}}}};
}

/// What voxels hold besides whether a surface meets them.
struct VolumeAttributes {
  bool albedo = false;
  bool normal = false;
  gl::Format format = gl::Format::RGBA16F;  ///< RGBA16F or RGBA32F
  bool occupancy = false;
  bool light = false;
  bool shGrey = false;
  bool shColour = false;  ///< three attachments
  bool summed = true;     ///< filled through sums; otherwise by whoever writes attachments and bits
  bool pattern = true;    ///< reflectance with the solid textures of the materials
  /// Sums are fixed-point numbers. A voxel has at most this many entries (three a triangle always suffice):
  /// the fewer, the finer the steps; 2^31 / entries steps to 1, at most 2^20.
  int64_t mostEntries = 1 << 19;
  float largestLight = 16.0F;  ///< radiance is clamped to it; its steps are this times those of other sums
  /// Bytes that the volume may hold. Beyond it an Error, or, with `mayHalve`, RGBA16F in place of RGBA32F.
  int64_t budgetBytes = int64_t{4} << 30;
  bool mayHalve = false;
  VoxelSums sums = VoxelSums::All;
  int64_t mostOccupied = 0;  ///< that VoxelSums::Occupied has room for; 0: as many as the grid has
  bool joined = false;       ///< bits and sums alone, for Volume::finishWith() of another

  bool has(VoxelAttribute attribute) const;
  bool any() const { return count() > 0; }
  bool lit() const { return light || shGrey || shColour; }
  int count() const;  ///< attachments
  bool sumsOccupied() const { return any() && summed && sums == VoxelSums::Occupied; }
  int bitsPerVoxel() const { return count() * 8 * gl::bytesPerTexel(format); }
};

/// Where a voxel's sums lie among its words: the number of entries first, then what the attributes need.
struct SumLayout {
  explicit SumLayout(const VolumeAttributes& attributes);
  int words = 1;
  int opacity = -1;                           ///< of Occupancy and Normal
  std::array<int, kVoxelAttributes> first{};  ///< Albedo to ShBlue: first of three or four words; -1: none
};

}  // namespace limen::voxels
