// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "renderer/frame/shaded.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Which samples a pass shades (shade_samples.comp.glsl).
enum class SampleForm {
  First,    ///< the first of each pixel
  Full,     ///< all of each pixel
  Loop,     ///< further ones, an invocation a pixel
  Grouped,  ///< the same in a pass for each number of samples
  Sorted    ///< the same, pixels in order of their numbers of samples
};
constexpr EnumNames<SampleForm, 5> enumNames(SampleForm) {
  return {{{{SampleForm::First, "first"},
            {SampleForm::Full, "full"},
            {SampleForm::Loop, "loop"},
            {SampleForm::Grouped, "grouped"},
            {SampleForm::Sorted, "sorted"}}}};
}

struct NoGradients {
  static constexpr const char *kKind = "none", *kSummary = "patterns are looked up at points";
};
struct PlaneGradients {
  static constexpr const char *kKind = "plane",
                              *kSummary = "checks are averaged over what a sample stands for on its plane";
};
struct NeighbourGradients {
  static constexpr const char *kKind = "neighbours",
                              *kSummary = "the same from differences of positions of neighbouring samples";
  bool borders = true;
  double borderDepthRatio = 1.05;
  static const SettingsTable<NeighbourGradients>& table();
};
using SampleGradients = std::variant<NoGradients, PlaneGradients, NeighbourGradients>;
enum class Gradients { None, Plane, Neighbours };  ///< in the order of SampleGradients
constexpr EnumNames<Gradients, 3> enumNames(Gradients) {
  return {{{{Gradients::None, "none"}, {Gradients::Plane, "plane"}, {Gradients::Neighbours, "neighbours"}}}};
}
/// Binding of a member of this type.
template <class S>
Binding<S> gradientsBinding(SampleGradients S::*member) {
  return {member, "gradients",
          "How wide checks are filtered; the fewer samples of a pixel are shaded, the wider: by the root of "
          "their share",
          "Holländer 2013, section 4.3.4 (the factor is reconstructed)"};
}

/// How samples are shaded: settings that all techniques of the family and their reference share.
struct SampleShading {
  frame::ShadedSetting shading;
  int lightSamples = 1;
  static const SettingsTable<SampleShading>& table();
};

/// Defines, and uniforms and storage, of programs that shade with surface_colour.glsl. `frame`: whose pixels
/// are the samples. Makes the shadow map if shading has a shadow: call it outside any pass first.
gl::ShaderDefines sampleShadingDefines(const SampleShading& settings, const frame::Frame& frame);
void configureSampleShading(const gl::Program& program, frame::Frame& frame, const SampleShading& settings);
/// Makes what configureSampleShading() binds; before a pass is opened.
void makeShadowOf(frame::Frame& frame, const SampleShading& settings);

/// A frame's picture in window x window samples a pixel, of which is known what each sees (Holländer 2013,
/// section 4.3.3). In place of normals, depths and texture coordinates it stores the triangle, 4 bytes a
/// sample, from which all else is computed where it is needed: materials here have solid textures, so neither
/// layers nor texture coordinates exist.
class SampleView {
 public:
  /// Throws Error if the samples make an image larger than the driver's largest texture.
  SampleView(frame::Frame& parent, int window, const SampleShading& settings,
             const SampleGradients& gradients = {});

  /// Makes the samples' triangles and what shading needs of other passes.
  void make();
  /// Defines of sample_colour.glsl.
  gl::ShaderDefines defines() const;
  /// Sets up a program with sample_colour.glsl.
  void configure(const gl::Program& program);

  frame::Frame& frame() { return *frame_; }
  glm::ivec2 pictureSizePx() const { return parent_.sizePx(); }
  int window() const { return window_; }

 private:
  frame::Frame& parent_;
  int window_;
  SampleShading settings_;
  SampleGradients gradients_;
  std::unique_ptr<frame::Frame> frame_;
};

}  // namespace limen::techniques
