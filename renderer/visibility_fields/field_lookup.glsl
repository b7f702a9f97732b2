// SPDX-License-Identifier: BSD-3-Clause
// Rays against objects by their fields. Source: Gaitatzes 2012, section 4.4.2. Set up as field_texel.glsl.
#include "renderer/visibility_fields/field_objects.glsl"
#include "renderer/visibility_fields/field_texel.glsl"

const float kFieldNothing = -1.0;
uint fieldLookUps = 0u;  // spheres that rays of this invocation met

// FIELD_NEAR: whether a ray of this invocation found a surface that is as near to its origin as some footprints of the stored ray
// that told of it, so that this does not tell what is there, or found that something blocks it but not where. Objects find their own
// surface only where it blocks.
#ifdef FIELD_NEAR
bool fieldNear = false;
uniform float nearFootprints;
// `distance`: of the surface from the origin, and `way` from the position, in radii; `beside`: how far from the ray the stored one is
// there, in units of what the position is from the ray's own place on the sphere.
void fieldNote(float distance, float way, float beside, bool counts) {
  if (counts && abs(distance) < nearFootprints * (FIELD_TEXEL_SPACING * way + FIELD_POSITION_SPACING * beside)) fieldNear = true;
}
void fieldNoteUnknown() { fieldNear = true; }
#else
void fieldNote(float distance, float way, float beside, bool counts) {}
void fieldNoteUnknown() {}
#endif

void fieldOffer(uint firstMap, int index, vec3 direction, inout float most, inout int best) {
  const float cosine = dot(fieldMaps[firstMap + uint(index)].xyz, direction);
  if (cosine > most) {
    most = cosine;
    best = index;
  }
}

void fieldOfferCorner(uint firstMap, ivec2 at, vec3 folded, inout float most, inout ivec2 found) {
  if (at.x + at.y > FIELD_SEGMENTS) return;
  const float cosine = dot(fieldMaps[firstMap + uint(fieldLatticeIndex(at.x, at.y, false, FIELD_SEGMENTS))].xyz, folded);
  if (cosine > most) {
    most = cosine;
    found = at;
  }
}

// Number of the position nearest to a unit vector, as PositionMap::nearest() finds it. Lattice: four candidates; their corner of the
// octant is the same in all octants.
int fieldNearestPosition(uint firstMap, vec3 d) {
  float most = -2.0;
  int best = 0;
#if FIELD_POSITION_FORM == 0
  const ivec2 cell = ivec2(floor(fieldLatticePlace(d, FIELD_SEGMENTS)));
  const vec3 folded = abs(d);
  ivec2 found = cell;
  fieldOfferCorner(firstMap, cell, folded, most, found);
  fieldOfferCorner(firstMap, cell + ivec2(1, 0), folded, most, found);
  fieldOfferCorner(firstMap, cell + ivec2(0, 1), folded, most, found);
  fieldOfferCorner(firstMap, cell + ivec2(1, 1), folded, most, found);
  best = fieldLatticeIndex(d.x < 0.0 ? -found.x : found.x, d.y < 0.0 ? -found.y : found.y, d.z < 0.0, FIELD_SEGMENTS);
#elif FIELD_POSITION_FORM == 1
  const int rows = FIELD_SEGMENTS;
  const int row = int(floor(atan(length(d.xy), d.z) / kFieldPi * float(rows)));
  const int column = int(floor((d.x == 0.0 && d.y == 0.0 ? 0.0 : atan(d.y, d.x)) / kFieldPi * float(rows)));
  for (int at = max(row - 1, 0); at <= min(row + 1, rows - 1); ++at)
    fieldOffer(firstMap, 2 * rows * at + (column + 2 * rows) % (2 * rows), d, most, best);
#else
  const vec3 size = abs(d);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int face = 2 * axis + (d[axis] < 0.0 ? 1 : 0);
  const vec2 place = vec2(d[(axis + 1) % 3], d[(axis + 2) % 3]) / size[axis];
  const ivec2 cell = ivec2(floor((place + 1.0) * 0.5 * float(FIELD_SEGMENTS)));
  for (int j = max(cell.y - 1, 0); j <= min(cell.y + 1, FIELD_SEGMENTS - 1); ++j)
    for (int i = max(cell.x - 1, 0); i <= min(cell.x + 1, FIELD_SEGMENTS - 1); ++i)
      fieldOffer(firstMap, (face * FIELD_SEGMENTS + j) * FIELD_SEGMENTS + i, d, most, best);
#endif
  return best;
}

// Map and texel of the ray from a point of the unit sphere along a unit vector, both in the object's axes.
struct FieldEntry {
  int map;
  ivec2 texel;
};
FieldEntry fieldEntry(uint firstMap, vec3 point, vec3 direction) {
  FieldEntry entry;
  entry.map = int(firstMap) + fieldNearestPosition(firstMap, point);
  const vec3 inwards = -fieldMaps[entry.map].xyz;
  vec3 local = vec3(dot(fieldTangent(inwards), direction), dot(fieldBitangent(inwards), direction), dot(inwards, direction));
  // A ray that grazes the sphere may leave the half space of the nearest position.
  if (local.z < 0.0) local = vec3(local.xy / length(local.xy), 0.0);
  entry.texel = fieldTexel(local, FIELD_SIDE, FIELD_DIRECTION_FORM);
  return entry;
}

