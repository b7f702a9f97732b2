// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/voxelization/voxel_technique.h"

#include <epoxy/gl.h>

#include "renderer/scene/part_motion.h"
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/exact_attributes.h"
#include "renderer/voxels/exact_voxels.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kPicturePass = "voxelization/picture";

}  // namespace

const SettingsTable<VoxelGridSettings>& VoxelGridSettings::table() {
  using S = VoxelGridSettings;
  static const SettingsTable<S> kTable = {
      {&S::resolution,
       "resolution",
       {1, 512},
       "voxels",
       "Of the longest side of the grid",
       "Gaitatzes 2012, Table 3"},
      {&S::box, "box", "What the grid's box encloses: the whole scene, or what casts shadows in it"}};
  return kTable;
}

void VoxelTechnique::prepare(frame::Frame& frame) {
  const scene::Bounds bounds =
      gridSettings_.box == GridBox::Casters ? frame.scene().casterBounds() : frame.scene().bounds();
  const voxels::VoxelGrid grid = voxels::tightGrid(bounds, gridSettings_.resolution);
  voxels::VolumeAttributes attributes = this->attributes(frame, grid);
  // By Coverage::Thin a triangle enters a voxel three times at most.
  attributes.mostEntries = 3 * int64_t{frame.gpuScene().triangleCount()};
  volume_.emplace(frame.context(), grid, frame.gpuScene().anchor(), attributes);
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  show_ = &frame.context().programs().compute("renderer/techniques/voxelization/voxel_picture.comp.glsl",
                                              volume_->defines());
  const int64_t bytes = prepareForm(frame, *volume_);
  frame.passes().setBytesHeld(pass_, volume_->bytes() + bytes);
  frame.passes().setBytesHeld(kPicturePass, picture_->bytes());
}

void VoxelTechnique::render(frame::Frame& frame) {
  beforeFill(frame);
  {
    const auto scope = frame.passes().open(pass_);
    fill(frame, *volume_);
  }
  const auto scope = frame.passes().open(kPicturePass);
  volume_->configure(*show_);
  show_->set("cameraToAnchor", glm::mat4(glm::inverse(frame.anchorToCamera())));
  show_->set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  show_->set("sizePx", frame.sizePx());
  picture_->bindImage(kVoxelPictureImage, gl::Access::Write);
  show_->use();
  show_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

std::vector<Counter> VoxelTechnique::count(frame::Frame& frame) {
  const scene::Mesh mesh =
      frame.scene().motions.empty() ? frame.scene().mesh : scene::movedTo(frame.scene(), frame.timeS()).mesh;
  const voxels::VoxelGrid& grid = volume_->grid();
  const std::vector<uint8_t> found = volume_->readOccupied();
  const std::vector<uint8_t> exact = voxels::exactVoxels(mesh, grid);
  const voxels::SetDifference difference = voxels::compare(found, exact);
  // A middle line's ends are left out, where rounding decides.
  const int64_t holes =
      voxels::compare(found, voxels::separatingVoxels(mesh, grid, 2.0 * voxels::kVoxelSlack)).missing;
  std::vector<Counter> counters = {{"voxels", double(voxels::countOf(found))},
                                   {"exact_voxels", double(voxels::countOf(exact))},
                                   {"missing_voxels", double(difference.missing)},
                                   {"extra_voxels", double(difference.extra)},
                                   {"hole_voxels", double(holes)},
                                   {"volume_mib", double(volume_->bytes()) / 1048576.0},
                                   {"voxel_bits", double(volume_->attributes().bitsPerVoxel())}};
  if (volume_->attributes().albedo && volume_->attributes().normal) {
    const voxels::AttributeError error =
        voxels::compare(*volume_, voxels::exactAttributes(frame.scene(), mesh, grid));
    counters.push_back({"albedo_rms", error.albedo});
    counters.push_back({"normal_rms_deg", error.normalDeg});
  }
  const std::vector<Counter> own = countForm(*volume_);
  counters.insert(counters.end(), own.begin(), own.end());
  return counters;
}

std::vector<Quantity> VoxelTechnique::quantities() {
  const std::string table = "Gaitatzes 2012, Table 3";
  return {{"voxels", "Occupied voxels", "", Direction::Neither, table},
          {"exact_voxels", "Voxels that the surfaces meet", "", Direction::Neither},
          {"missing_voxels", "Voxels that the surfaces meet, but empty", "", Direction::LowerIsBetter},
          {"extra_voxels", "Occupied voxels that no surface meets", "", Direction::LowerIsBetter},
          {"hole_voxels", "Empty voxels with a middle line through a surface", "", Direction::LowerIsBetter,
           "Laine 2013"},
          {"volume_mib", "Memory of the volume, with the sums that means are made of", "MiB",
           Direction::LowerIsBetter, table},
          {"voxel_bits", "Bits of a voxel's attributes", "", Direction::Neither,
           "Gaitatzes 2012, section 6.2 (1,024)"},
          {"albedo_rms", "Error of voxels' albedos, of the means over their surfaces", "",
           Direction::LowerIsBetter},
          {"normal_rms_deg", "Angle between voxels' normals and the means over their surfaces", "deg",
           Direction::LowerIsBetter}};
}

}  // namespace limen::techniques
