// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/visibility_fields/field_form.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::visibility_fields {

/// The rays of an object's field by Embree, on all cores, in packets of 16: distances as shares of the
/// sphere's diameter, -1 for none, unrounded: [position][row][column]. Throws std::runtime_error if Embree
/// fails. Source: Gaitatzes 2012, Algorithm 1.
std::vector<float> traceFieldOnCpu(const RigidObject& object, const FieldForm& form);

}  // namespace limen::visibility_fields
