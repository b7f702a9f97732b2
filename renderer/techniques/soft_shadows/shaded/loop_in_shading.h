// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/search_technique.h"
#include "renderer/techniques/soft_shadows/shaded/shaded_settings.h"

namespace limen::techniques {

/// A pass that shades and evaluates the visibility loop for each pixel on the way: search, choice of the
/// level and micro-occluders in one shader, with no image of receivers or visibility. Source: Schwarz 2009,
/// section 4.1, the form that it takes apart.
class LoopInShading {
 public:
  /// `stage`: any but VisibilityLoop::OwnPass. One map, no filter, a single pass.
  LoopInShading(SearchParts parts, VisibilityLoop stage, const frame::ShadedSetting& shading);
  ~LoopInShading();

  /// Compiles and allocates; states the bytes held.
  void prepare(frame::Frame& frame);
  void render(frame::Frame& frame);
  const gl::Texture& picture() const { return *picture_; }  ///< valid from prepare() on

 private:
  void configure(const gl::Program& program, frame::Frame& frame);
  void drawFragments(frame::Frame& frame);

  VisibilityLoop stage_;
  frame::ShadedSetting shading_;
  std::string shader_;  // without its stage's suffix
  OccluderSearch search_;
  LevelOfQuality quality_;
  MapSource maps_;
  std::unique_ptr<Gathering> gathering_;
  const gl::Program *program_ = nullptr, *forward_ = nullptr;
  std::optional<gl::Texture> picture_, depth_;
  std::optional<gl::Framebuffer> target_;
  uint32_t vertexArray_ = 0;  // without attributes
};

}  // namespace limen::techniques
