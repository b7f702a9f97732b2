// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace limen {

/// host:pid:start-time of this process: no other process, before or after, has the same.
std::string processIdentity();

/// Whether the process named by `owner` (host:pid:start-time) is known to be gone; nullopt: it is on another
/// host.
std::optional<bool> isOwnerDead(const std::string& owner);

}  // namespace limen
