// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "study/example/example.h"

namespace limen::study {
namespace {

/// The text with another `window:` of the same background; other lines stay where they are, so that messages
/// name the lines of the file.
std::string withWindow(const Protocol& protocol, std::pair<int, int> windowPx) {
  const YamlNode root = parseYaml(protocol.text, protocol.path);
  const std::string window =
      fmt::format("window: {{width_px: {}, height_px: {}, background: {}}}", windowPx.first, windowPx.second,
                  shortestNumber(protocol.window.background));
  std::vector<std::string> lines;
  std::istringstream stream(protocol.text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  int from = 0, to = 0;  // lines of the old one, from 1, `to` the first after it
  for (size_t i = 0; i < root.members.size(); ++i) {
    if (root.members[i].key.mark.column != 1)
      throw Error("the window of this protocol cannot be replaced", protocol.path,
                  "put each of its keys on its own line");
    if (root.members[i].key.text != "window") continue;
    from = root.members[i].key.mark.line;
    to = i + 1 < root.members.size() ? root.members[i + 1].key.mark.line : static_cast<int>(lines.size()) + 1;
  }
  std::string out;
  for (int line = 1; line <= static_cast<int>(lines.size()); ++line) {
    const bool old = line >= from && line < to;
    out += (line == from ? window : old ? "" : lines[static_cast<size_t>(line) - 1]) + "\n";
  }
  return from == 0 ? out + window + "\n" : out;
}

}  // namespace

Protocol protocolOf(const ExampleStudy& study, std::shared_ptr<const Catalogue> catalogue) {
  Protocol protocol = readProtocol(study.protocol, catalogue);
  if (!study.windowPx) return protocol;
  return parseProtocol(withWindow(protocol, *study.windowPx), protocol.path, catalogue);
}

}  // namespace limen::study
