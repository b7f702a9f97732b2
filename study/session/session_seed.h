// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace limen::study {

/// A seed from the system's random source, below 2^60, which every reader of JSON keeps. It is stored with
/// the session, and says nothing about who takes part.
uint64_t randomSessionSeed();

/// The seed that earlier versions gave a session: a hash of protocol, participant and session. Whoever
/// guesses a code can check the guess against it, and against the orders that were drawn with it.
uint64_t formerSessionSeed(const std::string& protocolHash, const std::string& participant,
                           const std::string& session);

}  // namespace limen::study
