#include "render/passes/objects/polygons/object_shaders.h"

#include "render/passes/objects/polygons/object_shader_parts.h"

namespace ergodome {

namespace {

const char* const version = "#version 450 core\n";

const char* const vertex_main = R"(
layout(location = 0) in vec3 position_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 texture_in;
layout(location = 3) in vec3 color_in;
layout(location = 0) uniform mat3 model;
layout(location = 1) uniform vec3 middle;
layout(location = 2) uniform mat3 turn;
out vec3 corner_place;
out vec3 corner_normal;
out vec2 corner_texture;
out vec3 corner_color;
void main() {
  corner_place = model * position_in + middle;
  corner_normal = turn * normal_in;
  corner_texture = texture_in;
  corner_color = color_in;
}
)";

// Computes tessellation levels from how much the middle of an edge deviates from a straight line on
// the screen: eqs. 18 and 19 of the paper. All quantities are symmetric in both ends of an edge, so
// that the two patches at an edge agree.
const char* const control_main = R"(
layout(vertices = 3) out;
layout(location = 14) uniform vec4 tessellation;
in vec3 corner_place[];
in vec3 corner_normal[];
in vec2 corner_texture[];
in vec3 corner_color[];
out vec3 patch_place[];
out vec3 patch_normal[];
out vec2 patch_texture[];
out vec3 patch_color[];
vec2 on_screen[6];
bool is_seen[6];
float level(int from, int to, int between) {
  float bow = distance(on_screen[between], 0.5 * (on_screen[from] + on_screen[to]));
  float len = distance(on_screen[from], on_screen[to]);
  if (!(is_seen[from] && is_seen[to] && is_seen[between])) {
    return tessellation.x;
  }
  float share = len > 0.0 ? tessellation.y * pow(bow / len, tessellation.z) : 0.0;
  return max(1.0, tessellation.x * clamp(share, 0.0, 1.0));
}
// Computes how the three corners, and the midpoints of the opposite edges, are seen.
void see_ends_and_middles() {
  for (int i = 0; i < 6; ++i) {
    vec3 place = i < 3 ? corner_place[i] : 0.5 * (corner_place[(i + 1) % 3] + corner_place[(i + 2) % 3]);
    vec3 direction;
    vec3 view;
    float time;
    look(place, direction, view, time);
    vec4 clip = clip_place(view, 0.0);
    on_screen[i] = clip.xy / clip.w;
    is_seen[i] = clip.w > 0.0;
  }
}
void main() {
  patch_place[gl_InvocationID] = corner_place[gl_InvocationID];
  patch_normal[gl_InvocationID] = corner_normal[gl_InvocationID];
  patch_texture[gl_InvocationID] = corner_texture[gl_InvocationID];
  patch_color[gl_InvocationID] = corner_color[gl_InvocationID];
  if (gl_InvocationID == 0) {
    vec3 levels = vec3(1.0);
    if (tessellation.x > 1.0) {
      see_ends_and_middles();
      // Triangles entirely behind a flat screen can be coarse: five faces of a cube have such triangles.
      if (is_seen[0] || is_seen[1] || is_seen[2] || is_seen[3] || is_seen[4] || is_seen[5]) {
        levels = vec3(level(1, 2, 3), level(2, 0, 4), level(0, 1, 5));
      }
    }
    gl_TessLevelOuter[0] = levels.x;
    gl_TessLevelOuter[1] = levels.y;
    gl_TessLevelOuter[2] = levels.z;
    gl_TessLevelInner[0] = (levels.x + levels.y + levels.z) / 3.0;
  }
}
)";

const char* const evaluation_main = R"(
layout(triangles, equal_spacing, ccw) in;
in vec3 patch_place[];
in vec3 patch_normal[];
in vec2 patch_texture[];
in vec3 patch_color[];
out vec3 seen_place;
out vec3 seen_normal;
out vec2 seen_texture;
out vec3 seen_color;
out vec3 seen_direction;
out vec3 seen_view;
out vec3 flat_direction;
void main() {
  vec3 share = gl_TessCoord;
  seen_place = share.x * patch_place[0] + share.y * patch_place[1] + share.z * patch_place[2];
  seen_normal = share.x * patch_normal[0] + share.y * patch_normal[1] + share.z * patch_normal[2];
  seen_texture = share.x * patch_texture[0] + share.y * patch_texture[1] + share.z * patch_texture[2];
  seen_color = share.x * patch_color[0] + share.y * patch_color[1] + share.z * patch_color[2];
  float time;
  look(seen_place, seen_direction, seen_view, time);
  flat_direction = normalize(seen_place - vec3(table_range.z, 0.0, 0.0));
  // Depth is the light travel time, scaled from 0 to 1.
  gl_Position = clip_place(seen_view, time / (time + table_range.z));
}
)";

