// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "perception/multiscale/plane.h"
#include "perception/multiscale/resample.h"

/// Decompositions of an image into bands of about an octave, in double precision. Source: Schwarz 2009,
/// sections 9.1.3, 9.4 and 10.3. Any size from 1x1 up; every function is deterministic whatever the number of
/// cores. Values must be finite; see finiteNonNegative().
namespace limen::perception {

struct PyramidSettings {
  int levels = 7;  ///< of the Gaussian pyramid; fewer if the image is too small
  Kernel kernel = Kernel::binomial5();
  Upsampler upsampler = Upsampler::Successive;
  Border border = Border::Clamp;
};

/// Largest number of levels of an image: floor(lg2(min(width, height))) + 1.
int mostLevels(int width, int height);

/// Level 0 is the image; each further level is filtered and halved (rounding down).
std::vector<Plane> gaussianPyramid(const Plane& image, const PyramidSettings& settings);
/// Level `from` of a pyramid brought to the size of level `to` < `from` with the settings' upsampler.
Plane upsampleLevel(const std::vector<Plane>& pyramid, int from, int to, const PyramidSettings& settings);
/// G_i - up(G_i+1), and the coarsest G as it is.
std::vector<Plane> laplacianPyramid(const std::vector<Plane>& gaussian, const PyramidSettings& settings);
/// Inverse of laplacianPyramid().
Plane collapse(const std::vector<Plane>& laplacian, const PyramidSettings& settings);
/// Every level upsampled to the size of level 0: the thesis's Gaussian stack (Successive) or the equivalent
/// of sampling the pyramid directly (Bilinear).
std::vector<Plane> upsampledStack(const std::vector<Plane>& pyramid, const PyramidSettings& settings);

/// True Gaussian stack: the image convolved with Gaussians of sigma, 2 sigma, 4 sigma ... at full resolution;
/// level 0 is the image. `sigmaPx` <= 0: that of `kernel` in the limit of many levels, 2 sqrt(variance / 3).
std::vector<Plane> gaussianStack(const Plane& image, const PyramidSettings& settings, double sigmaPx = 0.0);
double stackSigmaPx(int level, const Kernel& kernel, double sigmaPx = 0.0);  ///< 0 for level 0
/// What a pyramid would be without halving: the kernel dilated by 1, 2, 4 ... (cosited kernels only).
std::vector<Plane> dilatedStack(const Plane& image, const PyramidSettings& settings);
/// The mistake of section 9.6: the same small kernel applied i times. Its bands lie elsewhere.
std::vector<Plane> repeatedStack(const Plane& image, const PyramidSettings& settings);
/// G_i - G_i+1 of a stack, and the last level as it is.
std::vector<Plane> differences(const std::vector<Plane>& stack);

/// Contrast levels, with the number of guarded pixels.
struct ContrastLevels {
  std::vector<Plane> levels;  ///< n - 2 of n Gaussian levels, none for n < 3
  int64_t guarded = 0;        ///< pixels, over all levels, whose denominator lay below epsilon
};
/// c_i = (G_i - up(G_i+1)) / max(up(up(G_i+2)), epsilon), level i at its own size. Denominators below epsilon
/// (0 where the display's black is 0) are counted.
ContrastLevels contrastPyramid(const std::vector<Plane>& gaussian, const PyramidSettings& settings,
                               double epsilon = 1e-4);
/// The same for levels of equal size.
ContrastLevels contrastStack(const std::vector<Plane>& stack, double epsilon = 1e-4);

/// Copy with NaN and negative values set to 0 and others limited to `largest`.
Plane finiteNonNegative(const Plane& image, double largest);

/// How visible a grid of 2^level pixels is: root mean square of the second difference, along both axes, of
/// pixels beside the grid's lines, and of the others. Bilinear upsampling by 2^level kinks on the centres of
/// coarse pixels (or, cosited, on multiples of 2^level).
struct BlockMetric {
  double onGrid = 0.0, offGrid = 0.0;  ///< RMS
  double onGridMedian = 0.0,
         offGridMedian = 0.0;  ///< of magnitudes: so that image edges do not mask the grid
  double ratio() const { return over(onGrid, offGrid); }
  double medianRatio() const { return over(onGridMedian, offGridMedian); }

 private:
  static double over(double on, double off) { return off > 0.0 ? on / off : on > 0.0 ? 1e9 : 1.0; }
};
BlockMetric blockMetric(const Plane& image, int level, bool cosited = false);

}  // namespace limen::perception
