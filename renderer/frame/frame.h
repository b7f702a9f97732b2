// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>

#include "renderer/frame/compute_raster.h"
#include "renderer/frame/gpu_scene.h"
#include "renderer/frame/moved_vertices.h"
#include "renderer/frame/scene_on_gpu.h"
#include "renderer/frame/shown_mirrors.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/lod_set.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

class Frame;

/// What each pixel of a frame sees if that is not what lies behind its centre: individually chosen positions
/// in a picture. Neighbouring pixels need not be neighbours in the picture.
struct Seen {
  const gl::Texture* ids = nullptr;     ///< R32UI: triangle, or TriangleIds::kNone: this pixel sees nothing
  const gl::Texture* places = nullptr;  ///< RG32F: position in the picture, pixels from its top left corner
  glm::ivec2 pictureSizePx{0};          ///< of the camera's picture
};

/// Something several techniques need of a frame: a G-buffer channel, a shadow map, a pyramid. Made only when
/// a frame first asks for it; its memory is kept for the next frame.
class FrameInput {
 public:
  /// Whether it depends on which mirrors are shown; see Frame::shownMirrors().
  static constexpr bool kOfShownMirrors = false;
  virtual ~FrameInput() = default;
  /// Renders the input for the current frame; opens its own passes and states their bytes.
  virtual void make(Frame& frame) = 0;
};

/// One view of one scene, rendered repeatedly. Inputs are asked for by type:
/// `frame.get<ShadowMap>(settings)`. An input class has a constructor (Frame&, Settings...) and each setting
/// has `std::string key() const`.
class Frame {
 public:
  Frame(gl::Context& context, const scene::Scene& scene, const GpuScene& gpuScene, glm::ivec2 sizePx,
        double timeS = 0.0, Raster raster = Raster::Auto);
  Frame(gl::Context& context, const SceneOnGpu& onGpu, glm::ivec2 sizePx, double timeS = 0.0,
        Raster raster = Raster::Auto)
      : Frame(context, onGpu.scene, onGpu.gpu, sizePx, timeS, raster) {}
  /// Another view or another selection of levels within a frame of `parent`: its own inputs; passes in the
  /// parent's list, prefixed "`name`/". Starts at the parent's time with the finest levels; call its begin()
  /// after its parent's.
  Frame(Frame& parent, const std::string& name, glm::ivec2 sizePx);

  /// The same view within a frame of `parent`, but of `scene`: the parent's scene except for its lights.
  Frame(Frame& parent, const std::string& name, const scene::Scene& scene);

  /// The same view within a frame of `parent`, of whose mirrors it shows `mirrors` alone. It shares all
  /// inputs of its parent that do not depend on these, and what the parent is told: its levels, positions and
  /// what it sees.
  Frame(Frame& parent, const std::string& name, const ShownMirrors& mirrors);

  gl::Context& context() { return context_; }
  const scene::Scene& scene() const { return scene_; }
  const GpuScene& gpuScene() const { return gpuScene_; }
  glm::ivec2 sizePx() const { return sizePx_; }
  const scene::Camera& camera() const { return camera_; }
  gl::PassList& passes() {
    passes_->setPrefix(prefix_);
    return *passes_;
  }
  /// How the G-buffer is rasterised; shadow maps have their own setting.
  Raster raster() const { return raster_; }

  /// Camera space (looking along -z) of positions relative to the scene's anchor.
  const glm::dmat4& anchorToCamera() const { return anchorToCamera_; }
  /// tan of half the vertical field of view, and width over height.
  double tanHalfFov() const { return tanHalfFov_; }
  double aspect() const { return double(sizePx_.x) / sizePx_.y; }

