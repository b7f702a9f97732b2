// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stored_window.h"

#include <charconv>

#include "experiments/base/error.h"
#include "study/protocol/protocol.h"

namespace limen::study {

// The protocol was checked when its session began; only its window is needed here.
glm::ivec2 windowOf(const store::StudyProtocol& protocol, const std::string& store) {
  const std::string where = store + " (protocol " + protocol.name + ")";
  const YamlNode root = parseYaml(protocol.text, where), *window = root.find("window");
  const auto length = [&](const char* key, int otherwise) {
    const YamlNode* node = window ? window->find(key) : nullptr;
    if (!node) return otherwise;
    int value = 0;
    const char* const end = node->text.data() + node->text.size();
    const auto read = std::from_chars(node->text.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end || value < 1)
      throw Error("the store is damaged: " + std::string(key) + " of its window is " + node->describe(),
                  where, "put back a copy");
    return value;
  };
  const WindowSetting usual;
  return {length("width_px", usual.widthPx), length("height_px", usual.heightPx)};
}

}  // namespace limen::study
