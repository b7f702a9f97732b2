// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace limen::gl {

/// What tells a device of EGL from others; empty where it is not known.
struct DeviceIdentity {
  bool software = false;
  std::string pciAddress;     ///< "0000:65:00.0"
  std::string uuid;           ///< as NVIDIA writes it: "GPU-0e2f..."
  std::optional<int> number;  ///< as Slurm counts: N of /dev/nvidiaN, or of /dev/dri/renderD(128 + N)
};

/// The GPUs of its machine that Slurm gave this job or step.
struct Assignment {
  std::string variable;  ///< of the environment, with its value: "SLURM_JOB_GPUS=2"
  std::vector<int> numbers;
  std::vector<std::string> uuids;
};

/// From SLURM_STEP_GPUS, SLURM_JOB_GPUS or CUDA_VISIBLE_DEVICES, whichever comes first; nothing outside jobs
/// of Slurm, for jobs that were given no GPU, and where the value names none. `variable` is getenv().
std::optional<Assignment> readAssignment(const std::function<const char*(const char*)>& variable);

/// For each device whether this job may use it. Software renderers are always allowed, and all devices where
/// there are no more GPUs than were given, as where Slurm confines jobs to theirs. Throws Error if there are
/// more and none of them is known to be meant.
std::vector<bool> assignedDevices(const std::vector<DeviceIdentity>& devices, const Assignment& assignment);

/// Adds what NVIDIA's driver tells of its devices in `folder`, by address or UUID.
void completeIdentities(std::vector<DeviceIdentity>& devices,
                        const std::string& folder = "/proc/driver/nvidia/gpus");

}  // namespace limen::gl
