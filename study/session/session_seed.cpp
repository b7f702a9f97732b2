// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/session_seed.h"

#include <sys/random.h>

#include <cerrno>
#include <cstring>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"

namespace limen::study {

uint64_t randomSessionSeed() {
  uint64_t seed = 0;
  ssize_t got = 0;
  do got = getrandom(&seed, sizeof seed, 0);
  while (got < 0 && errno == EINTR);
  if (got != static_cast<ssize_t>(sizeof seed))
    throw Error(std::string("the system gives no random numbers: ") + std::strerror(errno), {},
                "give a --seed");
  return seed & ((uint64_t{1} << 60) - 1);
}

uint64_t formerSessionSeed(const std::string& protocolHash, const std::string& participant,
                           const std::string& session) {
  return std::stoull(sha256(protocolHash + "/" + participant + "/" + session).substr(0, 15), nullptr, 16);
}

}  // namespace limen::study
