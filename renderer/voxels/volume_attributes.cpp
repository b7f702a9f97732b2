// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/volume_attributes.h"

namespace limen::voxels {

bool VolumeAttributes::has(VoxelAttribute attribute) const {
  switch (attribute) {
    case VoxelAttribute::Occupancy:
      return occupancy;
    case VoxelAttribute::Albedo:
      return albedo;
    case VoxelAttribute::Normal:
      return normal;
    case VoxelAttribute::Light:
      return light;
    case VoxelAttribute::ShGrey:
      return shGrey;
    case VoxelAttribute::ShRed:
    case VoxelAttribute::ShGreen:
    case VoxelAttribute::ShBlue:
      return shColour;
  }
  return false;
}

int VolumeAttributes::count() const {
  int count = 0;
  for (const auto& entry : enumNames(VoxelAttribute{}).entries) count += has(entry.value) ? 1 : 0;
  return count;
}

SumLayout::SumLayout(const VolumeAttributes& attributes) {
  if (attributes.occupancy || attributes.normal) opacity = words++;
  first.fill(-1);
  for (const auto& [attribute, name] : enumNames(VoxelAttribute{}).entries) {
    if (attribute == VoxelAttribute::Occupancy || !attributes.has(attribute)) continue;
    first[static_cast<size_t>(attribute)] = words;
    words += attribute >= VoxelAttribute::ShGrey ? 4 : 3;
  }
}

}  // namespace limen::voxels