  double timeS() const { return timeS_; }
  /// Moves on the camera path and in the parts' motions; inputs made before the next begin() are stale.
  void setTime(double timeS);
  /// Chooses the levels of the scene's LOD objects (see scene/lod_set.h). Without a call: the finest.
  void setLevels(const scene::LodSelection& selection);
  /// Replaces vertex positions, of all levels, three floats each relative to the anchor; null: the scene's.
  /// Not for scenes whose parts move.
  void setPositions(const gl::Buffer* positions) { positions_ = positions; }
  /// Mirrors that reflect where they are seen; others look like surfaces that do not. In other mirrors all of
  /// them reflect as ever. Without a call: all. Call it before the first get().
  void setShownMirrors(const ShownMirrors& mirrors) { shownMirrors_ = mirrors; }
  const ShownMirrors& shownMirrors() const { return shownMirrors_; }
  /// Storage of the surfaces' shading, with the normals of this frame.
  void bindSurfaces() const;
  /// The vertices' positions of this frame.
  const gl::Buffer& positions() const {
    if (sharing_) return sharing_->positions();
    return positions_ ? *positions_ : gpuScene_.positions();
  }
  /// Where parts move; null: all rest.
  const MovedVertices* moved() const { return moved_.get(); }
  /// Fills the G-buffer from chosen positions instead of rasterising. Call it before the first get(); the
  /// textures must hold what is seen when an input is made, and outlive this frame.
  void setSeen(const Seen& seen) { seen_ = seen; }
  /// Null: what lies behind the centres.
  const Seen* seen() const {
    if (sharing_) return sharing_->seen();
    return seen_.ids ? &seen_ : nullptr;
  }
  /// Takes shadow maps from another view, whose levels cast the shadows here; null: from this one. Call its
  /// begin() first; it must outlive this frame.
  void setCasters(Frame* casters) { casters_ = casters; }
  Frame& casters() {
    if (sharing_) return sharing_->casters();
    return casters_ ? *casters_ : *this;
  }
  /// What inputs rasterise.
  Geometry geometry() const {
    if (sharing_) return sharing_->geometry();
    return {gpuScene_, ranges_.get(), positions_};
  }

  /// Starts a frame: inputs are stale and are made again on request. Parts that move are where they are at
  /// the frame's time; of a view within another frame, at that frame's.
  void begin();
  void end();

  template <class Input, class... Settings>
  const Input& get(const Settings&... settings) {
    if constexpr (!Input::kOfShownMirrors)
      if (sharing_) return sharing_->get<Input>(settings...);
    std::string key = Input::kName;
    ((key += "|" + settings.key()), ...);
    Entry& entry = entries_[key];
    if (!entry.input) entry.input = std::make_unique<Input>(*this, settings...);
    if (entry.madeIn != number_) {
      entry.madeIn = number_;  // before make(): an input that asks for itself is a programmer error
      entry.input->make(*this);
    }
    return static_cast<const Input&>(*entry.input);
  }

 private:
  struct Entry {
    std::unique_ptr<FrameInput> input;
    uint64_t madeIn = 0;
  };

  Frame(Frame& parent, const std::string& name, const scene::Scene& scene, glm::ivec2 sizePx);

  gl::Context& context_;
  const scene::Scene& scene_;
  const GpuScene& gpuScene_;
  glm::ivec2 sizePx_;
  Raster raster_;
  double timeS_ = 0.0;
  scene::Camera camera_;
  glm::dmat4 anchorToCamera_{1.0};
  double tanHalfFov_ = 1.0;
  std::unique_ptr<gl::PassList> ownPasses_;  // null in a view within another frame
  gl::PassList* passes_;
  std::string prefix_;
  std::unique_ptr<TriangleRanges> ranges_;
  std::shared_ptr<const MovedVertices> moved_;  // null: all rest
  const gl::Buffer* positions_ = nullptr;
  Frame* casters_ = nullptr;
  Frame* sharing_ = nullptr;  // whose inputs these are
  ShownMirrors shownMirrors_;
  Seen seen_;
  std::map<std::string, Entry> entries_;
  uint64_t number_ = 0;
};

}  // namespace limen::frame
