// SPDX-License-Identifier: BSD-3-Clause
// What a ray sees past an object, by neighbours in its field: they need not agree on what is hit, so that what each lets through is weighed and
// not its distance. Each position is asked for the direction to where the ray is likely to meet the object (Gortler et al. 1996 call it depth
// correction): halfway through the sphere or, from inside, at the origin, since back from where the ray leaves only what lies before the origin
// counts. Including shaders define seenAt(). Set up as field_lookup.glsl.
#include "renderer/visibility_fields/field_lookup.glsl"

// Share of the ray that a surface at this distance lets through.
float seenAt(float distance);

// FIELD_DOUBT: besides what a ray sees, the least and most that it may see by the rays of the field around: those that the look-up reads, and
// those at the corners of a square about the direction, doubtReach texels away from its middle. All is possible where a surface is near
// (fieldNear, of this ray and object alone), or where something blocks but it is not known where.
#ifdef FIELD_DOUBT
uniform float doubtReach;
vec2 fieldRange = vec2(1.0);
bool fieldBlocked, fieldFree;
void fieldBeginRange() {
  fieldRange = vec2(1.0, 0.0);
  fieldBlocked = false, fieldFree = false, fieldNear = false;
}
void fieldSpread(vec2 seen) {
  fieldRange = vec2(min(fieldRange.x, seen.x), max(fieldRange.y, seen.x));
  if (seen.y > 0.0) fieldFree = true;
  else fieldBlocked = true;
}
#endif

// Of an object, in its own axes and radii.
struct FieldView {
  vec3 origin;  // of the rays
  float radius, slack;  // slack: radii
  int firstMap;
};
// Until the next one: of its object is what is looked up.
FieldView fieldView(FieldObject object, vec3 origin, float slack) {
  fieldUse(object);
  return FieldView(fieldToObject(object, origin - object.centre) / object.radius, object.radius, 2.0 * slack, int(object.firstMap));
}

// asin to 7e-5 (Abramowitz and Stegun 4.4.45): a hundredth of the distance between positions at most.
vec3 fieldAngles(vec3 x) {
  return 1.5707963 - sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - 0.0187293 * x)));
}

// As fieldPlace(), the angle to 1e-5 (Abramowitz and Stegun 4.4.49): a thousandth of a texel.
vec2 fieldSeenPlace(vec3 local) {
#if FIELD_DIRECTION_FORM == 2
  const vec2 size = abs(local.xy);
  const float t = min(size.x, size.y) / max(max(size.x, size.y), 1e-12), t2 = t * t;
  const float turn = t * (1.2730689 + t2 * (-0.4205504 + t2 * (0.2293627 + t2 * (-0.1083947 + t2 * 0.0265281))));
  const vec2 p = min(length(local.xy), 1.0) * (size.x >= size.y ? vec2(1.0, turn) : vec2(turn, 1.0));
  return 0.5 + 0.5 * vec2(local.x < 0.0 ? -p.x : p.x, local.y < 0.0 ? -p.y : p.y);
#else
  return fieldPlace(local, FIELD_DIRECTION_FORM);
#endif
}

// Where the ray is looked up, and what the codes there mean.
struct FieldAsk {
  vec3 aim;
  float reach;        // of the aim from where the ray meets the sphere, in radii
  float from, along;  // of a distance, in radii: from + along * 2 * share
  float least;        // of it, to count
};

// By one ray of the field. x: share that is let through; y: 1 if nothing is met that counts, 0 otherwise. Of neighbours: weighed means.
vec2 fieldSeenBy(FieldView view, FieldAsk ask, int map, ivec2 texel) {
  const float share = fieldShare(map, clamp(texel, ivec2(0), ivec2(FIELD_SIDE - 1)));
  const float distance = ask.from + 2.0 * ask.along * share;
  if (share < 0.0) return vec2(1.0);
  const bool blocks = distance > ask.least;
  fieldNote(distance, 2.0 * share, abs(1.0 - 2.0 * share / ask.reach), blocks || view.slack == 0.0);
  return blocks ? vec2(seenAt(view.radius * distance), 0.0) : vec2(1.0);
}

vec2 fieldSeenTexel(FieldView view, FieldAsk ask, int map, ivec2 texel) {
  const vec2 seen = fieldSeenBy(view, ask, map, texel);
#ifdef FIELD_DOUBT
  fieldSpread(seen);
#endif
  return seen;
}

