// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "renderer/frame/shadow_map.h"
#include "renderer/techniques/soft_shadows/map_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Values of the first count channel, as in shadow_lookup.glsl.
enum PixelClass : uint32_t {
  NotReceiver = 0,
  Lit = 1,
  Umbra = 2,
  Processed = 3,
  Outside = 4,
  CutShort = 5,
  ClassCount = 6
};

/// Base of the soft-shadow techniques that read a shadow map, or several one after another: a compute pass
/// over the receivers into a visibility image, or several passes where the technique splits them. The shader
/// includes shadow_lookup.glsl, which declares what this class binds:
///   texture unit 0: receivers; unit 1: linear shadow map, unless bindMap() binds something else
///   image unit 0: visibility; units 1 and 2, where COUNT is defined: class, work and search of each pixel
///   (rgba32ui)
class VisibilityTechnique : public Technique {
 public:
  void prepare(frame::Frame& frame) override;
  void render(frame::Frame& frame) override;
  const gl::Texture& product() const override { return *visibility_; }
  /// Shares of lit, umbra, processed and outside pixels; micro-occluders, fetches and texels searched per
  /// processed pixel; the share of micro-occluders that were looked at for nothing.
  std::vector<Counter> count(frame::Frame& frame) override;

  /// What count() read, four figures a pixel: class, micro-occluders, fetches, level, rounded up where it
  /// lies between two; and search area in texels, micro-occluders looked at, those that covered any of the
  /// light, bits of the real level. Empty before count().
  struct Counted {
    glm::ivec2 sizePx{0};
    std::vector<uint32_t> work, search;
  };
  const Counted& counted() const { return counted_; }

  /// What count() returns.
  static std::vector<Quantity> quantities();

 protected:
  /// `shader` is a path from the repository root, `pass` the name in the pass list.
  VisibilityTechnique(const MapSettings& map, const SlopeBias& bias, std::string shader, std::string pass,
                      gl::ShaderDefines defines = {});

  /// Of the map that is read at present.
  const frame::ShadowMapSettings& mapSettings() const { return maps_[current_]; }
  /// Number of the map that is read at present, from 0 on.
  size_t currentMap() const { return current_; }
  const std::vector<frame::ShadowMapSettings>& maps() const { return maps_; }
  /// Has several maps read one after another, a dispatch each, which the shader joins; at least one.
  void setMaps(std::vector<frame::ShadowMapSettings> maps) { maps_ = std::move(maps); }
  /// Whether the present frame reads a map.
  virtual bool readsMap(const frame::Frame&, size_t) const { return true; }
  /// After the last map; opens its own passes.
  virtual void finish(frame::Frame&) {}
  /// Adds to what the shader is compiled with; before prepare() of this class.
  void define(const std::string& name, const std::string& value) { defines_[name] = value; }
  /// Makes and binds the map, from texture unit 1; returns its frustum.
  virtual const frame::LightFrustum& bindMap(frame::Frame& frame);
  /// The map's pyramid, for bindMap(): minimum at texture unit 1, maximum at 2. Call it last there, since
  /// making other inputs binds textures too; sets pyramidLevels().
  const frame::LightFrustum& bindPyramid(frame::Frame& frame);
  /// Levels of the pyramid that was bound last.
  int pyramidLevels() const { return pyramidLevels_; }
  /// Iterations that a loop of the shader may have: llvmpipe leaves all loops silently after 65,535.
  static int maxIterations(frame::Frame& frame);
  /// Sets the technique's own uniforms.
  virtual void configure(const gl::Program& program) const = 0;

  struct CountImages {
    gl::Texture work, search;
  };
  /// Compiles and allocates what runPasses() needs in a plain frame, and states the bytes held.
  virtual void preparePasses(frame::Frame& frame);
  /// Before the first map: inputs that are made once a frame, in passes of their own.
  virtual void makeInputs(frame::Frame&) {}
  /// Opens the technique's passes and fills the product; all inputs have been made. Whoever overrides it
  /// calls addCounts() once the map's pixels are counted. `counts` is null in a plain frame.
  virtual void runPasses(frame::Frame& frame, const CountImages* counts);

  const std::string& passName() const { return pass_; }
  /// The technique's shader; compiles it the first time.
  const gl::Program& program(frame::Frame& frame, bool counting, const gl::ShaderDefines& more = {}) const;
  /// Sets and binds all that shadow_lookup.glsl declares, of the map that is read at present.
  void bindPass(frame::Frame& frame, const gl::Program& program, const CountImages* counts);
  /// Adds what the passes over a map counted.
  void addCounts(const CountImages& counts);

 private:
  /// `counts` is null in a plain frame.
  void run(frame::Frame& frame, const CountImages* counts);

  std::vector<frame::ShadowMapSettings> maps_;
  size_t current_ = 0;
  int pyramidLevels_ = 0;
  double bias_, slopeBias_, maxSlope_;
  std::string shader_, pass_;
  gl::ShaderDefines defines_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> visibility_;
  Counted counted_;
};

}  // namespace limen::techniques
