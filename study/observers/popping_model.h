// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "perception/vision/display.h"
#include "study/observers/observer.h"

namespace limen::study {

/// The popping predictor (study/stimulus/prediction.h) for observers who see with it, on an OpenGL context of
/// its own that is made when the first prediction is asked for. Every stimulus is predicted once; with a
/// `cacheFile` once for all calls. Throws Error as the predictor does. To be called by one thread at a time,
/// whichever.
std::unique_ptr<StimulusModel> makePoppingModel(const Protocol& protocol,
                                                const perception::DisplayProfile& display,
                                                const std::string& cacheFile = {});

}  // namespace limen::study
