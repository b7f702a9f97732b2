// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/window/ui_fonts.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// What a window must be able to write to show a protocol's texts.
window::UiLettering letteringFor(const Protocol& protocol);

/// Refuses a protocol with characters that no font here has. Throws Error with each character and its place.
void checkLettering(const Protocol& protocol);

}  // namespace limen::study
