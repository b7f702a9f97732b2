// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/environment.h"

#include <fmt/core.h>
#include <sqlite3.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <CLI/Version.hpp>

#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

#include "experiments/base/build_facts.h"
#include "experiments/base/clock.h"

namespace limen {
namespace {

const std::string kUnknown = "unknown";

/// Value of the first line "KEY<separator>VALUE" of a file, without surrounding blanks or quotes.
std::string lookUp(const std::string& file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const size_t split = line.find(separator);
    if (line.rfind(key, 0) != 0 || split == std::string::npos) continue;
    const size_t first = line.find_first_not_of(" \t\"", split + 1), last = line.find_last_not_of(" \t\"");
    if (first != std::string::npos && first <= last) return line.substr(first, last - first + 1);
  }
  return kUnknown;
}

std::string compiler() {
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#else
  return std::string("gcc ") + __VERSION__;
#endif
}

std::string kernel() {
  utsname name{};
  return uname(&name) == 0 ? fmt::format("{} {} {}", name.sysname, name.release, name.machine) : kUnknown;
}

}  // namespace

std::string quoteCommand(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += ' ';
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=./:,@%") == std::string::npos;
    if (plain) {
      out += word;
      continue;
    }
    out += '\'';
    for (const char character : word)
      out += character == '\'' ? std::string("'\\''") : std::string(1, character);
    out += '\'';
  }
  return out;
}

nlohmann::json environmentFacts(const std::vector<std::string>& command, const std::string& root) {
  std::error_code code;
  const std::filesystem::path here = std::filesystem::current_path(code);
  const std::string relative = std::filesystem::relative(here, root, code).string();
  const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGESIZE);
  return {{"cpu", lookUp("/proc/cpuinfo", "model name", ':')},
          {"cores", std::thread::hardware_concurrency()},
          {"memory_bytes", pages > 0 && pageBytes > 0 ? static_cast<int64_t>(pages) * pageBytes : 0},
          {"os", lookUp("/etc/os-release", "PRETTY_NAME", '=')},
          {"kernel", kernel()},
          {"compiler", compiler()},
          {"build_type", buildType()},
          {"libraries",
           {{"yaml-cpp", LIMEN_YAML_CPP_VERSION},
            {"sqlite", sqlite3_libversion()},
            {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                          NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
            {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
            {"cli11", CLI11_VERSION}}},
          {"commit", buildCommit()},
          {"command", quoteCommand(command)},
          {"working_directory", code || relative.empty() ? kUnknown : relative},
          {"time", utcNow()}};
}

}  // namespace limen
