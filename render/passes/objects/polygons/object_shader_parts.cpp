#include "render/passes/objects/polygons/object_shader_parts.h"

namespace ergodome {

const char* const object_sight_source = R"(
const float half_turn = 3.14159265358979323846;
layout(binding = 0) uniform sampler2DArray table;
layout(location = 3) uniform int order;
layout(location = 20) uniform int table_orders;
layout(location = 4) uniform vec4 table_range;
layout(location = 5) uniform mat3 view_from_frame;
layout(location = 6) uniform vec4 boost;
layout(location = 25) uniform mat3 face_from_view;
#ifdef TURNING
layout(location = 21) uniform vec2 table_observers;
layout(location = 22) uniform vec4 turning;
layout(location = 23) uniform float inverse_reach;
layout(location = 24) uniform int degree;
layout(std140, binding = 0) uniform Eyes { vec4 eyes[330]; };
#endif
#ifdef BESIDE
layout(location = 26) uniform float beside;
#endif
// Returns the weights of Lagrange's cubic interpolation through four nodes, the first of which is
// `first`.
vec4 cubic_weights(float at, int first) {
  float t = at - float(first);
  return vec4(-(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0, 0.5 * t * (t - 2.0) * (t - 3.0),
              -0.5 * t * (t - 1.0) * (t - 3.0), t * (t - 1.0) * (t - 2.0) / 6.0);
}
vec4 read_layer(int layer, int first_column, int first_row, vec4 across, vec4 up) {
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      int at = first_column + j;
      vec4 node = texelFetch(table, ivec3(abs(at), first_row + i, layer), 0);
      sum += up[i] * across[j] * (at < 0 ? vec4(node.x, -node.y, node.zw) : node);
    }
  }
  return sum;
}
vec4 read_table(float r_observer, float r, float angle) {
  ivec3 last = textureSize(table, 0) - 1;
  float column = angle / (half_turn * float(table_orders)) * float(last.x);
  float row = clamp((1.0 / r - table_range.x) / (table_range.y - table_range.x), 0.0, 1.0) * float(last.y);
  int first_column = clamp(int(floor(column)) - 1, -1, last.x - 3);
  int first_row = clamp(int(floor(row)) - 1, 0, last.y - 3);
  vec4 across = cubic_weights(column, first_column);
  vec4 up = cubic_weights(row, first_row);
#ifdef TURNING
  vec4 deep = cubic_weights((1.0 / r_observer - table_observers.x) / (table_observers.y - table_observers.x) * float(last.z), 0);
  vec4 sum = vec4(0.0);
  for (int layer = 0; layer <= last.z; ++layer) {
    sum += deep[layer] * read_layer(layer, first_column, first_row, across, up);
  }
  return sum;
#else
  return read_layer(0, first_column, first_row, across, up);
#endif
}
// An eye; its vectors have components in the rest frame of the head.
struct Eye {
  vec3 outward;
  float r;
  vec4 boost;
  mat3 view;
};
Eye head() { return Eye(vec3(1.0, 0.0, 0.0), table_range.z, boost, view_from_frame); }
#ifdef TURNING
// Returns the eye at a position to the right of the head (p) and behind it (q), both as fractions
// of the maximum distance.
Eye eye_beside(float p, float q) {
  vec4 outward = vec4(0.0);
  vec4 velocity = vec4(0.0);
  vec4 right = vec4(0.0);
  vec4 up = vec4(0.0);
  vec4 back = vec4(0.0);
  float by_q = 1.0;
  for (int i = 0; i <= degree; ++i) {
    float term = by_q;
    for (int d = i; d <= degree; ++d) {
      // p^(d - i) q^i is term d (d + 1) / 2 + i.
      int at = 5 * (d * (d + 1) / 2 + i);
      outward += term * eyes[at];
      velocity += term * eyes[at + 1];
      right += term * eyes[at + 2];
      up += term * eyes[at + 3];
      back += term * eyes[at + 4];
      term *= p;
    }
    by_q *= q;
  }
  float speed = length(velocity.xyz);
  vec4 moved = speed > 0.0 ? vec4(velocity.xyz / speed, sqrt((1.0 - speed) / (1.0 + speed))) : vec4(1.0, 0.0, 0.0, 1.0);
  return Eye(normalize(outward.xyz), outward.w, moved, transpose(mat3(right.xyz, up.xyz, back.xyz)));
}
#endif
// Computes how an eye sees a position: direction and light travel time. `distance` is the affine
// distance along a photon whose energy at infinity is 1.
void see(Eye eye, vec3 place, out vec3 direction, out float time, out float distance) {
  float r = length(place);
  float along = dot(place, eye.outward);
  vec3 aside = place - along * eye.outward;
  float beside = length(aside);
  float phi = atan(beside, along);
  bool odd = order % 2 == 1;
  vec4 node = read_table(eye.r, r, odd ? half_turn * float(order - 1) + phi : half_turn * float(order) - phi);
  // If position and eye are in line with the hole, any plane through them is valid; selects one.
  vec3 across = beside > 0.0 ? aside / beside : vec3(0.0, 1.0, 0.0);
  float side = odd ? 1.0 : -1.0;
  float span = length(node.xy);
  direction = (node.x * eye.outward + side * node.y * across) / max(span, 1e-30);
  time = r * eye.r * span;
  distance = node.w * time;
}
// Returns the direction of the view in which light appears that comes from direction n of the rest
// frame, with the aberration of kernels/spacetime/kerr/frame_boost.h. `energy`: ratio of the
// photon's energy in the moving frame to that in the rest frame.
vec3 view_direction(Eye eye, vec3 n, out float energy) {
  float along = dot(n, eye.boost.xyz);
  vec3 across = n - along * eye.boost.xyz;
  float larger = 1.0 + abs(along);
  float smaller = dot(across, across) / larger;
  float with_it = (along > 0.0 ? larger : smaller) / eye.boost.w;
  float against = (along > 0.0 ? smaller : larger) * eye.boost.w;
  energy = 0.5 * (with_it + against);
  return eye.view * ((across + 0.5 * (with_it - against) * eye.boost.xyz) / energy);
}
#ifdef TURNING
// Returns the eye's distances to the right of the head and behind it for a direction of the view:
// omni_offset() of kernels/spacetime/trace/omni_camera.h.
vec2 eye_offset(vec3 view) {
  float level = sqrt(dot(view.xz, view.xz) + 1e-20);
  float part = clamp((level - turning.z) * turning.w, 0.0, 1.0);
  return part * part * (3.0 - 2.0 * part) * turning.x / level * vec2(-view.z, view.x);
}
// Finds the direction of the view in which a point appears, and its direction in the frame of the
// eye that looks there (outward, and two more axes). The position of an ODS eye depends on the view
// direction, so both are found by iteration.
void look(vec3 place, out vec3 direction, out vec3 view, out float time) {
  Eye eye = head();
  vec3 shift = vec3(0.0);
  view = vec3(0.0);
  for (int turn = 0; turn < 12; ++turn) {
    float distance_of_it;
    float energy;
    see(eye, place, direction, time, distance_of_it);
    vec3 seen = view_direction(eye, direction, energy);
    // The view direction is that of the point where the eye's line of sight meets a sphere around
    // the head, whose radius, the convergence distance, is 1 here. Both eyes see a point of that
    // sphere in the same view direction.
    float along = dot(seen, shift);
    vec3 next = shift + (sqrt(max(along * along + 1.0 - dot(shift, shift), 0.0)) - along) * seen;
    bool found = distance(next, view) < 3e-6;
    view = next;
    if (found) {
      break;
    }
    vec2 offset = eye_offset(view);
    shift = turning.y * vec3(offset.x, 0.0, offset.y);
    eye = eye_beside(inverse_reach * offset.x, inverse_reach * offset.y);
  }
  float outwards = dot(direction, eye.outward);
  direction = vec3(outwards, (direction - outwards * eye.outward).yz);
  view = face_from_view * view;
}
#else
void look(vec3 place, out vec3 direction, out vec3 view, out float time) {
  Eye eye = head();
  float affine;
  float energy;
  see(eye, place, direction, time, affine);
  view = view_direction(eye, direction, energy);
#ifdef BESIDE
  // The point lies at d n in the flat space of the head; points nearer to the eye hide it (kernels/eyes/flat/eye_line.h).
  vec3 seen = affine / table_range.w * energy * view - vec3(beside, 0.0, 0.0);
  time = length(seen);
  view = seen / max(time, 1e-30);
#endif
  view = face_from_view * view;
}
#endif
)";