// Point of the unit disc that stands for the way from a position to `aim`: fieldTangent() and fieldBitangent() of the normal, written out.
vec3 fieldLocal(vec3 position, vec3 aim) {
  const vec3 z = -position, v = aim - position;
  const float s = z.z >= 0.0 ? 1.0 : -1.0;
  const float w = -(z.x * v.x + z.y * v.y) / (s + z.z) - v.z;
  return inversesqrt(dot(v, v)) * vec3(v.x + s * z.x * w, s * v.y + z.y * w, dot(z, v));
}

// As fieldEntry(), but from the nearest position to a point within the sphere: where the ray is likely to meet the object.
FieldEntry fieldAimedEntry(uint firstMap, vec3 point, vec3 aim) {
  FieldEntry entry;
  entry.map = int(firstMap) + fieldNearestPosition(firstMap, point);
  entry.texel = fieldTexel(fieldLocal(fieldMaps[entry.map].xyz, aim), FIELD_SIDE, FIELD_DIRECTION_FORM);
  return entry;
}

// Where a ray passes an object's sphere: distances of entry and exit, and the point halfway, relative to the centre. Nearest to
// the centre the ray is known best, so that a far origin costs nothing.
struct FieldPassage {
  float entry, leave;  // entry > leave: it misses
  vec3 middle;
  float halfLength;
};
FieldPassage fieldPassage(FieldObject object, vec3 origin, vec3 direction) {
  const vec3 fromCentre = origin - object.centre;
  const float along = -dot(fromCentre, direction);
  FieldPassage passage;
  passage.middle = fromCentre + along * direction;
  const float squared = object.radius * object.radius - dot(passage.middle, passage.middle);
  passage.halfLength = sqrt(max(squared, 0.0));
  passage.entry = along - passage.halfLength;
  passage.leave = squared > 0.0 ? along + passage.halfLength : passage.entry - 1.0;
  return passage;
}

// Where a ray meets an object.
struct FieldHit {
  float distance;  // kFieldNothing: none
  FieldEntry entry;  // of the field, if the ray meets the sphere
  bool inside;       // looked up on the way back
};

// From inside its sphere the field tells what is met first on the way
// back from where the ray leaves: the ray is blocked if that lies before the origin by more than `slack` diameters, and the
// distance is the farthest that the blocker can be. FIELD_AIMED: positions are asked for the direction to where the ray is likely to meet
// the object, and from inside also on the way from where the ray's line enters, which meets the nearest first, if nothing lies behind the
// origin.
FieldHit fieldHit(FieldObject object, vec3 origin, vec3 direction, float slack) {
  FieldHit hit;
  hit.distance = kFieldNothing;
  fieldUse(object);
  const FieldPassage passage = fieldPassage(object, origin, direction);
  if (!(passage.leave > max(passage.entry, 0.0))) return hit;
  ++fieldLookUps;
  const vec3 way = fieldToObject(object, direction);
  const vec3 middle = fieldToObject(object, passage.middle);
  hit.inside = passage.entry < 0.0;
  const vec3 point = normalize(middle + (hit.inside ? passage.halfLength : -passage.halfLength) * way);
#ifdef FIELD_AIMED
  const vec3 aim = (hit.inside ? fieldToObject(object, origin - object.centre) : middle) / object.radius;
  hit.entry = fieldAimedEntry(object.firstMap, point, aim);
#else
  hit.entry = fieldEntry(object.firstMap, point, hit.inside ? -way : way);
#endif
  const float share = fieldShare(hit.entry.map, hit.entry.texel);
  if (share < 0.0) return hit;
  const float fromSphere = 2.0 * object.radius * share;
  if (!hit.inside) {
    hit.distance = passage.entry + fromSphere;
    fieldNote(hit.distance / object.radius, 2.0 * share, 1.0, true);
    return hit;
  }
  const float before = passage.leave - fromSphere;
  const bool blocks = before > 2.0 * object.radius * slack;
  fieldNote(before / object.radius, 2.0 * share, 1.0, blocks || slack == 0.0);
  if (!blocks) return hit;
  hit.distance = before;
#ifdef FIELD_AIMED
  ++fieldLookUps;
  const FieldEntry entry = fieldAimedEntry(object.firstMap, normalize(middle - passage.halfLength * way), aim);
  const float shareAhead = fieldShare(entry.map, entry.texel), ahead = passage.entry + 2.0 * object.radius * shareAhead;
  if (shareAhead >= 0.0 && ahead > 2.0 * object.radius * slack && ahead < before) {
    hit.distance = ahead;
    hit.entry = entry;
    hit.inside = false;  // seen from the side that the ray comes from
  }
#endif
  return hit;
}

// Distance to the object along the ray; kFieldNothing: none.
float fieldDistance(uint index, vec3 origin, vec3 direction, float slack) {
  return fieldHit(fieldObjects[index], origin, direction, slack).distance;
}

#if !defined(FIELD_VARIED) && FIELD_DISTANCE_BITS < FIELD_BITS
// Normal where a ray meets the object, in the world, on the side that the ray comes from.
vec3 fieldNormalAt(FieldObject object, FieldHit hit) {
  const vec3 n = fieldHitNormal(hit.entry.map, hit.entry.texel);
  const vec3 normal = n.x * object.axisX.xyz + n.y * object.axisY.xyz + n.z * object.axisZ.xyz;
  return hit.inside ? -normal : normal;
}
#endif
