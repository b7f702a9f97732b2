// SPDX-License-Identifier: BSD-3-Clause
#include "tests/architecture/rules.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/architecture/modules.h"

namespace limen::architecture {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLicenceLine = "// SPDX-License-Identifier: BSD-3-Clause";

bool isSource(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".glsl";
}

// Sorted, so that messages come in the same order everywhere. Folders of other things (build, results) are
// left out.
std::vector<fs::path> sourcesUnder(const fs::path& root, bool withTests) {
  std::set<std::string> tops;
  for (const Module& module : modules()) tops.insert(module.folder.substr(0, module.folder.find('/')));
  if (withTests) tops.insert("tests");
  std::vector<fs::path> files;
  for (const std::string& top : tops) {
    if (!fs::is_directory(root / top)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.is_regular_file() && isSource(entry.path())) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool isPublicHeader(const Module& module, const std::string& path) {
  // Parts of a module that others name one by one.
  for (const std::string part : {"perception/band_thresholds/", "perception/metrics/", "perception/popping/",
                                 "perception/threshold_maps/", "perception/thresholds/"})
    if (path.rfind(part, 0) == 0) return path.find('/', part.size()) == std::string::npos;
  return path.find('/', module.folder.size() + 1) == std::string::npos;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out.empty() ? "nothing" : out;
}

std::string trim(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// "" or what is wrong with `user`, a file in folder `folder`, including `name`.
std::string checkInclude(const Module& user, const std::string& folder, const std::string& name) {
  if (!user.mayUseGl && namesGl(name)) return user.folder + " must not know OpenGL";
  // Includes are written from the root; one that names no module from there is relative to its file or a
  // library's.
  std::string path = fs::path(name).lexically_normal().generic_string();
  if (path.rfind("tests/", 0) == 0) return "only tests use tests";
  const Module* used = moduleOf(path);
  if (!used) {
    path = fs::path(folder + "/" + name).lexically_normal().generic_string();
    used = moduleOf(path);
  }
  if (!used || used == &user) return "";
  if (!mayUse(user, *used)) return user.folder + " may use " + joined(user.mayUse);
  if (!isPublicHeader(*used, path)) return "this is an inside of " + used->folder;
  // A reference is a technique itself and shares the interface, not the other techniques.
  if (user.folder == "renderer/references" && used->folder == "renderer/techniques" &&
      path != "renderer/techniques/technique.h") {
    return "references use technique.h alone of renderer/techniques";
  }
  return "";
}

}  // namespace

Violations checkIncludes(const fs::path& root) {
  static const std::regex kInclude("^\\s*#\\s*include\\s*[\"<]([^\">]+)[\">]");
  Violations violations;
  for (const fs::path& file : sourcesUnder(root, false)) {
    const std::string path = file.lexically_relative(root).generic_string();
    const Module* user = moduleOf(path);
    std::ifstream in(file);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      std::smatch match;
      if (!std::regex_search(line, match, kInclude)) continue;
      const std::string where = path + ":" + std::to_string(number) + ": includes " + match[1].str() + "; ";
      if (!user) {
        violations.push_back(where + "the file lies in no known module");
        continue;
      }
      const std::string wrong = checkInclude(*user, fs::path(path).parent_path().generic_string(), match[1]);
      if (!wrong.empty()) violations.push_back(where + wrong);
    }
  }
  return violations;
}

Violations checkLicenceLines(const fs::path& root) {
  Violations violations;
  for (const fs::path& file : sourcesUnder(root, true)) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    if (line != kLicenceLine) {
      violations.push_back(file.lexically_relative(root).generic_string() + ":1: must be '" + kLicenceLine +
                           "'");
    }
  }
  return violations;
}

Violations checkFileWriting(const fs::path& root) {
  static const std::regex kWriter(R"(\b(ofstream|copy_file)\b|\bfopen\(.*"[wa])");
  Violations violations;
  for (const fs::path& file : sourcesUnder(root, false)) {
    std::ifstream in(file);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      if (std::regex_search(line, kWriter))
        violations.push_back(file.lexically_relative(root).generic_string() + ":" + std::to_string(number) +
                             ": files are written with replaceFile() or PartFile");
    }
  }
  return violations;
}

