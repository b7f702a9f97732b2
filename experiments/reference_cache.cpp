// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/reference_cache.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/base/file_lock.h"
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
  std::optional<Reference> reference = read(key, width, height);
  if (!reference) {
    std::filesystem::create_directories(folder_);
    // Others that need the same one, on this host or another, wait for it rather than make it too.
    FileLock making(folder_ + "/" + key + ".lock");
    reference = read(key, width, height);
    if (!reference) {
      reference = make();
      // Before the picture: what has one has remarks as well.
      replaceFile(remarksOf(key), nlohmann::json{{"remarks", reference->remarks}}.dump() + "\n");
      writeExr(pictureOf(key), *reference->image);
    }
    making.removeFile();
  }
  hold(key, *reference);
  return *reference;
}

std::string ReferenceCache::pictureOf(const std::string& key) const { return folder_ + "/" + key + ".exr"; }
std::string ReferenceCache::remarksOf(const std::string& key) const { return folder_ + "/" + key + ".json"; }

std::optional<Reference> ReferenceCache::read(const std::string& key, int width, int height) const {
  if (std::error_code code; !std::filesystem::exists(pictureOf(key), code)) return std::nullopt;
  std::optional<std::vector<std::string>> remarks = readRemarks(remarksOf(key));
  if (!remarks) return std::nullopt;
  try {
    Reference reference{std::make_shared<const Image>(readImage(pictureOf(key))), std::move(*remarks)};
    if (reference.image->width == width && reference.image->height == height) return reference;
  } catch (const Error&) {
    // A damaged file, for example from a full disk, is replaced.
  }
  return std::nullopt;
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
