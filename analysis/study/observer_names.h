// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"

namespace limen::analysis {

/// What results call the observers of a store. Participants' codes are personal data, so people are O01, O02,
/// ... in the order of their first session, whatever is left out of a result; these are not the pseudonyms of
/// `limen study export`, whose order says nothing. Simulated observers keep their names.
class ObserverNames {
 public:
  /// `sessions`: all of the store. `codes`: people keep their codes.
  ObserverNames(const std::vector<store::StudySession>& sessions, bool codes);
  std::string of(const std::string& participant, bool simulated) const;

 private:
  bool codes_;
  std::map<std::string, size_t> numbers_;  ///< from 1
};

}  // namespace limen::analysis
