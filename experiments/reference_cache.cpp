// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/reference_cache.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"

namespace limen::experiments {
namespace {

size_t bytesOf(const Image& image) { return image.data.size() * sizeof(float); }

/// None if there is no such file, or a damaged one.
std::optional<std::vector<std::string>> readRemarks(const std::string& path) {
  std::ifstream in(path);
  const nlohmann::json stored = nlohmann::json::parse(in, nullptr, false);
  if (!stored.is_object() || !stored.contains("remarks") || !stored["remarks"].is_array())
    return std::nullopt;
  std::vector<std::string> remarks;
  for (const nlohmann::json& remark : stored["remarks"]) {
    if (!remark.is_string()) return std::nullopt;
    remarks.push_back(remark.get<std::string>());
  }
  return remarks;
}

}  // namespace

Reference ReferenceCache::get(const std::string& key, int width, int height,
                              const std::function<Reference()>& make) {
  const auto known =
      std::find_if(held_.begin(), held_.end(), [&](const Held& one) { return one.key == key; });
  if (known != held_.end()) {
    held_.splice(held_.begin(), held_, known);
    return held_.front().reference;
  }
  const std::string path = folder_ + "/" + key + ".exr", remarksPath = folder_ + "/" + key + ".json";
  Reference reference;
  if (std::error_code code; std::filesystem::exists(path, code)) {
    if (std::optional<std::vector<std::string>> remarks = readRemarks(remarksPath)) {
      reference.remarks = std::move(*remarks);
      try {
        reference.image = std::make_shared<const Image>(readImage(path));
      } catch (const Error&) {
        // A damaged file, for example from a full disk, is replaced.
      }
    }
    if (reference.image && (reference.image->width != width || reference.image->height != height))
      reference.image.reset();
  }
  if (!reference.image) {
    reference = make();
    // Before the picture: what has one has remarks as well.
    std::filesystem::create_directories(folder_);
    replaceFile(remarksPath, nlohmann::json{{"remarks", reference.remarks}}.dump() + "\n");
    writeExr(path, *reference.image);
  }
  hold(key, reference);
  return reference;
}

void ReferenceCache::hold(const std::string& key, Reference reference) {
  held_.push_front({key, std::move(reference)});
  size_t bytes = 0;
  for (auto one = held_.begin(); one != held_.end();) {
    bytes += bytesOf(*one->reference.image);
    // The latest is kept, however large it is.
    one = bytes > bytesInMemory_ && one != held_.begin() ? held_.erase(one) : std::next(one);
  }
}

}  // namespace limen::experiments