#ifdef FIELD_DOUBT
// As fieldSeenBy(), without a note: a ray that is near to a surface is so by its own texel.
vec2 fieldSeenCorner(FieldView view, FieldAsk ask, int map, ivec2 texel) {
  const float share = fieldShare(map, clamp(texel, ivec2(0), ivec2(FIELD_SIDE - 1)));
  const float distance = ask.from + 2.0 * ask.along * share;
  return share >= 0.0 && distance > ask.least ? vec2(seenAt(view.radius * distance), 0.0) : vec2(1.0);
}

// Notes what the rays at the corners of the square about a place, in texels, let through; but for `own`, whose ray is looked up anyway.
void fieldSpreadCorners(FieldView view, FieldAsk ask, int map, vec2 place, ivec2 own) {
  const ivec2 low = ivec2(floor(place - doubtReach)), high = ivec2(floor(place + doubtReach));
  if (low != own) fieldSpread(fieldSeenCorner(view, ask, map, low));
  if (high != own) fieldSpread(fieldSeenCorner(view, ask, map, high));
  const ivec2 left = ivec2(low.x, high.y), right = ivec2(high.x, low.y);
  if (left != own) fieldSpread(fieldSeenCorner(view, ask, map, left));
  if (right != own) fieldSpread(fieldSeenCorner(view, ask, map, right));
}
#endif

vec2 fieldSeenFrom(FieldView view, FieldAsk ask, int map) {
  vec3 local = fieldLocal(fieldMaps[map].xyz, ask.aim);
#if FIELD_FETCH == 3
  const vec2 place = float(FIELD_SIDE) * fieldSeenPlace(local) - 0.5;
  const vec2 corner = floor(place), f = place - corner;
  const ivec2 at = ivec2(corner);
#ifdef FIELD_DOUBT
  // Half a texel away the corners are those that are read.
  if (doubtReach > 0.5) fieldSpreadCorners(view, ask, map, place + 0.5, at);
#endif
  return mix(mix(fieldSeenTexel(view, ask, map, at), fieldSeenTexel(view, ask, map, at + ivec2(1, 0)), f.x),
             mix(fieldSeenTexel(view, ask, map, at + ivec2(0, 1)), fieldSeenTexel(view, ask, map, at + ivec2(1, 1)), f.x), f.y);
#else
#ifdef FIELD_DOUBT
  const vec2 middle = float(FIELD_SIDE) * fieldSeenPlace(local);
  const ivec2 own = ivec2(middle);
  const vec2 seen = fieldSeenTexel(view, ask, map, own);
  // Half a texel away one of the corners is the texel itself.
  if (doubtReach > 0.0) fieldSpreadCorners(view, ask, map, middle, own);
  return seen;
#else
#if FIELD_DIRECTION_FORM == 2
  return fieldSeenTexel(view, ask, map, ivec2(float(FIELD_SIDE) * fieldSeenPlace(local)));
#else
  return fieldSeenTexel(view, ask, map, fieldTexel(local, FIELD_SIDE, FIELD_DIRECTION_FORM));
#endif
#endif
#endif
}

#if FIELD_POSITION_FORM == 0
// Map of the lattice's position in row and column `at` of the octant of `point`.
int fieldCornerMap(FieldView view, vec3 point, ivec2 at) {
  const ivec2 own = ivec2(point.x < 0.0 ? -at.x : at.x, point.y < 0.0 ? -at.y : at.y);
  return view.firstMap + fieldLatticeIndex(own.x, own.y, point.z < 0.0, FIELD_SEGMENTS);
}
#endif

