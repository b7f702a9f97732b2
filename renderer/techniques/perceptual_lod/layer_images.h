// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/gl/texture.h"
#include "renderer/techniques/perceptual_lod/level_view.h"
#include "renderer/techniques/perceptual_lod/settings.h"

namespace limen::techniques {

/// The picture split into layers (Schwarz 2009, section 9.5): layer 0 is the background, layers 1.. hold
/// objects by distance. All colours are linear RGBA32F as in frame::Shaded.
///
/// Each layer is lit with the shadows of everything. The composite keeps, for each pixel, the nearest surface
/// and the nearest one of another layer, which is all that each C_i needs. Depths are the raster's own, so
/// the composite equals the ordinary picture bit for bit.
class LayerImages {
 public:
  LayerImages(frame::Frame& parent, const PerceptualLodSettings& settings);

  int layers() const { return static_cast<int>(layers_.size()); }  ///< the background included
  /// Renders all non-empty layers and their composite. `layerOf`: 1.. for each object.
  void render(double timeS, const scene::LodSelection& shown, const std::vector<int>& layerOf);
  /// Computes M_i, if shadows are a pattern, and C_i of a layer of the last render().
  void makeContext(int layer);
  /// Runs every input and pass once, so that none is new in a timed frame.
  void prime(double timeS);

  const gl::Texture& composite() const { return frontColour_; }
  const gl::Texture& frontKey() const { return frontKey_; }  ///< RGBA32UI: depth's bits, triangle, layer
  const gl::Texture& secondColour() const { return secondColour_; }
  const gl::Texture& secondKey() const { return secondKey_; }
  const gl::Texture& image(int layer);          ///< O_i
  const gl::Texture* mask(int layer) const;     ///< M_i: R32F, 0 or 1; null without shadow masks
  const gl::Texture& context(int layer) const;  ///< C_i of a layer of objects
  /// The shadow casters of the frame; null without shadows.
  frame::Frame* casters() { return casters_ ? &casters_->frame() : nullptr; }
  /// The camera of the last render().
  const frame::Frame& view() { return layers_[0]->view.frame(); }
  const scene::LodSelection& shown() const { return shown_; }
  int layersDrawn() const { return layersDrawn_; }
  bool hasShadows() const { return casters_ != nullptr; }

 private:
  struct Layer {
    Layer(frame::Frame& parent, const std::string& name) : view(parent, name) {}
    LevelView view;
    bool drawn = false;
    std::optional<gl::Texture> context, mask;
    std::unique_ptr<LevelView> others;  ///< all casters except the layer's own
  };
  scene::LodSelection selectionOf(int layer) const;
  void drawLayer(int layer);
  void compositeLayers(const std::vector<int>& drawn);

  frame::Frame& parent_;
  const frame::ShadedSetting shading_;
  const double attenuation_;
  const gl::Program &compositeProgram_, &contextProgram_, &maskProgram_;
  gl::Texture frontColour_, frontKey_, secondColour_, secondKey_;
  std::unique_ptr<LevelView> casters_;
  std::vector<std::unique_ptr<Layer>> layers_;
  double timeS_ = 0.0;
  scene::LodSelection shown_;
  std::vector<int> layerOf_;
  int layersDrawn_ = 0;
};

}  // namespace limen::techniques
