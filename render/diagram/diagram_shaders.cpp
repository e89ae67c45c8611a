#include "render/diagram/diagram_shaders.h"

namespace ergodome {

// Positions are in the camera's axes: x right, y up, z back.

const char* const diagram_surface_vertex_source = R"(#version 450 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec3 checker;
layout(location = 0) uniform vec4 screen;
layout(location = 1) uniform vec4 tile;
out vec3 surface_normal;
flat out vec4 surface_color;
out vec3 surface_checker;
void main() {
  surface_normal = normal;
  surface_color = color;
  surface_checker = checker;
  float depth = -place.z;
  float far_part = screen.w / (screen.w - screen.z);
  gl_Position = vec4(place.xy / screen.xy, (2.0 * far_part - 1.0) * depth - 2.0 * far_part * screen.z, depth);
  gl_Position.xy = gl_Position.xy * tile.xy + tile.zw * depth;
}
)";

const char* const diagram_surface_fragment_source = R"(#version 450 core
in vec3 surface_normal;
flat in vec4 surface_color;
in vec3 surface_checker;
out vec4 light;
void main() {
  // A lamp above the camera's left shoulder, seen from both sides of a surface.
  const vec3 lamp = normalize(vec3(-0.45, 0.6, 1.0));
  float facing = abs(dot(normalize(surface_normal), lamp));
  float dark = mod(floor(surface_checker.x) + floor(surface_checker.y), 2.0) == 1.0 ? surface_checker.z : 1.0;
  // Veils are translucent.
  float shaded = surface_color.a < 1.0 ? 0.7 + 0.3 * facing : 0.35 + 0.65 * facing;
  light = vec4(surface_color.rgb * (dark * shaded * surface_color.a), surface_color.a);
}
)";

const char* const diagram_line_vertex_source = R"(#version 450 core
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 color;
layout(location = 3) in float width;
layout(location = 0) uniform vec4 screen;
layout(location = 1) uniform vec4 tile;
layout(location = 2) uniform vec2 pixel;
out vec3 line_color;
out float beside;
vec4 clip(vec3 place) {
  float depth = -place.z;
  float far_part = screen.w / (screen.w - screen.z);
  vec4 at = vec4(place.xy / screen.xy, (2.0 * far_part - 1.0) * depth - 2.0 * far_part * screen.z, depth);
  at.xy = at.xy * tile.xy + tile.zw * depth;
  return at;
}
void main() {
  line_color = color;
  // Clips at the nearest depth, so that both ends have a position on the screen.
  vec3 ends[2] = vec3[2](from, to);
  for (int i = 0; i < 2; ++i) {
    if (-ends[i].z < screen.z && -ends[1 - i].z > screen.z) {
      ends[i] = mix(ends[1 - i], ends[i], (screen.z + ends[1 - i].z) / (ends[1 - i].z - ends[i].z));
    }
  }
  vec4 a = clip(ends[0]);
  vec4 b = clip(ends[1]);
  vec2 along = (b.xy / b.w - a.xy / a.w) / pixel;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  vec4 end = gl_VertexID < 2 ? a : b;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  beside = side;
  // Longer by a fifth of the width at both ends, so that neighbors meet without a gap.
  vec2 shift = vec2(-along.y, along.x) * side + along * (gl_VertexID < 2 ? -0.4 : 0.4);
  end.xy += shift * (0.5 * width) * pixel * end.w;
  gl_Position = end;
}
)";

const char* const diagram_line_fragment_source = R"(#version 450 core
in vec3 line_color;
in float beside;
out vec4 light;
void main() {
  light = vec4(line_color * (1.0 - 0.12 * beside * beside), 1.0);
}
)";

}  // namespace ergodome
