// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/shader_source.h"
#include "renderer/many_lods/multi_cut.h"

namespace limen::many_lods {

/// What a pixel of a tile keeps of the nearest node.
enum class AtlasForm {
  Depth,      ///< its depth: the bits of a float in [0, 1), in units of the view's range
  TwoPasses,  ///< its depth, and in a second pass the lowest node of that depth
  Wide,       ///< both in one 64-bit word, where the driver has atomic operations on these
  TwoWords    ///< 20 bits of depth and 12 of the colour in each of two words (FreePipe; depth_packing.h)
};
constexpr EnumNames<AtlasForm, 4> enumNames(AtlasForm) {
  return {{{{AtlasForm::Depth, "depth"},
            {AtlasForm::TwoPasses, "two_passes"},
            {AtlasForm::Wide, "wide"},
            {AtlasForm::TwoWords, "two_words"}}}};
}

/// What stands for a node in a tile.
enum class Discs {
  Spheres,  ///< the disc that its sphere projects to, at one depth, and at least a pixel
  Oriented  ///< the disc in the plane of its normals, as pixels' middles see it: surfaces grow less, and have
            ///< the depth of their planes
};
constexpr EnumNames<Discs, 2> enumNames(Discs) {
  return {{{{Discs::Spheres, "spheres"}, {Discs::Oriented, "oriented"}}}};
}

/// What is drawn: entries as in a list of cuts, and a CutControl that has their number, their place and the
/// arguments of a dispatch over them.
struct DrawList {
  const gl::Buffer& list;
  const gl::Buffer& control;
};

/// Tiles of many views, of one size, drawn from the list of their cuts in compute: each node as the disc that
/// its sphere projects to (a hemisphere's projection is stereographic, so that it is a disc; in a perspective
/// view it is one of the middle's size), and at least the pixel that its centre is in. No pixel of another
/// tile is written. Depth: distance of the sphere's centre from the eye in a hemisphere, along the axis in a
/// perspective view, over the view's range; what lies farther has kFarthestDepth. Discs::Oriented: of the
/// disc's plane where a pixel's middle sees it. Source: Holländer 2013,
/// sections 3.5.3 and 3.7.2; the projections are the bench's own, as the thesis names none.
class ViewAtlas {
 public:
  /// `leavesOwnOut`: nodes of the object that a view belongs to (CutView::frustum.w) are not drawn; not
  /// TwoWords. Wide becomes TwoPasses where the driver lacks 64-bit atomic operations. Throws Error if the
  /// device cannot hold it.
  ViewAtlas(gl::Context& context, uint32_t views, glm::ivec2 tilePx, AtlasForm form,
            Discs discs = Discs::Spheres, bool leavesOwnOut = false);

  struct Settings {
    float nearest = 0.0F;                ///< nodes whose centres are nearer are left out, world units
    float radiusScale = 1.0F;            ///< of discs over spheres
    const gl::Buffer* cones = nullptr;   ///< of the nodes (GpuTree::cones()); Discs::Oriented only
    const gl::Buffer* owners = nullptr;  ///< of the nodes: number of an object or 0; `leavesOwnOut` only
  };
  /// Clears the tiles and draws a list. `colours`: of the nodes, four halves each; TwoWords only.
  void draw(const DrawList& what, const gl::Buffer& nodes, const gl::Buffer& views, const Settings& settings,
            const gl::Buffer* colours = nullptr) const;
  void draw(const MultiCut& cut, const gl::Buffer& nodes, const gl::Buffer& views, const Settings& settings,
            const gl::Buffer* colours = nullptr) const {
    draw(DrawList{cut.listBuffer(), cut.controlBuffer()}, nodes, views, settings, colours);
  }
  void clear() const;

  AtlasForm form() const { return form_; }
  glm::ivec2 tilePx() const { return tilePx_; }
  /// A word for each pixel, tile after tile: kAtlasEmpty where nothing is. Wide: node, then depth, for each
  /// pixel.
  const gl::Buffer& depths() const { return depths_; }
  /// TwoPasses: nodes; TwoWords: the other word.
  const gl::Buffer& winners() const { return *winners_; }
  int64_t bytes() const { return depths_.bytes() + (winners_ ? winners_->bytes() : 0); }

 private:
  AtlasForm form_;
  glm::ivec2 tilePx_;
  gl::Buffer depths_;
  std::optional<gl::Buffer> winners_;
  const gl::Program *first_, *second_ = nullptr;
};

bool hasWideAtomics();
/// For programs that include splat_disc.glsl.
gl::ShaderDefines discDefines(Discs discs);

}  // namespace limen::many_lods
