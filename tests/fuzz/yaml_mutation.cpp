// SPDX-License-Identifier: BSD-3-Clause
#include <functional>

#include "experiments/base/error.h"
#include "experiments/base/yaml_tree.h"
#include "tests/fuzz/mutation.h"

namespace limen::fuzz {
namespace {

/// In the flow style, whose syntax does not depend on the place.
std::string emit(const YamlNode& node) {
  std::string out;
  switch (node.kind) {
    case YamlNode::Kind::Null:
      return "~";
    case YamlNode::Kind::Scalar: {
      const bool plain = !node.quoted && !node.text.empty() &&
                         node.text.find_first_of(",[]{}:#\"'\n\r&*!|>%@`?=") == std::string::npos;
      if (plain) return node.text;
      for (const char c : node.text)
        out += c == '"' || c == '\\' ? std::string("\\") + c
               : c == '\n'           ? "\\n"
               : c == '\r'           ? "\\r"
                                     : std::string(1, c);
      return '"' + out + '"';
    }
    case YamlNode::Kind::List:
      for (const YamlNode& item : node.items) out += (out.empty() ? "" : ", ") + emit(item);
      return '[' + out + ']';
    case YamlNode::Kind::Map:
      for (const auto& [key, value] : node.members)
        out += (out.empty() ? "" : ",\n ") + emit(key) + ": " + emit(value);
      break;
  }
  return '{' + out + '}';
}

/// All nodes below the root.
std::vector<YamlNode*> nodesOf(YamlNode& root) {
  std::vector<YamlNode*> out;
  const std::function<void(YamlNode&)> visit = [&](YamlNode& node) {
    for (YamlNode& item : node.items) {
      out.push_back(&item);
      visit(item);
    }
    for (YamlMember& member : node.members) {
      out.push_back(&member.value);
      visit(member.value);
    }
  };
  visit(root);
  return out;
}

YamlNode scalar(std::string text) {
  YamlNode node;
  node.kind = YamlNode::Kind::Scalar;
  node.text = std::move(text);
  return node;
}

template <class T>
void changeList(Random& random, std::vector<T>& list, const T& added) {
  if (list.empty() || random.chance(0.3)) {
    list.insert(list.begin() + static_cast<ptrdiff_t>(random.below(list.size() + 1)), added);
  } else if (random.chance(0.5)) {
    list.erase(list.begin() + static_cast<ptrdiff_t>(random.below(list.size())));
  } else {
    std::swap(list[random.below(list.size())], list[random.below(list.size())]);
  }
}

void mutateTree(Random& random, YamlNode& root, YamlNode& other) {
  const std::vector<YamlNode*> nodes = nodesOf(root), others = nodesOf(other);
  if (nodes.empty() || others.empty()) return;
  YamlNode& node = *random.pick(nodes);
  switch (random.below(8)) {
    case 0: {  // copies, since one may lie within the other
      YamlNode& second = *random.pick(nodes);
      const YamlNode a = node, b = second;
      second = a;
      if (&node != &second && nodesOf(root) == nodes) node = b;
      break;
    }
    case 1: {
      const YamlNode taken = *random.pick(others);
      node = taken;
      break;
    }
    case 2: {
      YamlNode list;
      list.kind = YamlNode::Kind::List;
      list.items.assign(random.below(4), node);
      node = list;
      break;
    }
    case 3:
      if (node.kind == YamlNode::Kind::Map && !node.members.empty()) {
        YamlMember& member = node.members[random.below(node.members.size())];
        member.key.text = random.chance(0.5) ? member.key.text + "x" : oddValue(random);
        break;
      }
      [[fallthrough]];
    case 4:
      if (node.kind == YamlNode::Kind::List) {
        const YamlNode taken = *random.pick(nodes);
        changeList(random, node.items, taken);
        break;
      }
      if (node.kind == YamlNode::Kind::Map) {
        const YamlNode taken = *random.pick(others);
        changeList(random, node.members, YamlMember{scalar("k" + std::to_string(random.below(3))), taken});
        break;
      }
      [[fallthrough]];
    default:
      node = scalar(oddValue(random));
  }
}

}  // namespace

std::string mutateYaml(Random& random, const std::string& input, const std::vector<std::string>& corpus) {
  if (random.chance(0.35)) return mutateText(random, input, corpus);
  YamlNode root = parseYaml(input, "seed"), other = parseYaml(random.pick(corpus), "seed");
  for (size_t i = random.below(3) + 1; i > 0; --i) mutateTree(random, root, other);
  const std::string text = emit(root) + '\n';
  return random.chance(0.1) ? mutateText(random, text, corpus) : text;
}

}  // namespace limen::fuzz