// Discards triangles that the hole or the projection tears apart. If the picture wraps around,
// triangles that extend beyond one side are also drawn on the other side.
const char* const geometry_main = R"(
layout(triangles) in;
layout(triangle_strip, max_vertices = 9) out;
layout(location = 14) uniform vec4 tessellation;
in vec3 seen_place[];
in vec3 seen_normal[];
in vec2 seen_texture[];
in vec3 seen_color[];
in vec3 seen_direction[];
in vec3 seen_view[];
in vec3 flat_direction[];
out vec3 place;
out vec3 normal;
out vec2 texture_place;
out vec3 corner_light;
bool torn_by_hole() {
  float around = 0.0;
  float around_flat = 0.0;
  for (int i = 0; i < 3; ++i) {
    around += distance(seen_direction[i], seen_direction[(i + 1) % 3]);
    around_flat += distance(flat_direction[i], flat_direction[(i + 1) % 3]);
  }
  // Keeps triangles that cover only a small part of the ring around the hole, however much they are
  // magnified.
  float widest = 1.0;
  for (int i = 0; i < 3; ++i) {
    vec2 one = seen_direction[i].yz;
    vec2 other = seen_direction[(i + 1) % 3].yz;
    widest = min(widest, dot(one, other) / max(length(one) * length(other), 1e-30));
  }
  return around > tessellation.w * around_flat && widest < 0.98;
}
void draw(float shift) {
  for (int i = 0; i < 3; ++i) {
    place = seen_place[i];
    normal = seen_normal[i];
    texture_place = seen_texture[i];
    corner_light = seen_color[i];
    gl_Position = gl_in[i].gl_Position;
    float period = horizontal_period();
    if (period > 0.0) {
      float from_first = gl_in[i].gl_Position.x - gl_in[0].gl_Position.x;
      gl_Position.x = gl_in[0].gl_Position.x + from_first - period * round(from_first / period) + shift;
    }
    EmitVertex();
  }
  EndPrimitive();
}
void main() {
  if (torn_by_hole() || torn_by_projection(seen_view[0], seen_view[1], seen_view[2])) {
    return;
  }
  draw(0.0);
  float period = horizontal_period();
  if (period > 0.0) {
    draw(period);
    draw(-period);
  }
}
)";

const char* const fragment_main = R"(
layout(location = 15) uniform vec3 color;
layout(location = 16) uniform vec3 checker;
layout(location = 17) uniform int textured;
layout(location = 18) uniform vec4 light;
layout(location = 19) uniform vec4 light_table_range;
layout(binding = 1) uniform sampler2DArray light_table;
layout(binding = 2) uniform sampler2D image;
in vec3 place;
in vec3 normal;
in vec2 texture_place;
in vec3 corner_light;
layout(location = 0) out vec4 shown;
float lapse(float r) { return sqrt((r - 2.0) / r); }
// Returns the illuminance of a surface by light that arrives on the shorter way around the hole
// (side 1) or on the longer way (side -1): eqs. 20 and 21 of the paper.
float illuminance(float side) {
  float r = length(place);
  float r_light = light_table_range.z;
  vec3 outward = light.xyz / r_light;
  float along = dot(outward, place);
  vec3 beside = place - along * outward;
  float off_axis = length(beside);
  vec3 across = off_axis > 0.0 ? beside / off_axis : normalize(cross(outward, outward.yzx + vec3(1.0, 0.0, 0.0)));
  float phi = atan(off_axis, along);
  float angle = side > 0.0 ? phi : two_pi - phi;
  vec2 size = vec2(textureSize(light_table, 0).xy);
  vec2 at = vec2(angle / two_pi, (1.0 / r - light_table_range.x) / (light_table_range.y - light_table_range.x));
  vec3 node = texture(light_table, vec3((at * (size - 1.0) + 0.5) / size, 0.0)).xyz;
  float time = max(r * r_light * length(node.xy), 1e-3);
  vec2 emission = normalize(vec2(node.z, node.y * lapse(r) * r_light / (light_table_range.w * r)));
  vec3 radial = place / r;
  vec3 onward = side * (cos(phi) * across - sin(phi) * outward);
  vec3 to_light = emission.x * radial - emission.y * onward;
  // Transforms the normal to the rest frame. Radial lengths are larger than coordinate differences,
  // so the radial component of a normal is smaller.
  vec3 n = normalize(normal);
  vec3 measured = normalize(n + (lapse(r) - 1.0) * dot(n, radial) * radial);
  return light.w * max(0.0, dot(measured, to_light)) / (time * time);
}
void main() {
  vec3 shine = color * corner_light;
  if (textured != 0) {
    shine *= texture(image, vec2(texture_place.x, 1.0 - texture_place.y)).rgb;
  }
  if (checker.x > 0.0) {
    vec2 cell = floor(texture_place * checker.xy);
    shine *= mod(cell.x + cell.y, 2.0) > 0.5 ? checker.z : 1.0;
  }
  if (light.w > 0.0) {
    shine *= illuminance(1.0) + illuminance(-1.0);
  }
  shown = vec4(min(shine, vec3(6e4)), 1.0);
}
)";

std::string sight_version(ObjectSight sight) {
  const char* const defined = sight == ObjectSight::omni     ? "#define TURNING\n"
                              : sight == ObjectSight::beside ? "#define BESIDE\n"
                                                             : "";
  return std::string(version) + defined;
}

}  // namespace

std::string object_vertex_source() { return std::string(version) + vertex_main; }

std::string object_control_source(ObjectSight sight) {
  return sight_version(sight) + object_sight_source + object_projection_source + control_main;
}

std::string object_evaluation_source(ObjectSight sight) {
  return sight_version(sight) + object_sight_source + object_projection_source + evaluation_main;
}

std::string object_geometry_source() { return std::string(version) + object_projection_source + geometry_main; }

std::string object_fragment_source() {
  return std::string(version) + "const float two_pi = 6.28318530717958647692;\n" + fragment_main;
}

}  // namespace ergodome
