// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/visibility_fields/visibility_fields.h"

namespace limen::techniques {

/// Most objects of a scene that have fields.
inline constexpr size_t kMostFieldObjects = 256;

/// The rigid objects of a frame's scene. Throws Error if they are more than kMostFieldObjects.
visibility_fields::RigidObjects objectsOf(const frame::Frame& frame, visibility_fields::ObjectForm form);

/// Their fields, placed relative to the scene's anchor.
visibility_fields::VisibilityFields fieldsOf(frame::Frame& frame,
                                             const visibility_fields::RigidObjects& objects,
                                             const visibility_fields::FieldForm& form);

/// The objects' triangles for tracing rays, numbered as in the scene, without those of no object.
ray_tracing::RayScene objectRays(frame::Frame& frame, const visibility_fields::RigidObjects& objects);

/// Object of each triangle, for shaders.
gl::Buffer objectOfBuffer(const visibility_fields::RigidObjects& objects);

}  // namespace limen::techniques
