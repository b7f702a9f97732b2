// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "perception/vision/display.h"
#include "study/observers/observer.h"

namespace limen::study {

/// The popping predictor (study/stimulus/prediction.h) for observers that use it, on its own OpenGL context,
/// created at the first prediction. Every stimulus is predicted once; with a `cacheFile` once across all
/// calls. `popping`: values of perception::PoppingSettings; what is left out takes its default. Throws Error
/// like the predictor. May be called from any thread, one at a time.
std::unique_ptr<StimulusModel> makePoppingModel(const Protocol& protocol,
                                                const perception::DisplayProfile& display,
                                                const std::map<std::string, ParameterValue>& popping = {},
                                                const std::string& cacheFile = {});

}  // namespace limen::study
