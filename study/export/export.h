// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "study/export/trial_table.h"

namespace limen::study {

enum class ExportFormat {
  Csv,     ///< trials.csv, participants.csv, frames.csv, dictionary.json
  Bids,    ///< Brain Imaging Data Structure 1.9: behavioural events, one file per session
  PsychDs  ///< Psych-DS 1.0: one CSV per session and a schema.org description
};

struct ExportRequest {
  std::string store, folder;          ///< the folder must not exist, or be empty
  std::vector<ExportFormat> formats;  ///< several: each in its own folder ("csv", "bids", "psych_ds")
  bool codes = false;                 ///< participant codes instead of pseudonyms
  bool frames = false;                ///< include frame logs
  std::string protocol;               ///< name or hash; "": all
};

/// Sessions of a store without anything that could identify a person. Throws Error: no sessions, no such
/// protocol.
std::vector<ExportedSession> loadSessions(const ExportRequest& request);

struct WrittenExport {
  std::vector<std::string> files;  ///< relative to the folder
  size_t ordersTellCode = 0;       ///< sessions of that kind (ExportedSession)
};

/// Writes an export, all of it or nothing. Nothing is overwritten, also where two are written at once. With
/// codes its files can be read by their owner alone. Throws Error.
WrittenExport writeExport(const ExportRequest& request);

/// Content of the files of a format by relative path.
using Files = std::vector<std::pair<std::string, std::string>>;
Files csvFiles(const std::vector<ExportedSession>& sessions, bool frames);
Files bidsFiles(const std::vector<ExportedSession>& sessions, bool frames);
Files psychDsFiles(const std::vector<ExportedSession>& sessions, bool frames);

}  // namespace limen::study
