// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "experiments/base/enum_names.h"
#include "renderer/frame/summed_area_table.h"

namespace limen::frame {

/// The structure from which averages over many texels are computed.
enum class Prefilter {
  Sums,  ///< summed-area table: any rectangle
  Mips   ///< pyramid of averages: squares with power-of-two sides, blended
};
constexpr EnumNames<Prefilter, 2> enumNames(Prefilter) {
  return {{{{Prefilter::Sums, "sums"}, {Prefilter::Mips, "mips"}}}};
}

/// A square array of layers, and the structure for averages over any part of each.
class LayerAverages {
 public:
  struct Form {
    Prefilter prefilter = Prefilter::Sums;
    int resolution = 256;  ///< texels per side; a power of two
    int layers = 1, channels = 1;
    SumForm sums = SumForm::Float;        ///< of the sums
    gl::Format texel = gl::Format::R32F;  ///< of the pyramid
    const char* texelLayout = "r32f";     ///< its name in image layouts
  };
  /// `name` of the array ("the occlusion textures") and `hint` are for the Error thrown if the device has no
  /// room.
  LayerAverages(gl::Context& context, const Form& form, const std::string& name, const std::string& hint);
  /// Before build(): level 0 holds the values, to be written by a shader as an image.
  const gl::Texture& texture() const { return sums_ ? sums_->texture() : *mips_; }
  /// Makes the sums or averages of the values. The work that wrote them needs no further barrier.
  void build() const;
  /// Binds sums or averages to a texture unit (and means to storage binding 0).
  void bind(uint32_t unit) const;
  int64_t bytes() const { return sums_ ? sums_->bytes() : mips_->bytes(); }

 private:
  int resolution_, layers_;
  std::optional<SummedAreaTable> sums_;
  std::optional<gl::Texture> mips_;
  const gl::Program* reduce_ = nullptr;
};

}  // namespace limen::frame
