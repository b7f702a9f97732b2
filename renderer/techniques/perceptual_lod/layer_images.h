// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/region_raster.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/perceptual_lod/level_view.h"
#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"
#include "renderer/techniques/perceptual_lod/settings.h"

namespace limen::techniques {

/// An object that a frame tests, and what is drawn for that.
struct ObjectTest {
  int object = 0, level = 0;
  bool finest = false;  ///< the finest level as well; without: the object is shown with it
  bool next = false;    ///< the next coarser level as well
};

/// The picture split into layers (Schwarz 2009, section 9.5): layer 0 is the background, layers 1.. hold
/// objects by distance. Layers and the versions of objects under test are drawn together, each into a
/// rectangle of its own (see frame::RegionRaster), once for the camera and, if there are shadows, once for
/// the light: nothing is drawn twice.
///
/// Each layer is lit with the shadows of everything. For each pixel the nearest surface and the nearest one
/// of another layer count, which is all that each C_i needs. Depths are the raster's own, so the picture
/// equals the ordinary one bit for bit.
class LayerImages {
 public:
  LayerImages(frame::Frame& parent, const PerceptualLodSettings& settings, const SeenOn& seenOn);
  ~LayerImages();

  int layers() const { return layers_; }  ///< the background included
  /// The camera of the frames to come, for pixelsOf().
  const frame::Frame& moveTo(double timeS);
  /// How many of these tests, from the first on, fit into one frame: at least one.
  size_t fitting(const std::vector<ObjectTest>& tests) const;
  /// Draws everything. `layerOf`: 1.. for each object.
  void draw(const scene::LodSelection& shown, const std::vector<int>& layerOf,
            const std::vector<ObjectTest>& tests);
  /// The picture and, if `mappedLayer` > 0, C_i of that layer.
  void compose(int mappedLayer);
  /// What gathered.glsl reads.
  void bindGathered(const gl::Program& program);
  /// Defines of programs that include gathered.glsl.
  gl::ShaderDefines defines() const;

  const gl::Texture& picture() const { return picture_; }  ///< linear RGBA32F as in frame::Shaded
  /// R32F, cd/m2: what the picture would show without the layer of which a pixel shows an object. Where
  /// compose() has mapped that layer.
  const gl::Texture& behind() const { return behind_; }
  const gl::Texture& context() const { return context_; }  ///< C_i, R32F, cd/m2, of the last layer mapped
  const scene::LodSelection& shown() const { return shown_; }
  int layersDrawn() const { return layersDrawn_; }
  uint64_t trianglesTested() const {
    return trianglesTested_;
  }  ///< drawn for tests only, shadows not counted
  /// Of the last draw(), for looking at: "layer_i", "shadow_mask_i" (0 or 1; if shadows are a pattern),
  /// "background". Slow.
  std::map<std::string, const gl::Texture*> views();

 private:
  void plan(const std::vector<int>& layerOf, const std::vector<ObjectTest>& tests);
  int64_t wordsOf(const ObjectTest& test) const;
  void upload();
  void bindTables() const;
  PixelRect lightPixelsOf(const scene::Bounds& bounds) const;

  frame::Frame& parent_;
  const frame::ShadedSetting shading_;
  const double attenuation_;
  const float blackCdM2_, rangeCdM2_;
  const int layers_;
  frame::Frame view_;
  std::optional<frame::LightFrustum> light_;
  std::unique_ptr<frame::RegionRaster> camera_, shadows_;
  std::vector<PixelRect> lightPixels_;  ///< of each object, in the shadow map
  const gl::Program *clear_ = nullptr, *compose_ = nullptr, *layerView_ = nullptr;
  gl::Texture picture_, behind_, context_;
  int64_t testWords_ = 0;
  std::optional<gl::Buffer> gathered_;
  std::optional<gl::Buffer> plan_;  ///< table of regions, tests, ranges of triangles: uploaded together

  // Of the last draw().
  scene::LodSelection shown_;
  std::vector<frame::RasterRegion> table_;
  std::vector<PlannedTest> tests_;
  std::vector<frame::RegionContent> cameraRegions_, lightRegions_;
  std::vector<glm::uvec4> cameraRanges_, lightRanges_;
  int testCount_ = 0, layersDrawn_ = 0;
  uint64_t trianglesTested_ = 0;
  std::vector<char> drawn_;
  std::map<std::string, gl::Texture> views_;
};

}  // namespace limen::techniques
