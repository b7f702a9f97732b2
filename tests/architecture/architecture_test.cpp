// SPDX-License-Identifier: BSD-3-Clause
// The tree as it is: directions of dependency, licence lines, and the documented table of packages.
#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/architecture/modules.h"
#include "tests/architecture/rules.h"

namespace limen::architecture {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string readText(const std::filesystem::path& path) {
  std::ifstream in(path);
  EXPECT_TRUE(in) << path;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Shared libraries that the file itself asks for (DT_NEEDED), without those that its libraries ask for in
// turn.
std::vector<std::string> neededLibraries(const std::string& program) {
  std::vector<std::string> out;
  FILE* pipe = popen(("LC_ALL=C readelf -d '" + program + "'").c_str(), "r");
  if (!pipe) return out;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe)) {
    const std::string line = buffer.data();
    const size_t open = line.find('['), close = line.find(']');
    if (line.find("(NEEDED)") != std::string::npos && close != std::string::npos) {
      out.push_back(line.substr(open + 1, close - open - 1));
    }
  }
  pclose(pipe);
  return out;
}

TEST(Architecture, IncludesGoInTheAllowedDirections) {
  EXPECT_THAT(checkIncludes(LIMEN_SOURCE_DIR), IsEmpty());
}

TEST(Architecture, TargetsLinkInTheAllowedDirections) {
  const auto targets = readTargets(readText(LIMEN_TARGET_LIST));
  ASSERT_TRUE(targets.count("limen_base")) << "the list of targets is not the one of this build";
  EXPECT_THAT(checkTargets(targets), IsEmpty());
}

TEST(Architecture, AnalyseAsksForNoOpenGlLibrary) {
  const std::string program = LIMEN_BIN_DIR "/limen-analyse";
  if (!std::filesystem::exists(program)) GTEST_SKIP() << program << " is not built";
  const std::vector<std::string> libraries = neededLibraries(program);
  ASSERT_THAT(libraries, Not(IsEmpty()));
  for (const std::string& library : libraries) EXPECT_FALSE(namesGl(library)) << library;
}

TEST(Architecture, NeededLibrariesAreSeen) {
  // Every C++ program of this build asks for a C library.
  EXPECT_THAT(neededLibraries("/proc/self/exe"), Not(IsEmpty()));
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  EXPECT_THAT(neededLibraries(self), Contains(HasSubstr("libc.so")));
}

TEST(Architecture, SourcesStartWithTheLicenceLine) {
  EXPECT_THAT(checkLicenceLines(LIMEN_SOURCE_DIR), IsEmpty());
}

TEST(Architecture, FilesAreWrittenInOneWay) { EXPECT_THAT(checkFileWriting(LIMEN_SOURCE_DIR), IsEmpty()); }

TEST(Architecture, ShadersAreListed) { EXPECT_THAT(checkShaderLists(LIMEN_SOURCE_DIR), IsEmpty()); }

TEST(Architecture, DocsListThePackagesThatTheLauncherInstalls) {
  const std::filesystem::path root = LIMEN_SOURCE_DIR;
  EXPECT_THAT(checkPackageTable(readText(root / "docs/building.md"), readText(root / "packages.txt")),
              IsEmpty());
}

}  // namespace
}  // namespace limen::architecture
