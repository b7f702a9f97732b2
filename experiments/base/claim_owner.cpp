// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/claim_owner.h"

#include <chrono>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>

#include "experiments/base/child_process.h"
#include "experiments/base/process.h"

namespace limen {
namespace {

using std::chrono::steady_clock;

constexpr const char* kSlurmMark = " slurm:";
constexpr std::chrono::seconds kAskAgain{5};

/// One incarnation of a job.
struct SlurmJob {
  std::string cluster, id;
  long restarts = 0;
};

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

std::optional<SlurmJob> ownJob() {
  SlurmJob job{variable("SLURM_CLUSTER_NAME"), variable("SLURM_JOB_ID"), 0};
  if (job.id.empty()) return std::nullopt;
  job.restarts = std::strtol(variable("SLURM_RESTART_COUNT").c_str(), nullptr, 10);
  return job;
}

/// None if the owner was in no job.
std::optional<SlurmJob> jobOf(const std::string& owner) {
  const size_t mark = owner.rfind(kSlurmMark);
  if (mark == std::string::npos) return std::nullopt;
  const std::string text = owner.substr(mark + std::string(kSlurmMark).size());
  const size_t last = text.rfind(':');
  const size_t first = last == std::string::npos || last == 0 ? std::string::npos : text.rfind(':', last - 1);
  if (first == std::string::npos) return std::nullopt;
  return SlurmJob{text.substr(0, first), text.substr(first + 1, last - first - 1),
                  std::strtol(text.substr(last + 1).c_str(), nullptr, 10)};
}

/// Whether Slurm still has the job in a state that processes can live in; none if it cannot be asked.
std::optional<bool> askSlurm(const SlurmJob& job) {
  const ProgramOutput answer = runAndRead({"squeue", "--noheader", "--states=all", "--cluster=" + job.cluster,
                                           "--jobs=" + job.id, "--format=%T"});
  if (answer.status != 0) {
    // Jobs are forgotten some minutes after their end.
    if (answer.err.find("Invalid job id") != std::string::npos) return false;
    return std::nullopt;
  }
  for (const char* state :
       {"RUNNING", "COMPLETING", "SUSPENDED", "CONFIGURING", "STAGE_OUT", "SIGNALING", "STOPPED", "RESIZING"})
    if (answer.out.find(state) != std::string::npos) return true;
  return false;
}

std::optional<bool> existsInSlurm(const SlurmJob& job) {
  struct Known {
    std::optional<bool> exists;
    steady_clock::time_point asked;
  };
  static std::mutex guard;
  static std::map<std::string, Known> known;
  const std::scoped_lock lock(guard);
  const std::string name = job.cluster + ":" + job.id;
  const auto found = known.find(name);
  if (found != known.end() && steady_clock::now() - found->second.asked < kAskAgain)
    return found->second.exists;
  return (known[name] = {askSlurm(job), steady_clock::now()}).exists;
}

}  // namespace

std::string claimOwner() {
  const std::optional<SlurmJob> job = ownJob();
  if (!job) return processIdentity();
  return processIdentity() + kSlurmMark + job->cluster + ":" + job->id + ":" + std::to_string(job->restarts);
}

OwnerState stateOfOwner(const std::string& owner) {
  const std::optional<SlurmJob> own = ownJob(), theirs = jobOf(owner);
  const bool sameJob = own && theirs && own->cluster == theirs->cluster && own->id == theirs->id;
  if (sameJob && theirs->restarts < own->restarts) return OwnerState::Ended;
  const std::optional<bool> dead = isOwnerDead(owner.substr(0, owner.rfind(kSlurmMark)));
  if (dead) {
    if (!*dead) return OwnerState::Alive;
    const bool sameIncarnation = (!own && !theirs) || (sameJob && theirs->restarts == own->restarts);
    return sameIncarnation ? OwnerState::Died : OwnerState::Ended;
  }
  if (!theirs || sameJob) return OwnerState::Unknown;
  const std::optional<bool> exists = existsInSlurm(*theirs);
  if (!exists) return OwnerState::Unknown;
  return *exists ? OwnerState::Alive : OwnerState::Ended;
}

}  // namespace limen
