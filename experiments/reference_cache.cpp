// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/reference_cache.h"

#include <algorithm>
#include <filesystem>

#include "experiments/base/error.h"

namespace limen::experiments {
namespace {

size_t bytesOf(const Image& image) { return image.data.size() * sizeof(float); }

}  // namespace

std::shared_ptr<const Image> ReferenceCache::get(const std::string& key, int width, int height,
                                                 const std::function<Image()>& make) {
  const auto known =
      std::find_if(held_.begin(), held_.end(), [&](const Held& one) { return one.key == key; });
  if (known != held_.end()) {
    held_.splice(held_.begin(), held_, known);
    return held_.front().image;
  }
  const std::string path = folder_ + "/" + key + ".exr";
  std::shared_ptr<const Image> image;
  if (std::error_code code; std::filesystem::exists(path, code)) {
    try {
      image = std::make_shared<const Image>(readImage(path));
    } catch (const Error&) {
      // A damaged file, for example from a full disk, is replaced.
    }
    if (image && (image->width != width || image->height != height)) image.reset();
  }
  if (!image) {
    image = std::make_shared<const Image>(make());
    writeExr(path, *image);
  }
  hold(key, image);
  return image;
}

void ReferenceCache::hold(const std::string& key, std::shared_ptr<const Image> image) {
  held_.push_front({key, std::move(image)});
  size_t bytes = 0;
  for (auto one = held_.begin(); one != held_.end();) {
    bytes += bytesOf(*one->image);
    // The latest is kept, however large it is.
    one = bytes > bytesInMemory_ && one != held_.begin() ? held_.erase(one) : std::next(one);
  }
}

}  // namespace limen::experiments
