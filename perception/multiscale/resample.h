// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "experiments/base/enum_names.h"
#include "perception/multiscale/plane.h"

namespace limen::perception {

/// How an image is extended beyond its edge.
enum class Border {
  Clamp,  ///< the nearest pixel
  Mirror  ///< the image reflected at its edge: pixel -1 is pixel 0
};
constexpr EnumNames<Border, 2> enumNames(Border) {
  return {{{{Border::Clamp, "clamp"}, {Border::Mirror, "mirror"}}}};
}
int borderIndex(int index, int size, Border border);

/// Low-pass that precedes halving: five taps, applied either on a pixel of the finer level (cosited: coarse
/// sample x lies on fine pixel 2x) or, followed by a bilinear step, on the centre of the coarse pixel: then
/// coarse sample x lies at (x + 1/2) w_fine / w_coarse, and of the binomial remain six taps, 1 5 10 10 5 1.
/// Source: Schwarz 2009, sections 9.4 and 10.3; the six taps are reconstructed from "5x5, then bilinear".
struct Kernel {
  std::array<double, 5> taps{};
  bool fused = false;      ///< with a bilinear 2:1 step
  bool nineFetch = false;  ///< fused only: as three bilinear fetches per axis, at -5/3, 0, 5/3 texels

  static Kernel binomial5();        ///< 1 4 6 4 1, cosited
  static Kernel fused6();           ///< the same, fused
  static Kernel nineFetch6();       ///< fused6() as the thesis's nine fetches; the same for even sizes only
  static Kernel burt5(double a);    ///< Burt and Adelson 1983: 1/4 - a/2, 1/4, a, 1/4, 1/4 - a/2; cosited
  static Kernel burt6(double a);    ///< the same, fused
  double variancePx2() const;       ///< of the low-pass, fused step included, in pixels of the finer level
  double transfer(double w) const;  ///< at w radians per pixel of the finer level, alignment aside
};

/// How a coarser level is upsampled to the size of a finer one.
enum class Upsampler {
  Bilinear,    ///< in one step, whatever the factor: blocky beyond a factor of 2
  Successive,  ///< bilinear, level by level
  Expand       ///< the kernel itself transposed (Burt and Adelson's EXPAND), level by level
};

/// Weighted sums that produce each sample of one axis from those of another: `taps` pairs for each output.
struct AxisTaps {
  int outputs = 0, taps = 0;
  std::vector<int> index;      ///< [output][tap], inside the source
  std::vector<double> weight;  ///< sums to 1 for each output
};
int halved(int size);  ///< max(1, size / 2)
AxisTaps reductionTaps(int size, const Kernel& kernel, Border border);
/// Bilinear from `from` to `to` samples; cosited: sample x of the coarser axis lies on 2^levels x of the
/// finer.
AxisTaps bilinearTaps(int from, int to, bool cosited, int levels, Border border);
AxisTaps expansionTaps(int from, int to, const Kernel& kernel, Border border);
/// Convolution with a sampled Gaussian cut off at 6 sigma; sigma 0 copies.
AxisTaps gaussianTaps(int size, double sigmaPx, Border border);
/// Mean of `sidePx` samples around each; an even count is off-centre to the left.
AxisTaps boxTaps(int size, int sidePx, Border border);
/// The kernel with its taps `dilation` pixels apart (cosited kernels only).
AxisTaps dilatedTaps(int size, const Kernel& kernel, int dilation, Border border);

/// Applies `columns` along x and `rows` along y. Sources and outputs may differ in size.
Plane resample(const Plane& source, const AxisTaps& columns, const AxisTaps& rows);

}  // namespace limen::perception
