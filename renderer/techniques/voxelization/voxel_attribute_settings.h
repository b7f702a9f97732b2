// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/voxels/volume_attributes.h"
#include "renderer/voxels/voxelizer.h"

namespace limen::techniques {

/// Floats of a voxel's attributes.
enum class VoxelFormat { Half, Full };
constexpr EnumNames<VoxelFormat, 2> enumNames(VoxelFormat) {
  return {{{{VoxelFormat::Half, "16f"}, {VoxelFormat::Full, "32f"}}}};
}

/// What becomes of a volume that exceeds its budget.
enum class OverBudget { Refuse, Halve };
constexpr EnumNames<OverBudget, 2> enumNames(OverBudget) {
  return {{{{OverBudget::Refuse, "refuse"}, {OverBudget::Halve, "halve"}}}};
}

struct VoxelStorageSettings {
  VoxelFormat format = VoxelFormat::Half;
  int budgetMib = 4096;
  OverBudget overBudget = OverBudget::Refuse;
  static const SettingsTable<VoxelStorageSettings>& table();
  void apply(voxels::VolumeAttributes& attributes) const;
};

/// Attachments without light, each with those before it.
enum class SurfaceAttachments { Occupancy, Normal, Albedo };
constexpr EnumNames<SurfaceAttachments, 3> enumNames(SurfaceAttachments) {
  return {{{{SurfaceAttachments::Occupancy, "occupancy"},
            {SurfaceAttachments::Normal, "normal"},
            {SurfaceAttachments::Albedo, "albedo"}}}};
}

/// Spherical harmonics of the light that leaves a voxel.
enum class VoxelLobes { None, Grey, Colour, Both };
constexpr EnumNames<VoxelLobes, 4> enumNames(VoxelLobes) {
  return {{{{VoxelLobes::None, "none"},
            {VoxelLobes::Grey, "grey"},
            {VoxelLobes::Colour, "colour"},
            {VoxelLobes::Both, "both"}}}};
}

struct NoVoxelAttributes {
  static constexpr const char *kKind = "none", *kSummary = "a bit a voxel";
  static const SettingsTable<NoVoxelAttributes>& table();
};
struct SurfaceVoxelAttributes {
  static constexpr const char *kKind = "surface",
                              *kSummary = "what surfaces are like: up to three attachments";
  SurfaceAttachments upTo = SurfaceAttachments::Albedo;
  VoxelStorageSettings storage;
  static const SettingsTable<SurfaceVoxelAttributes>& table();
};
struct LitVoxelAttributes {
  static constexpr const char *kKind = "lit",
                              *kSummary = "that and their direct light, of lamps and emission: up to eight";
  VoxelLobes lobes = VoxelLobes::None;
  VoxelStorageSettings storage;
  double strength = 0.8;
  bool allLamps = false;
  bool shadows = true;
  static const SettingsTable<LitVoxelAttributes>& table();
  voxels::VoxelLamps lamps() const { return {.strength = strength, .all = allLamps, .shadows = shadows}; }
};
using VoxelAttributeSetting = std::variant<NoVoxelAttributes, SurfaceVoxelAttributes, LitVoxelAttributes>;

voxels::VolumeAttributes volumeAttributes(const VoxelAttributeSetting& setting);

}  // namespace limen::techniques