const char* const object_projection_source = R"(
layout(location = 7) uniform int kind;
layout(location = 8) uniform float mirror;
layout(location = 9) uniform vec4 screen;
layout(location = 10) uniform int law;
layout(location = 11) uniform vec4 lens;
layout(location = 12) uniform vec4 polynomial;
layout(location = 13) uniform vec4 viewer;
const int dome = 0;
const int equirectangular = 1;
const int cylinder = 3;
const float pi = 3.14159265358979323846;
float lens_radius(float angle) {
  if (law == 1) {
    return sin(0.5 * angle) / lens.w;
  }
  if (law == 2) {
    return tan(0.5 * min(angle, 3.1)) / lens.w;
  }
  if (law == 3) {
    return sin(min(angle, 0.5 * pi)) / lens.w;
  }
  if (law == 4) {
    float within = min(angle, lens.z);
    float square = within * within;
    float radius = (((polynomial.w * square + polynomial.z) * square + polynomial.y) * square + polynomial.x) * within;
    float slope = ((7.0 * polynomial.w * square + 5.0 * polynomial.z) * square + 3.0 * polynomial.y) * square + polynomial.x;
    return radius + (angle - within) * slope;
  }
  return angle / lens.z;
}
// Returns the point of the dome that the viewer sees in a direction of the view, in radii of the
// dome, with components to the right, to the front and to the zenith.
vec3 dome_place(vec3 view) {
  vec3 at = view;
  if (viewer.w > 0.0) {
    float along = dot(viewer.xyz, view);
    at = viewer.xyz + (sqrt(along * along + 1.0 - dot(viewer.xyz, viewer.xyz)) - along) * view;
  }
  return vec3(at.x, -lens.y * at.z - lens.x * at.y, lens.y * at.y - lens.x * at.z);
}
vec4 clip_place(vec3 view, float depth) {
  vec4 clip = vec4(0.0, 0.0, depth, 1.0);
  if (kind == dome) {
    vec3 at = dome_place(view);
    float across = length(at.xy);
    clip.xy = across > 0.0 ? lens_radius(atan(across, at.z)) / across * vec2(at.x, -at.y) : vec2(0.0);
  } else if (kind == equirectangular) {
    clip.xy = vec2(screen.x * (atan(view.x, -view.z) / pi), atan(view.y, length(view.xz)) / (0.5 * pi));
  } else if (kind == cylinder) {
    float level = max(length(view.xz), 1e-6);
    clip.xy = vec2(atan(view.x, -view.z) / screen.x, (view.y / level - screen.w) / screen.y);
  } else {
    float ahead = -view.z;
    clip = vec4((view.xy - screen.zw * ahead) / screen.xy, depth * ahead, ahead);
  }
  clip.x *= mirror;
  return clip;
}
float horizontal_period() { return kind == equirectangular ? 2.0 * screen.x : kind == cylinder ? 2.0 * pi / screen.x : 0.0; }
bool wide(vec2 a, vec2 b) { return dot(a, b) < 0.5 * length(a) * length(b); }
bool torn_by_projection(vec3 a, vec3 b, vec3 c) {
  if (kind == dome) {
    vec3 p = dome_place(a);
    vec3 q = dome_place(b);
    vec3 r = dome_place(c);
    // The direction opposite the zenith is mapped to a whole circle. An orthographic lens sees
    // nothing below the dome's horizontal plane.
    float highest = max(p.z, max(q.z, r.z));
    float lowest = min(p.z, min(q.z, r.z));
    return (law == 3 && lowest < 0.0) || (highest < -0.3 && (wide(p.xy, q.xy) || wide(q.xy, r.xy) || wide(r.xy, p.xy)));
  }
  if (kind == equirectangular || kind == cylinder) {
    // The direction of a pole is mapped to a whole row.
    return min(abs(a.y), min(abs(b.y), abs(c.y))) > 0.9 && (wide(a.xz, b.xz) || wide(b.xz, c.xz) || wide(c.xz, a.xz));
  }
  return false;
}
)";

}  // namespace ergodome
