// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/process.h"

#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>

namespace limen {
namespace {

std::string hostName() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

// Start time in clock ticks since boot: field 22 of /proc/PID/stat (proc(5)); "" if the process is gone or a
// zombie. Field 2, the program's name, may hold blanks and brackets, so fields are counted from its last
// bracket.
std::string startTime(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const size_t bracket = text.rfind(')');
  if (bracket == std::string::npos) return {};
  std::istringstream fields(text.substr(bracket + 1));
  std::string field;
  for (int index = 3; index <= 22; ++index) {
    fields >> field;
    if (index == 3 && (field == "Z" || field == "X")) return {};
  }
  return field;
}

}  // namespace

std::string processIdentity() {
  const std::string pid = std::to_string(getpid());
  return hostName() + ":" + pid + ":" + startTime(pid);
}

std::optional<bool> isOwnerDead(const std::string& owner) {
  const size_t second = owner.rfind(':');
  const size_t first =
      second == std::string::npos || second == 0 ? std::string::npos : owner.rfind(':', second - 1);
  if (first == std::string::npos) return true;  // no other owner looks like this
  if (owner.substr(0, first) != hostName()) return std::nullopt;
  return startTime(owner.substr(first + 1, second - first - 1)) != owner.substr(second + 1);
}

}  // namespace limen
