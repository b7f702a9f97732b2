// SPDX-License-Identifier: BSD-3-Clause
// A bit of a colour for each voxel along a view, all set by drawing the scene once (BL-06). Source: Eisemann
// and Décoret 2006; the union of three views as in Gaitatzes 2012, Table 5. Slices of 128 bits a target, at
// most four targets.
#include <epoxy/gl.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/techniques/voxelization/voxel_technique.h"
#include "renderer/techniques/voxelization/voxelization_bindings.h"

namespace limen::techniques {
namespace {

constexpr int kMaskBits = 128;

enum class MaskViews { X, Y, Z, All };
constexpr EnumNames<MaskViews, 4> enumNames(MaskViews) {
  return {{{{MaskViews::X, "x"}, {MaskViews::Y, "y"}, {MaskViews::Z, "z"}, {MaskViews::All, "all"}}}};
}

struct BitMaskSettings {
  VoxelGridSettings grid;
  MaskViews views = MaskViews::All;
  static const SettingsTable<BitMaskSettings>& table() {
    using S = BitMaskSettings;
    static const SettingsTable<S> kTable = {
        included(&S::grid),
        {&S::views, "views", "Axis that the scene is seen along, or all three", "Gaitatzes 2012, Table 5"}};
    return kTable;
  }
};

class BitMasks : public VoxelTechnique {
 public:
  using Settings = BitMaskSettings;
  explicit BitMasks(const BitMaskSettings& settings)
      : VoxelTechnique(settings.grid, "voxelization/bit_masks"), settings_(settings) {}

 protected:
  int64_t prepareForm(frame::Frame& frame, const voxels::Volume& volume) override {
    const glm::ivec3 size = volume.grid().resolution;
    const std::array<const char*, 3> seen = {"SEEN_X", "SEEN_Y", "SEEN_Z"};
    gl::ShaderDefines defines;
    int64_t bytes = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (settings_.views != MaskViews::All && axis != static_cast<int>(settings_.views)) continue;
      const int targets = (size[axis] + kMaskBits - 1) / kMaskBits;
      View view{.axis = axis,
                .program = &frame.context().programs().get(
                    {"renderer/techniques/voxelization/bit_mask.vert.glsl",
                     "renderer/techniques/voxelization/bit_mask.frag.glsl"},
                    {{"AXIS", std::to_string(axis)}, {"TARGETS", std::to_string(targets)}}),
                .masks = gl::Texture(gl::Format::RGBA32UI, {size[(axis + 1) % 3], size[(axis + 2) % 3]}, 1,
                                     targets),
                .layers = {},
                .target = {}};
      std::vector<const gl::Texture*> layers;
      for (int i = 0; i < targets; ++i) view.layers.push_back(view.masks.view(i));
      for (const gl::Texture& layer : view.layers) layers.push_back(&layer);
      view.target.emplace(layers, nullptr);
      bytes += view.masks.bytes();
      defines[seen[static_cast<size_t>(axis)]] = "1";
      views_.push_back(std::move(view));
    }
    merge_ = &frame.context().programs().compute("renderer/techniques/voxelization/merge_masks.comp.glsl",
                                                 defines);
    return bytes;
  }

  void fill(frame::Frame& frame, const voxels::Volume& volume) override {
    constexpr std::array<GLuint, 4> kEmpty = {0, 0, 0, 0};
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_OR);
    for (const View& view : views_) {
      view.target->bind();
      for (size_t i = 0; i < view.layers.size(); ++i)
        glClearBufferuiv(GL_COLOR, static_cast<GLint>(i), kEmpty.data());
      volume.configure(*view.program);
      view.program->use();
      frame.geometry().draw();
    }
    glDisable(GL_COLOR_LOGIC_OP);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    for (const View& view : views_) view.masks.bindTexture(kMaskXUnit + static_cast<uint32_t>(view.axis));
    volume.bits().bindImage(kMergedBitsImage, gl::Access::Write);
    volume.configure(*merge_);
    merge_->use();
    const glm::ivec3 words(volume.bits().sizePx(), volume.grid().resolution.z);
    glDispatchCompute(static_cast<GLuint>(words.x), static_cast<GLuint>((words.y + 63) / 64),
                      static_cast<GLuint>(words.z));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

 private:
  struct View {
    int axis;
    const gl::Program* program;
    gl::Texture
        masks;  // a layer for 128 voxels along the axis; x and y are the next two axes in cyclic order
    std::vector<gl::Texture> layers;
    std::optional<gl::Framebuffer> target;
  };
  BitMaskSettings settings_;
  std::vector<View> views_;
  const gl::Program* merge_ = nullptr;
};

const RegisteredTechnique<BitMasks> kBitMasks{
    {.name = "voxelization/bit_masks",
     .version = 1,
     .summary =
         "A bit of a colour for each voxel along one or three views, set by drawing the scene once a view",
     .source = "Eisemann and Décoret 2006; Gaitatzes 2012, Table 5 (BL-06)",
     .product = ProductKind::Colour,
     .followsMotion = true,
     .counters = VoxelTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
