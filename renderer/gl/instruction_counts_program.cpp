// SPDX-License-Identifier: BSD-3-Clause
// limen-instruction-counts: instructions of compiled programs by class, CSV on standard output. Arguments:
// program binaries as LIMEN_PROGRAM_BINARIES writes them on NVIDIA's driver.
#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/program.h"
#include "renderer/gl/instruction_counts.h"

namespace {

using namespace limen;

/// "1=3.5" as ("1", 3.5).
std::pair<std::string, double> readIterations(const std::string& text) {
  const size_t sign = text.find('=');
  char* end = nullptr;
  const double value = sign == std::string::npos ? -1.0 : std::strtod(text.c_str() + sign + 1, &end);
  if (value < 0.0 || *end != '\0')
    throw Error("'" + text + "' states no iterations", "--iterations", "give LOOP=NUMBER: 1=3.5");
  return {text.substr(0, sign), value};
}

std::string readBinary(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error("cannot read '" + path + "'");
  return bytes;
}

void print(const std::string& file, const std::string& part, const std::string& iterations,
           const gl::InstructionCounts& counts) {
  fmt::print("{},{},{}", file, part, iterations);
  for (const double count : counts) fmt::print(",{:g}", count);
  fmt::print("\n");
}

void printCounts(const std::vector<std::string>& files, const std::vector<std::string>& given) {
  std::vector<std::pair<std::string, double>> iterations;
  for (const std::string& text : given) iterations.push_back(readIterations(text));
  fmt::print("program,part,iterations");
  for (const char* name : gl::kInstructionClassNames) fmt::print(",{}", name);
  fmt::print("\n");
  for (const std::string& file : files) {
    const std::vector<gl::ProgramPart> parts = gl::countInstructions(readBinary(file));
    const std::string name = std::filesystem::path(file).stem().string();
    for (const gl::ProgramPart& part : parts)
      print(name, part.name, part.iterations ? std::to_string(*part.iterations) : "", part.counts);
    print(name, "invocation", "", gl::totalCounts(parts, iterations));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Instructions of compiled programs by class, as CSV: outside loops, in each loop, and of an "
      "invocation.",
      "limen-instruction-counts");
  int exitCode = kExitSuccess;
  std::vector<std::string> files, iterations;
  app.add_option("FILE", files, "program binaries of NVIDIA's driver, see LIMEN_PROGRAM_BINARIES")
      ->required();
  app.add_option("--iterations", iterations, "iterations of a loop: 1=3.5, and 1.1 for the first loop in it")
      ->type_name("LOOP=NUMBER");
  app.callback([&] { printCounts(files, iterations); });
  return runProgram(app, argc, argv, exitCode);
}
