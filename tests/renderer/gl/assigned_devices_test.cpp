// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/assigned_devices.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "experiments/base/error.h"

namespace limen::gl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::optional<Assignment> assignment(std::map<std::string, std::string> variables) {
  return readAssignment([&](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

/// Four GPUs in an order that is not that of their numbers, then a software renderer.
std::vector<DeviceIdentity> node() {
  return {{false, "0000:c1:00.0", "GPU-cccc", 2},
          {false, "0000:01:00.0", "GPU-aaaa", 0},
          {false, "0000:41:00.0", "GPU-bbbb", 1},
          {false, "0000:e1:00.0", "GPU-dddd", 3},
          {true, "", "", {}}};
}

std::vector<bool> chosen(const std::map<std::string, std::string>& variables,
                         const std::vector<DeviceIdentity>& devices = node()) {
  return assignedDevices(devices, assignment(variables).value());
}

TEST(AssignedDevices, OutsideJobsAndInJobsWithoutGpusNothingIsAssigned) {
  EXPECT_FALSE(assignment({{"CUDA_VISIBLE_DEVICES", "1"}})) << "it is no word to OpenGL";
  EXPECT_FALSE(assignment({{"SLURM_JOB_ID", "7"}}));
  EXPECT_FALSE(assignment({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", ""}}));
  EXPECT_FALSE(assignment({{"SLURM_JOB_ID", "7"}, {"CUDA_VISIBLE_DEVICES", "NoDevFiles"}}));
}

TEST(AssignedDevices, TheNumberThatSlurmGaveIsThatOfTheDeviceFileAndNotTheOrderOfEgl) {
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "2"}}),
              ElementsAre(true, false, false, false, true));
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "0,3"}}),
              ElementsAre(false, true, false, true, true));
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "1-2"}}),
              ElementsAre(true, false, true, false, true));
}

TEST(AssignedDevices, AStepHasAPartOfItsJobsAndCudasVariableIsAskedLast) {
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "0,1,2,3"}, {"SLURM_STEP_GPUS", "1"}}),
              ElementsAre(false, false, true, false, true));
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "3"}, {"CUDA_VISIBLE_DEVICES", "0"}}),
              ElementsAre(false, false, false, true, true));
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"CUDA_VISIBLE_DEVICES", "GPU-bb"}}),
              ElementsAre(false, false, true, false, true));
}

TEST(AssignedDevices, WhereSlurmConfinesJobsEachGpuThatIsThereIsAllowedWhateverItsNumber) {
  // CUDA counts from 0 what is visible, Slurm what the machine has.
  const std::vector<DeviceIdentity> visible = {{false, "", "", {}}, {true, "", "", {}}};
  EXPECT_THAT(chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "3"}}, visible), ElementsAre(true, true));
}

TEST(AssignedDevices, WhatCannotBeToldIsRefusedWithTheWayOut) {
  const std::vector<DeviceIdentity> unknown = {{false, "", "", {}}, {false, "", "", {}}};
  try {
    chosen({{"SLURM_JOB_ID", "7"}, {"SLURM_JOB_GPUS", "1"}}, unknown);
    FAIL() << "any of them may be another job's";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("SLURM_JOB_GPUS=1"), HasSubstr("--device")));
  }
}

TEST(AssignedDevices, NvidiasDriverTellsNumbersByAddressOrUuid) {
  std::string pattern = (std::filesystem::temp_directory_path() / "limen_nvidia_XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path folder = pattern;
  const auto write = [&](const std::string& address, const std::string& uuid, int minor) {
    std::filesystem::create_directories(folder / address);
    std::ofstream(folder / address / "information")
        << "Model: \t\t NVIDIA H100 80GB HBM3\nIRQ:   \t\t 91\nGPU UUID: \t " << uuid
        << "\nBus Type: \t PCIe\nBus Location: \t " << address << "\nDevice Minor: \t " << minor
        << "\nGPU Excluded:\t No\n";
  };
  write("0000:01:00.0", "GPU-aaaa", 5);
  write("0000:41:00.0", "GPU-bbbb", 4);
  // The number that CUDA counts by gives way to that of the device file.
  std::vector<DeviceIdentity> devices = {{false, "0000:41:00.0", "", 0},
                                         {false, "", "GPU-aaaa", {}},
                                         {false, "0000:c1:00.0", "", 7},
                                         {true, "", "", {}}};
  completeIdentities(devices, folder.string());
  std::filesystem::remove_all(folder);
  EXPECT_EQ(devices[0].number, 4);
  EXPECT_EQ(devices[0].uuid, "GPU-bbbb");
  EXPECT_EQ(devices[1].number, 5);
  EXPECT_EQ(devices[1].pciAddress, "0000:01:00.0");
  EXPECT_EQ(devices[2].number, 7) << "another vendor's";
  EXPECT_EQ(devices[3].number, std::nullopt);
  completeIdentities(devices, "/nowhere");
}

}  // namespace
}  // namespace limen::gl
