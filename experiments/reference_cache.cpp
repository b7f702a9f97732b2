// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/reference_cache.h"

#include <filesystem>

#include "experiments/base/error.h"

namespace limen::experiments {

const Image& ReferenceCache::get(const std::string& key, const std::function<Image()>& make) {
  if (key == key_) return image_;
  const std::string path = folder_ + "/" + key + ".exr";
  bool found = false;
  if (std::filesystem::exists(path)) {
    try {
      image_ = readImage(path);
      found = true;
    } catch (const Error&) {
      // A damaged file, say from a full disk, is made again.
    }
  }
  if (!found) {
    image_ = make();
    writeExr(path, image_);
  }
  key_ = key;
  return image_;
}

}  // namespace limen::experiments
