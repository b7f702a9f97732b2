// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/voxelization/voxel_attribute_settings.h"

#include <cstdint>

namespace limen::techniques {

const SettingsTable<VoxelStorageSettings>& VoxelStorageSettings::table() {
  using S = VoxelStorageSettings;
  static const SettingsTable<S> kTable = {
      {&S::format, "format", "Floats of the attributes", "Gaitatzes 2012, Table 7"},
      {&S::budgetMib, "budget_mib", {16, 65536}, "MiB", "Memory that the volume may take"},
      {&S::overBudget, "over_budget",
       "Beyond the budget: refuse to run, or take 16-bit floats if these fit (and refuse if not)"}};
  return kTable;
}

void VoxelStorageSettings::apply(voxels::VolumeAttributes& attributes) const {
  attributes.format = format == VoxelFormat::Full ? gl::Format::RGBA32F : gl::Format::RGBA16F;
  attributes.budgetBytes = int64_t{budgetMib} << 20;
  attributes.mayHalve = overBudget == OverBudget::Halve;
}

const SettingsTable<NoVoxelAttributes>& NoVoxelAttributes::table() {
  static const SettingsTable<NoVoxelAttributes> kTable = {};
  return kTable;
}

const SettingsTable<SurfaceVoxelAttributes>& SurfaceVoxelAttributes::table() {
  using S = SurfaceVoxelAttributes;
  static const SettingsTable<S> kTable = {
      {&S::upTo, "up_to", "Attachments: opacity and number of entries; mean normal; mean albedo",
       "Gaitatzes 2012, Table 4 (one to three)"},
      included(&S::storage)};
  return kTable;
}

const SettingsTable<LitVoxelAttributes>& LitVoxelAttributes::table() {
  using S = LitVoxelAttributes;
  static const SettingsTable<S> kTable = {
      {&S::lobes, "lobes",
       "Two bands of spherical harmonics of the light that leaves: of luminance (one attachment), of each "
       "colour (three), or both",
       "Gaitatzes 2012, section 6.2.3"},
      included(&S::storage),
      {&S::strength,
       "strength",
       {0.0, 10.0},
       "",
       "Radiance of a white surface that faces a lamp",
       "as frame::Shaded has it"},
      {&S::allLamps, "all_lamps", "Light of all lamps of the scene, eight at most, not of the first alone"},
      {&S::shadows, "shadows", "Rays to the lamps"}};
  return kTable;
}

voxels::VolumeAttributes volumeAttributes(const VoxelAttributeSetting& setting) {
  voxels::VolumeAttributes out;
  if (const auto* surface = std::get_if<SurfaceVoxelAttributes>(&setting)) {
    out.occupancy = true;
    out.normal = surface->upTo != SurfaceAttachments::Occupancy;
    out.albedo = surface->upTo == SurfaceAttachments::Albedo;
    surface->storage.apply(out);
  }
  if (const auto* lit = std::get_if<LitVoxelAttributes>(&setting)) {
    out.occupancy = out.normal = out.albedo = out.light = true;
    out.shGrey = lit->lobes == VoxelLobes::Grey || lit->lobes == VoxelLobes::Both;
    out.shColour = lit->lobes == VoxelLobes::Colour || lit->lobes == VoxelLobes::Both;
    lit->storage.apply(out);
  }
  return out;
}

}  // namespace limen::techniques
