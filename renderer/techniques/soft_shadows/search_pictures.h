// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"
#include "renderer/techniques/soft_shadows/pixel_counts.h"

namespace limen::techniques {

/// Processed pixels by the size of their search area: blue for 10 texels or less, green for 400, red for 6000
/// or more, on a logarithmic scale (Schwarz 2009, figure 4.10). Lit pixels are light grey, those in umbra
/// dark grey, those outside the map yellowish; black: no receiver.
Image searchAreaPicture(const PixelCounts& counted);

/// Processed pixels by the level of their micro-occluders: from blue for level 0 to red for level
/// 5 and coarser (figure 4.11). Other pixels as above.
Image levelPicture(const PixelCounts& counted);

/// Budgets by their square roots, the number of micro-occluders per axis: blue for 4 or less, green for 12,
/// red for 36 or more or no limit, on a logarithmic scale. All pixels, whether processed or not.
Image budgetPicture(const Image& budgets);

}  // namespace limen::techniques
