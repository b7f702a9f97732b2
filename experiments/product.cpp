// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/product.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/base/hash.h"
#include "perception/metrics/error_map.h"

namespace limen::experiments {
namespace {

/// What a person looks at: the scene's colour multiplied by the visibility, per channel if there are several
/// (as if the whole light were white), or the colour product itself.
Image composed(const Image& product, const Image& shading, bool isShare) {
  Image out(product.width, product.height, 3);
  const auto channels = static_cast<size_t>(product.channels);
  for (size_t i = 0; i < out.pixels(); ++i)
    for (size_t c = 0; c < 3; ++c) {
      const float value = product.data[i * channels + (channels == 1 ? 0 : c)];
      out.data[3 * i + c] = isShare ? value * shading.data[3 * i + c] : value;
    }
  return out;
}

Image absolute(Image product) {
  for (float& value : product.data) value = std::abs(value);
  return product;
}

/// Items from dark grey for the first to white for the last; the rest is black.
Image streamPicture(const Image& product) {
  const float last = *std::max_element(product.data.begin(), product.data.end());
  Image grey = product;
  for (float& value : grey.data) value = value < 0.0F ? 0.0F : 0.1F + 0.9F * value / std::max(last, 1.0F);
  return perception::displayPicture(composed(grey, {}, false));
}

}  // namespace

Image productPicture(techniques::ProductKind kind, const Image& product, const Image& shading) {
  using techniques::ProductKind;
  if (kind == ProductKind::Threshold) return perception::thresholdPicture(product);
  if (kind == ProductKind::JndMap) return perception::errorPicture(product, kJndPictureWhite);
  if (kind == ProductKind::VisibilityChange) return perception::errorPicture(absolute(product), kErrorScale);
  if (kind == ProductKind::Stream) return streamPicture(product);
  const bool isShare = product.channels == 1 || kind == ProductKind::LightColour;
  return perception::displayPicture(composed(product, shading, isShare));
}

double mapWhite(const std::string& mapName) {
  if (mapName == "jnd" || mapName == "jnd_change") return kJndPictureWhite;
  return mapName == "absolute_error" || mapName == "relative_error" ? kErrorScale : 1.0;
}

bool evaluatedEverywhere(techniques::ProductKind kind) {
  return kind == techniques::ProductKind::Threshold || kind == techniques::ProductKind::JndMap ||
         kind == techniques::ProductKind::Stream;
}

std::string productHash(const Image& product) {
  const std::array<int32_t, 3> size = {product.width, product.height, product.channels};
  Sha256 hash;
  hash.update(size.data(), sizeof size);
  hash.update(product.data.data(), product.data.size() * sizeof(float));
  return hash.hex();
}

}  // namespace limen::experiments
