// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// What a store notes beside a run that this process holds: processIdentity(), and in a job of Slurm also
/// " slurm:CLUSTER:JOB:RESTARTS", so that whoever comes later can tell whether the job still exists.
std::string claimOwner();

enum class OwnerState {
  Alive,
  Died,     ///< the process is gone while its job (or machine) went on: what it did may have killed it
  Ended,    ///< its job is over, or Slurm has started it anew: the process was taken away
  Unknown,  ///< it is on another host, and nobody here knows
};

/// The state of the process that claimOwner() named. Slurm never runs two incarnations of a job at once, so a
/// requeued job knows without asking that its predecessor has ended; about other jobs squeue is asked, at
/// most every few seconds for each.
OwnerState stateOfOwner(const std::string& owner);

}  // namespace limen
