// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limen::gl {

/// Kinds of instructions that units of a GPU execute at different rates.
enum class InstructionClass {
  Arithmetic,  ///< of each component that is written; dot products count as many as they multiply
  Division,    ///< of integers, and remainders
  Conversion,  ///< between integers and floats
  Special,     ///< reciprocals, roots, powers (two), logarithms, sines
  Move,        ///< copies, most of which the last stage of a compiler removes
  Fetch,       ///< from textures and images
  Load,        ///< from buffers
  Constant,    ///< from uniform blocks
  Query,       ///< sizes of textures and images
  Store,       ///< to buffers and images
  SharedLoad,
  SharedStore,
  Atomic,
  Barrier,
  Flow,
};
constexpr size_t kInstructionClasses = 15;
/// Names of the classes, as in tables.
extern const std::array<const char*, kInstructionClasses> kInstructionClassNames;
using InstructionCounts = std::array<double, kInstructionClasses>;

/// Instructions of a program that are executed equally often: those outside loops, or those of a loop without
/// the loops in it. Both sides of a branch count.
struct ProgramPart {
  std::string name;               ///< "main", "1", "2", and "2.1" for the first loop in the second
  std::optional<int> iterations;  ///< of a loop, if the program states them
  InstructionCounts counts{};
};

/// Parts of a program in NVIDIA's assembly, which program binaries of its driver contain (program_binary.h);
/// `binary`: such a binary, or the text alone. The assembly is not what the GPU executes: a last stage
/// merges, schedules and drops instructions. Throws Error if there is no assembly, or its loops do not match.
std::vector<ProgramPart> countInstructions(std::string_view binary);

/// Counts of an invocation. `iterations`: of each loop, for each time that it is reached, by name; 1 for
/// those without an entry whose iterations the program does not state. Throws Error on names of no loop.
InstructionCounts totalCounts(const std::vector<ProgramPart>& parts,
                              const std::vector<std::pair<std::string, double>>& iterations);

}  // namespace limen::gl