Violations checkShaderLists(const fs::path& root) {
  std::string lists;
  std::vector<fs::path> shaders;
  for (const char* part : {"renderer", "perception", "experiments", "tests"}) {
    if (!fs::exists(root / part)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / part)) {
      const fs::path& file = entry.path();
      if (file.filename() == "CMakeLists.txt") {
        std::ifstream in(file);
        lists.append(std::istreambuf_iterator<char>(in), {});
      } else if (file.extension() == ".glsl") {
        shaders.push_back(file);
      }
    }
  }
  Violations violations;
  for (const fs::path& file : shaders) {
    const std::string name = file.filename().string(), folder = file.parent_path().filename().string();
    // limen_technique(TARGET NAME) lists NAME/NAME.comp.glsl.
    const bool byTechnique = name == folder + ".comp.glsl" &&
                             std::regex_search(lists, std::regex("limen_technique\\(\\w+ " + folder + "\\)"));
    if (!byTechnique && !std::regex_search(lists, std::regex("[\\s/]" + name + "[\\s)]")))
      violations.push_back(file.lexically_relative(root).generic_string() +
                           ": no limen_shaders() lists it, so no program that embeds shaders has it");
  }
  std::sort(violations.begin(), violations.end());
  return violations;
}

Violations checkPackageTable(const std::string& page, const std::string& packages) {
  std::vector<std::string> told, listed;
  std::istringstream rows(page), lines(packages);
  std::string line;
  static const std::regex kRow("^\\| *`([^`]+)` *\\|([^|]*)\\|([^|]*)\\| *$");
  std::smatch match;
  while (std::getline(rows, line)) {
    if (std::regex_match(line, match, kRow))
      told.push_back(match[1].str() + "|" + trim(match[2]) + "|" + trim(match[3]));
  }
  while (std::getline(lines, line)) {
    if (trim(line).empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string package, when, reason;
    words >> package >> when;
    std::getline(words, reason);
    listed.push_back(package + "|" + when + "|" + trim(reason));
  }
  Violations violations;
  for (size_t i = 0; i < std::max(told.size(), listed.size()); ++i) {
    const std::string row = i < told.size() ? told[i] : "nothing",
                      entry = i < listed.size() ? listed[i] : "nothing";
    if (row != entry)
      violations.push_back("the page says '" + row + "' where packages.txt says '" + entry + "'");
  }
  return violations;
}

std::map<std::string, Target> readTargets(const std::string& listing) {
  // Words of a generator expression that are no library (LINK_ONLY, WHOLE_ARCHIVE) name no target and do no
  // harm.
  static const std::regex kName("[A-Za-z0-9_./+-]+(::[A-Za-z0-9_.+-]+)*");
  std::map<std::string, Target> targets;
  std::istringstream lines(listing);
  std::string line;
  while (std::getline(lines, line)) {
    const size_t first = line.find('|'), second = line.find('|', first + 1);
    if (second == std::string::npos) continue;
    Target& target = targets[line.substr(0, first)];
    target.folder = line.substr(first + 1, second - first - 1);
    const std::string links = line.substr(second + 1);
    for (std::sregex_iterator name(links.begin(), links.end(), kName), end; name != end; ++name) {
      target.links.insert(name->str());
    }
  }
  return targets;
}

Violations checkTargets(const std::map<std::string, Target>& targets) {
  const auto isTest = [](const std::string& folder) {
    return folder == "tests" || folder.rfind("tests/", 0) == 0;
  };
  Violations violations;
  for (const auto& [name, target] : targets) {
    if (isTest(target.folder) || target.folder == ".") continue;
    const Module* user = moduleOf(target.folder);
    if (!user) violations.push_back("target " + name + ": " + target.folder + " is no known module");
    for (const std::string& link : target.links) {
      const auto linked = targets.find(link);
      if (!user || linked == targets.end()) continue;
      const Module* used = moduleOf(linked->second.folder);
      const std::string edge = "target " + name + " links " + link + "; ";
      if (isTest(linked->second.folder)) violations.push_back(edge + "only tests use tests");
      if (used && !mayUse(*user, *used))
        violations.push_back(edge + user->folder + " may use " + joined(user->mayUse));
    }
    if (user && !user->mayUseGl) {
      for (const std::string& link : linkClosure(targets, name)) {
        if (namesGl(link))
          violations.push_back("target " + name + " links " + link + "; " + user->folder +
                               " must not know OpenGL");
      }
    }
  }
  return violations;
}

std::set<std::string> linkClosure(const std::map<std::string, Target>& targets, const std::string& name) {
  std::set<std::string> seen;
  std::vector<std::string> open = {name};
  while (!open.empty()) {
    const auto target = targets.find(open.back());
    open.pop_back();
    if (target == targets.end()) continue;
    for (const std::string& link : target->second.links) {
      if (seen.insert(link).second) open.push_back(link);
    }
  }
  return seen;
}

}  // namespace limen::architecture