// Share that the positions around a point of the sphere let through.
vec2 fieldSeenAround(FieldView view, FieldAsk ask, vec3 point) {
#if FIELD_POSITION_FORM != 0
  return fieldSeenFrom(view, ask, view.firstMap + fieldNearestPosition(uint(view.firstMap), normalize(point)));
#else
  // The triangle of the lattice around the point, and its place in it.
  const vec3 angles = fieldAngles(min(abs(point), vec3(1.0)));
  const vec2 place = float(FIELD_SEGMENTS) / (angles.x + angles.y + angles.z) * angles.xy;
  const vec2 corner = floor(place), f = place - corner;
  const ivec2 cell = ivec2(corner);
  const bool upper = f.x + f.y > 1.0 && cell.x + cell.y + 2 <= FIELD_SEGMENTS;
  const vec3 weights = upper ? vec3(f.x + f.y - 1.0, 1.0 - f.y, 1.0 - f.x) : vec3(max(1.0 - f.x - f.y, 0.0), f.x, f.y);
  const ivec2 first = upper ? cell + 1 : cell, second = cell + ivec2(1, 0), third = cell + ivec2(0, 1);
#if FIELD_FETCH == 1
  const ivec2 at = weights.x >= max(weights.y, weights.z) ? first : weights.y >= weights.z ? second : third;
  return fieldSeenFrom(view, ask, fieldCornerMap(view, point, at));
#else
  // Rounded, a point on an octant's border may seem to be beyond it, where no corners are.
  const vec3 counted = cell.x + cell.y < FIELD_SEGMENTS ? weights : vec3(1.0, 0.0, 0.0);
  vec2 sum = counted.x * fieldSeenFrom(view, ask, fieldCornerMap(view, point, first));
  if (counted.y > 0.0) sum += counted.y * fieldSeenFrom(view, ask, fieldCornerMap(view, point, second));
  if (counted.z > 0.0) sum += counted.z * fieldSeenFrom(view, ask, fieldCornerMap(view, point, third));
  return sum / (counted.x + counted.y + counted.z);
#endif
#endif
}

// Share of a ray that the object lets through, which meets its sphere. `direction`: unit, in the object's axes.
float fieldSeenWithin(FieldView view, vec3 direction, vec3 middle, float halfLength, float entry, float leave) {
  ++fieldLookUps;
  const bool inside = entry < 0.0;
  FieldAsk ask;
  ask.aim = inside ? view.origin : middle;
  ask.reach = inside ? leave : halfLength;
  ask.from = inside ? leave : entry;
  ask.along = inside ? -1.0 : 1.0;
  ask.least = inside ? view.slack : -1.0;
  const vec2 back = fieldSeenAround(view, ask, middle + (inside ? halfLength : -halfLength) * direction);
#ifdef FIELD_DOUBT
  // From inside the distance of what blocks is the farthest that it can be.
  const vec2 backRange = fieldRange;
  const bool mixed = inside && fieldBlocked && fieldFree, unknown = inside && fieldBlocked && backRange.y > 0.0;
  if (mixed) fieldRange = vec2(0.0, 1.0);
#endif
  if (!(inside && back.x > back.y)) return back.x;
  // What blocks lets through by its distance, which is the farthest that it can be. On the way from where the ray's line enters the
  // sphere the nearest is met first, if nothing lies behind the origin. Of the neighbours only those that are blocked are in question.
  ++fieldLookUps;
  ask.reach = -entry, ask.from = entry, ask.along = 1.0;
#ifdef FIELD_DOUBT
  fieldRange = vec2(1.0, 0.0), fieldFree = false;
#endif
  const vec2 ahead = fieldSeenAround(view, ask, middle - halfLength * direction);
  if (ahead.y > 0.999999) fieldNoteUnknown();  // rounded
#ifdef FIELD_DOUBT
  fieldRange = mixed || unknown && fieldFree ? vec2(0.0, mixed ? 1.0 : backRange.y) : min(backRange, fieldRange);
#endif
  return back.y + min(back.x - back.y, (1.0 - back.y) * ahead.x);
}

float fieldSeen(FieldView view, vec3 direction) {
#ifdef FIELD_DOUBT
  fieldRange = vec2(1.0);
#endif
  const float along = -dot(view.origin, direction);
  const vec3 middle = view.origin + along * direction;
  const float squared = 1.0 - dot(middle, middle);
  if (!(squared > 0.0)) return 1.0;
  const float halfLength = sqrt(squared), leave = along + halfLength, entry = along - halfLength;
  if (!(leave > 0.0)) return 1.0;
#ifdef FIELD_DOUBT
  fieldBeginRange();
#endif
  const float seen = fieldSeenWithin(view, direction, middle, halfLength, entry, leave);
#ifdef FIELD_DOUBT
  if (fieldNear) fieldRange = vec2(0.0, 1.0);
#endif
  return seen;
}
