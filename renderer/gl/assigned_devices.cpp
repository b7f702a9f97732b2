// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/assigned_devices.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "experiments/base/error.h"

namespace limen::gl {
namespace {

std::optional<int> wholeNumber(const std::string& text) {
  int number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{} || end != text.data() + text.size() || number < 0) return {};
  return number;
}

/// "2", "0-3" or a UUID. False if it is none of these.
bool addWord(const std::string& word, Assignment& to) {
  constexpr int kMost = 1024;
  const size_t dash = word.find('-');
  if (word.rfind("GPU-", 0) == 0) {
    to.uuids.push_back(word);
  } else if (const auto one = wholeNumber(word)) {
    to.numbers.push_back(*one);
  } else {
    if (dash == std::string::npos) return false;
    const auto first = wholeNumber(word.substr(0, dash)), last = wholeNumber(word.substr(dash + 1));
    if (!first || !last || *last < *first || *last > kMost) return false;
    for (int i = *first; i <= *last; ++i) to.numbers.push_back(i);
  }
  return true;
}

bool startsWith(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

bool isAssigned(const DeviceIdentity& device, const Assignment& assignment) {
  if (device.number && std::find(assignment.numbers.begin(), assignment.numbers.end(), *device.number) !=
                           assignment.numbers.end())
    return true;
  // CUDA lets a UUID be cut short.
  return std::any_of(assignment.uuids.begin(), assignment.uuids.end(),
                     [&](const std::string& uuid) { return startsWith(device.uuid, uuid); });
}

}  // namespace

std::optional<Assignment> readAssignment(const std::function<const char*(const char*)>& variable) {
  if (!variable("SLURM_JOB_ID")) return {};
  for (const char* name : {"SLURM_STEP_GPUS", "SLURM_JOB_GPUS", "CUDA_VISIBLE_DEVICES"}) {
    const char* const value = variable(name);
    if (!value || *value == '\0') continue;
    Assignment out;
    out.variable = std::string(name) + "=" + value;
    std::istringstream stream(value);
    bool understood = true;
    for (std::string word; std::getline(stream, word, ',');) understood = understood && addWord(word, out);
    if (understood) return out;
  }
  return {};
}

std::vector<bool> assignedDevices(const std::vector<DeviceIdentity>& devices, const Assignment& assignment) {
  std::vector<bool> out(devices.size(), true);
  const auto isGpu = [](const DeviceIdentity& device) { return !device.software; };
  const size_t given = assignment.numbers.size() + assignment.uuids.size();
  if (static_cast<size_t>(std::count_if(devices.begin(), devices.end(), isGpu)) <= given) return out;
  bool found = false;
  for (size_t i = 0; i < devices.size(); ++i) {
    if (!isGpu(devices[i])) continue;
    out[i] = isAssigned(devices[i], assignment);
    found = found || out[i];
  }
  if (!found)
    throw Error(
        "Slurm gave this job " + assignment.variable + ", but which of the GPUs here that is cannot be told",
        {}, "name one with --device; limen sweep --list devices shows them");
  return out;
}

void completeIdentities(std::vector<DeviceIdentity>& devices, const std::string& folder) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    DeviceIdentity known;
    known.pciAddress = entry.path().filename().string();
    std::ifstream file(entry.path() / "information");
    for (std::string line; std::getline(file, line);) {
      const size_t colon = line.find(':');
      if (colon == std::string::npos) continue;
      const size_t at = line.find_first_not_of(" \t", colon + 1);
      const std::string value = at == std::string::npos ? "" : line.substr(at);
      if (startsWith(line, "GPU UUID")) known.uuid = value;
      if (startsWith(line, "Device Minor")) known.number = wholeNumber(value);
    }
    for (DeviceIdentity& device : devices) {
      if (device.pciAddress.empty() ? device.uuid.empty() || device.uuid != known.uuid
                                    : device.pciAddress != known.pciAddress)
        continue;
      device = {device.software, known.pciAddress, known.uuid.empty() ? device.uuid : known.uuid,
                known.number ? known.number : device.number};
    }
  }
}

}  // namespace limen::gl
