// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "perception/metrics/color_video_vdp/atlas.h"
#include "perception/metrics/color_video_vdp/comparison_input.h"
#include "perception/metrics/color_video_vdp/pooling.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/gl/texture.h"

namespace limen::perception::cvvdp {

/// ColorVideoVDP on the GPU: evaluate() in single precision. Allocates everything once, for one image size,
/// and reads nothing back before finish() (of long videos, once in some hundred frames). Equal videos give 10
/// JOD exactly, and the same input the same bytes. Source: as evaluate().
class ColorVideoVdpGpu {
 public:
  /// For pairs of videos, or of images. Throws Error like check().
  ColorVideoVdpGpu(gl::Context& context, glm::ivec2 sizePx, const Options& options, bool video);

  /// Starts a pair. `frames` matters with symmetric padding only, which starts when it knows enough of them.
  void begin(int frames = 1);
  /// The next frame of both: any colour format; one channel is grey. The textures are read before the call
  /// returns to the GPU's queue and may be written again after it. With `passes`, stages are opened as passes
  /// "color_video_vdp/...".
  void add(const gl::Texture& test, const gl::Texture& reference, gl::PassList* passes = nullptr);
  /// Score of all frames since begin(); waits for the GPU.
  Score finish();

  /// Differences of the frames evaluated so far; waits for the GPU.
  const std::vector<FrameDifferences>& frames();

  /// Called after each evaluated frame, with its index; with symmetric padding several follow one add().
  std::function<void(int)> onFrame;
  /// Map of the frame evaluated last (Options::map); see evaluate(). Waits for the GPU.
  Image readMap() const;

  glm::ivec2 sizePx() const { return sizePx_; }
  bool isVideo() const { return taps_ > 0; }
  int64_t bytesHeld() const;

 private:
  struct Constants;
  const gl::Program& program(const char* name, const gl::ShaderDefines& extra = {}) const;
  void makeWeights();
  void read(const gl::Texture* test, const gl::Texture* reference, int frame, int stored);
  void evaluateFrame(gl::PassList* passes);
  void flush();

  gl::Context& context_;
  glm::ivec2 sizePx_;
  Options options_;
  std::vector<double> frequencies_;
  Atlas atlas_;
  int taps_;  ///< 0: images
  glm::ivec2 contrastGroups_{0}, maskGroups_{0};
  gl::ShaderDefines displayDefines_, mapDefines_;
  gl::Texture pyramid_;          ///< layers: test, reference
  gl::Texture mutual_, change_;  ///< what both contrasts have in common, and their difference
  gl::Texture map_;
  gl::Texture ringFirst_, ringSecond_;
  gl::Buffer constants_, sensitivities_, sums_, results_, weights_;
  int frames_ = 1, pushed_ = 0, evaluated_ = 0, unread_ = 0;
  std::vector<FrameDifferences> differences_;
};

/// evaluate() on the GPU: uploads the frames. `visitMap` receives each frame's map if Options::map is set.
Score evaluateOnGpu(gl::Context& context, const Pair& pair, const Options& options,
                    const std::function<void(int, const Image&)>& visitMap = {});

/// RGBA32F or, of a grey image, R32F.
gl::Texture uploadFrame(const Image& image);

}  // namespace limen::perception::cvvdp
