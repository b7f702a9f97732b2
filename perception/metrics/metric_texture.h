// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// An image as metrics take it from a technique: R32F for one channel, otherwise RGBA32F.
gl::Texture metricTexture(const Image& image);

}  // namespace limen::perception
