// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/instruction_counts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "experiments/base/error.h"

namespace limen::gl {
namespace {

using Class = InstructionClass;

constexpr std::string_view kStart = "!!NVcp", kEnd = "END";
// Lines before the first instruction, and declarations.
const std::vector<std::string_view> kDeclarations = {"OPTION", "GROUP_SIZE", "SHARED_MEMORY", "SHARED",
                                                     "PARAM",  "STORAGE",    "CBUFFER",       "TEMP",
                                                     "LONG",   "SHORT",      "ATTRIB",        "OUTPUT"};
const std::map<std::string_view, Class> kClasses = {
    {"MOV", Class::Move},         {"PK64", Class::Move},      {"UP64", Class::Move},
    {"DIV", Class::Division},     {"MOD", Class::Division},   {"I2F", Class::Conversion},
    {"TRUNC", Class::Conversion}, {"FLR", Class::Conversion}, {"CEIL", Class::Conversion},
    {"ROUND", Class::Conversion}, {"CVT", Class::Conversion}, {"RCP", Class::Special},
    {"RSQ", Class::Special},      {"SQRT", Class::Special},   {"LG2", Class::Special},
    {"EX2", Class::Special},      {"SIN", Class::Special},    {"COS", Class::Special},
    {"POW", Class::Special},      {"TEX", Class::Fetch},      {"TXF", Class::Fetch},
    {"TXL", Class::Fetch},        {"TXB", Class::Fetch},      {"TXD", Class::Fetch},
    {"TXG", Class::Fetch},        {"TXFMS", Class::Fetch},    {"LOADIM", Class::Fetch},
    {"LDB", Class::Load},         {"LOAD", Class::Load},      {"LDC", Class::Constant},
    {"TXQ", Class::Query},        {"IMQ", Class::Query},      {"STB", Class::Store},
    {"STORE", Class::Store},      {"STOREIM", Class::Store},  {"LDS", Class::SharedLoad},
    {"STS", Class::SharedStore},  {"ATOMB", Class::Atomic},   {"ATOMS", Class::Atomic},
    {"ATOM", Class::Atomic},      {"ATOMIM", Class::Atomic},  {"BAR", Class::Barrier},
    {"MEMBAR", Class::Barrier},   {"IF", Class::Flow},        {"ELSE", Class::Flow},
    {"ENDIF", Class::Flow},       {"REP", Class::Flow},       {"ENDREP", Class::Flow},
    {"BRK", Class::Flow},         {"CONT", Class::Flow},      {"RET", Class::Flow},
    {"CAL", Class::Flow},         {"KIL", Class::Flow}};

double& of(InstructionCounts& counts, Class kind) { return counts[static_cast<size_t>(kind)]; }

/// Components that an instruction writes: those after the point of its first operand, all four without one.
double writtenComponents(std::string_view operands) {
  const std::string_view target = operands.substr(0, operands.find(','));
  const size_t point = target.rfind('.');
  if (point == std::string_view::npos) return 4.0;
  const std::string_view mask = target.substr(point + 1);
  return static_cast<double>(std::count_if(
      mask.begin(), mask.end(), [](char c) { return c == 'x' || c == 'y' || c == 'z' || c == 'w'; }));
}

void countOne(InstructionCounts& counts, std::string_view opcode, std::string_view operands) {
  const std::string_view name = opcode.substr(0, opcode.find('.'));
  const auto found = kClasses.find(name);
  const Class kind = found == kClasses.end() ? Class::Arithmetic : found->second;
  const double components = writtenComponents(operands);
  if (name == "DIV" && opcode.find(".F") != std::string_view::npos) {  // a reciprocal and a product
    of(counts, Class::Special) += components;
    of(counts, Class::Arithmetic) += components;
  } else if (name == "POW") {  // a logarithm, a product and a power of two
    of(counts, Class::Special) += 2.0 * components;
    of(counts, Class::Arithmetic) += components;
  } else if (kind == Class::Arithmetic) {
    const bool isDot = name.size() == 3 && name.starts_with("DP");
    of(counts, kind) += components * (isDot ? name[2] - '0' : 1);
  } else if (kind == Class::Division || kind == Class::Conversion || kind == Class::Special ||
             kind == Class::Move) {
    of(counts, kind) += components;
  } else {
    ++of(counts, kind);
  }
}

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The number of "REP.S {3, 0, 0, 0}".
std::optional<int> statedIterations(std::string_view operands) {
  const size_t brace = operands.find('{');
  if (brace == std::string_view::npos) return std::nullopt;
  return std::stoi(std::string(operands.substr(brace + 1)));
}

}  // namespace

const std::array<const char*, kInstructionClasses> kInstructionClassNames = {
    "arithmetic", "division", "conversion",  "special",      "move",   "fetch",   "load", "constant",
    "query",      "store",    "shared_load", "shared_store", "atomic", "barrier", "flow"};

std::vector<ProgramPart> countInstructions(std::string_view binary) {
  const size_t start = binary.find(kStart);
  if (start == std::string_view::npos)
    throw Error("no assembly in this program binary", {},
                "only binaries of NVIDIA's driver contain it: set LIMEN_PROGRAM_BINARIES there");
  std::string_view text = binary.substr(start);
  text = text.substr(0, text.find('\0'));
  std::vector<ProgramPart> parts{{"main", std::nullopt, {}}};
  std::vector<size_t> open{0};      // part that lines belong to, below it those around it
  std::vector<int> loopsInside{0};  // of each open part, so far
  bool ended = false;
  text.remove_prefix(std::min(text.find('\n'), text.size()));
  while (!text.empty() && !ended) {
    text.remove_prefix(1);
    const std::string_view line = trimmed(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(text.find('\n'), text.size()));
    if (line.empty() || line.front() == '#' || line.back() == ':') continue;
    ended = line == kEnd;
    if (ended) continue;
    const size_t space = line.find_first_of(" ;");
    const std::string_view opcode = line.substr(0, space), name = opcode.substr(0, opcode.find('.'));
    const std::string_view operands = space == std::string_view::npos ? "" : line.substr(space + 1);
    if (std::find(kDeclarations.begin(), kDeclarations.end(), name) != kDeclarations.end()) continue;
    if (name == "REP") {
      const std::string inside = open.size() == 1 ? "" : parts[open.back()].name + ".";
      parts.push_back({inside + std::to_string(++loopsInside.back()), statedIterations(operands), {}});
      open.push_back(parts.size() - 1);
      loopsInside.push_back(0);
    }
    countOne(parts[open.back()].counts, opcode, operands);
    if (name == "ENDREP") {
      if (open.size() == 1) throw Error("a loop ends in this program's assembly that does not begin");
      open.pop_back();
      loopsInside.pop_back();
    }
  }
  if (!ended || open.size() != 1) throw Error("this program's assembly is cut off");
  return parts;
}

InstructionCounts totalCounts(const std::vector<ProgramPart>& parts,
                              const std::vector<std::pair<std::string, double>>& iterations) {
  std::map<std::string, double> times{{"main", 1.0}};
  for (const auto& [name, count] : iterations)
    if (std::none_of(parts.begin() + 1, parts.end(), [&](const auto& part) { return part.name == name; }))
      throw Error("the program has no loop '" + name + "'", {}, "see the column part");
  InstructionCounts total{};
  for (const ProgramPart& part : parts) {
    if (part.name != "main") {
      const auto given = std::find_if(iterations.begin(), iterations.end(),
                                      [&](const auto& entry) { return entry.first == part.name; });
      const double own = given != iterations.end() ? given->second : part.iterations.value_or(1);
      const size_t point = part.name.rfind('.');
      times[part.name] = own * times.at(point == std::string::npos ? "main" : part.name.substr(0, point));
    }
    for (size_t i = 0; i < total.size(); ++i) total[i] += times.at(part.name) * part.counts[i];
  }
  return total;
}

}  // namespace limen::gl
