// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <exception>

#include "experiments/base/hash.h"
#include "experiments/base/text.h"
#include "renderer/gl/program.h"
#include "renderer/gl/program_binary.h"

namespace limen::gl {
namespace {

/// Adds the time from construction to destruction.
class Stopwatch {
 public:
  explicit Stopwatch(double& sumMs) : sumMs_(sumMs) {}
  ~Stopwatch() {
    sumMs_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sumMs_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string hashOf(const std::vector<ShaderText>& stages) {
  std::string all;
  // Sources contain no zero byte.
  for (const ShaderText& stage : stages) all += stage.text + '\0';
  return sha256(all);
}

std::string describeProgram(const std::vector<std::string>& paths, const ShaderDefines& defines) {
  std::string values;
  for (const auto& [name, value] : defines) values += (values.empty() ? "" : ", ") + name + "=" + value;
  return join(paths) + (values.empty() ? "" : " (" + values + ")");
}

}  // namespace

const Program& ProgramCache::get(const std::vector<std::string>& paths, const ShaderDefines& defines) {
  std::string key;
  for (const std::string& path : paths) key += path + "\n";
  for (const auto& [name, value] : defines) key += name + "=" + value + "\n";
  const auto known = programs_.find(key);
  if (known != programs_.end()) return *known->second.program;
  const Stopwatch stopwatch(compileMs_);
  Entry entry{paths, defines, nullptr, {}, {}, {}, {}};
  const std::vector<ShaderText> stages = read(entry);
  entry.program = std::make_unique<Program>(stages);
  if (const std::string folder = programBinaryFolder(); !folder.empty())
    writeProgramBinary(*entry.program, folder, paths, describeProgram(paths, defines));
  return *(programs_[key] = std::move(entry)).program;
}

std::vector<ShaderText> ProgramCache::read(Entry& entry) {
  std::vector<ShaderText> stages;
  for (const std::string& path : entry.paths) stages.push_back(loadShader(path, entry.defines));
  entry.textHash = hashOf(stages);
  entry.files.clear(), entry.stamps.clear();
  for (const ShaderText& stage : stages) {
    entry.files.insert(entry.files.end(), stage.files.begin(), stage.files.end());
    entry.stamps.insert(entry.stamps.end(), stage.stamps.begin(), stage.stamps.end());
  }
  return stages;
}

bool ProgramCache::mayHaveChanged(const Entry& entry, Stamps& now) {
  // A missing file may appear without any file that was read changing.
  if (!entry.unreadable.empty()) return true;
  for (size_t i = 0; i < entry.files.size(); ++i) {
    const auto [found, fresh] = now.try_emplace(entry.files[i]);
    if (fresh) found->second = shaderStamp(entry.files[i]);
    const FileStamp &here = found->second, &then = entry.stamps[i];
    if (!then.settled || here.there != then.there || here.modifiedNs != then.modifiedNs ||
        here.bytes != then.bytes)
      return true;
  }
  return false;
}

void ProgramCache::reload(Entry& entry, Reload& out) {
  const std::string name = describeProgram(entry.paths, entry.defines), before = entry.textHash;
  std::vector<ShaderText> stages;
  try {
    stages = read(entry);
  } catch (const std::exception& error) {
    if (entry.unreadable != error.what()) out.failures.push_back(name + ": " + error.what());
    entry.unreadable = error.what();
    entry.textHash.clear();
    return;
  }
  entry.unreadable.clear();
  if (entry.textHash == before) return;
  try {
    entry.program->become(Program(stages));
    out.rebuilt.push_back(name);
  } catch (const std::exception& error) {
    out.failures.push_back(name + ": " + error.what());
  }
}

ProgramCache::Reload ProgramCache::reloadChanged() {
  Reload out;
  if (shaderRoot().empty()) return out;
  const Stopwatch stopwatch(compileMs_);
  Stamps now;
  for (auto& [key, entry] : programs_)
    if (mayHaveChanged(entry, now)) reload(entry, out);
  return out;
}

}  // namespace limen::gl
