// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// How the sums of a summed-area table are stored.
enum class SumForm {
  Float,      ///< 32-bit float
  FloatMean,  ///< 32-bit float of a layer's values minus a constant near their mean
  Fixed       ///< 32-bit unsigned: exact as long as the texels of a layer sum to less than 2^32
};

/// Sums of all texels to the lower left of each, that one included, so that the sum over any rectangle takes
/// four of them (Crow 1984; Schwarz 2009, section 3.2.1). A square array of layers of one or two channels,
/// summed in place. The matching shader code is summed_area_table.glsl.
class SummedAreaTable {
 public:
  /// `resolution`: texels per side. Throws Error if the device has no room for it.
  SummedAreaTable(gl::Context& context, int resolution, int layers, int channels, SumForm form);
  /// Before build(): the values, to be written by a shader as an image; after it their sums. R32F, RG32F,
  /// R32UI or RG32UI.
  const gl::Texture& texture() const { return texture_; }
  /// Replaces the values by their sums. The work that wrote the values needs no further barrier.
  void build() const;
  /// Binds the sums to a texture unit and, if means are subtracted, the means to storage binding 0.
  void bind(uint32_t unit) const;
  int64_t bytes() const;

  /// Largest number of additions between a value and a sum that contains it: the error of the sums, relative
  /// to the sum of absolute values, is at most this many times 2^-24 (to first order), plus one more per
  /// value if means are subtracted.
  static int additions(int resolution);
  /// Defines for shaders that include summed_area_table.glsl.
  static gl::ShaderDefines defines(SumForm form);
  /// "r32f" and so on, as image layouts name it.
  static const char* texelLayout(int channels, SumForm form);

 private:
  int resolution_, layers_;
  gl::Texture texture_;
  std::optional<gl::Buffer> means_;
  const gl::Program &rows_, &columns_;
  const gl::Program* findMeans_ = nullptr;
};

}  // namespace limen::frame
