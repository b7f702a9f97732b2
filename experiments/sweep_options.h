// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace limen::experiments {

/// The options of `limen sweep`.
struct SweepOptions {
  std::vector<std::string> descriptors;
  std::string store;  ///< "" for results/<descriptor>.sqlite
  int shardIndex = 1, shardCount = 1;
  bool dryRun = false, json = false, failFast = false, retryDied = false, noReport = false, features = false;
  std::optional<std::string> list;  ///< "" for everything
  std::string device;               ///< name or index of the GPU; "": the first that is one
  std::string root;  ///< source tree with experiments/features.yaml and experiments/descriptors

  bool merge = false;
  std::string mergeOut;
  std::vector<std::string> mergeIn;
};

/// Options, or the exit code of a call that was already answered (--help, --version) or refused.
struct ParsedOptions {
  SweepOptions options;
  std::optional<int> exitCode;
};

ParsedOptions parseOptions(int argc, char** argv, const std::string& program);

}  // namespace limen::experiments
