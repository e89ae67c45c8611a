#include "render/present/headset/eye_shader.h"

namespace ergodome {

// The axes of the room are x right, y up, z back, in meters. A cube map of OpenGL has z forward.
const char* const eye_shader_source = R"(
in vec2 place;
out vec4 colour;
layout(binding = 0) uniform samplerCube sky;
layout(binding = 1) uniform sampler2D captions;   // display light times coverage
layout(binding = 2) uniform sampler2D words;      // sRGB values times coverage
layout(binding = 3) uniform sampler2D starry;     // the sky's light with stars, pixel by pixel
layout(location = 0) uniform mat3 sky_from_eye;   // to the axes of the sky's pictures
layout(location = 3) uniform mat3 room_from_eye;
layout(location = 4) uniform vec4 tangents;       // of the view's left, right, lower and upper side
layout(location = 5) uniform vec3 eye_position;
layout(location = 6) uniform vec2 lighting;       // factor on the display's light, factor on the sky's light
layout(location = 7) uniform ivec4 flags;         // heat map, rest frame, sRGB values wanted, stars
layout(location = 8) uniform vec2 vignette;       // darkness, half angle of the clear view
layout(location = 9) uniform vec3 floor_middle;
layout(location = 10) uniform vec3 panel_middle[2];
layout(location = 12) uniform vec3 panel_right[2];  // divided by half of the panel's width
layout(location = 14) uniform vec3 panel_up[2];     // divided by half of its height
layout(location = 16) uniform vec3 panel_rows[2];   // first row and fraction of the rows that are stored, opacity

const vec3 frame_light = vec3(0.10, 0.16, 0.20);
const float grid_m = 0.5;        // distance of the floor's lines
const float floor_radius = 2.5;  // the floor fades out here
const float ring_radius = 2.5;
const float ring_height = 1.0;   // above the floor
const float line_m = 0.006;      // half of a line's width

vec3 decoded(vec3 value) {
  return mix(value / 12.92, pow((value + 0.055) / 1.055, vec3(2.4)), greaterThan(value, vec3(0.04045)));
}

// Coverage of a line at distance 0, whose pixel is `pixel` wide. A line thinner than a pixel gets fainter, not thinner.
float line_coverage(float distance, float pixel) {
  float half_width = max(line_m, 0.75 * pixel);
  return min(1.0, line_m / half_width) * (1.0 - smoothstep(half_width - 0.75 * pixel, half_width + 0.75 * pixel, distance));
}

// Coverage of the rest frame in a direction of the room. `pixel`: angle of a pixel.
float rest_frame(vec3 direction, float pixel) {
  vec3 from = eye_position - floor_middle;
  float covered = 0.0;
  if (direction.y < -1e-3 && from.y > 0.0) {
    float far = -from.y / direction.y;
    vec2 spot = from.xz + far * direction.xz;
    float radius = length(spot);
    vec2 beside = abs(spot - grid_m * round(spot / grid_m));
    // A pixel's footprint on the floor is longer along the view than across it.
    float across = far * pixel;
    float along = across / max(-direction.y, 0.05);
    vec2 view = normalize(direction.xz + vec2(1e-6));
    vec2 foot = abs(view) * along + abs(view.yx) * across;
    float lines = max(line_coverage(beside.x, foot.x), line_coverage(beside.y, foot.y));
    covered = 0.6 * lines * (1.0 - smoothstep(0.5 * floor_radius, floor_radius, radius));
  }
  float a = dot(direction.xz, direction.xz);
  float b = dot(from.xz, direction.xz);
  float c = dot(from.xz, from.xz) - ring_radius * ring_radius;
  float root = b * b - a * c;
  if (a > 1e-6 && root > 0.0) {
    float far = (-b + sqrt(root)) / a;
    if (far > 0.0) {
      float height = from.y + far * direction.y - ring_height;
      covered = max(covered, line_coverage(abs(height), far * pixel));
    }
  }
  return covered;
}

// Position on a panel: -1 to 1 across and upwards; outside of that range beside it or behind the eye.
vec2 on_panel(int panel, vec3 direction) {
  vec3 normal = cross(panel_right[panel], panel_up[panel]);
  float slope = dot(normal, direction);
  float far = dot(normal, panel_middle[panel] - eye_position) / (abs(slope) > 1e-9 ? slope : 1e-9);
  vec3 spot = eye_position + far * direction - panel_middle[panel];
  return far > 0.0 ? vec2(dot(spot, panel_right[panel]), dot(spot, panel_up[panel])) : vec2(9.0);
}

void main() {
  vec3 view = normalize(vec3(mix(tangents.x, tangents.y, place.x), mix(tangents.z, tangents.w, place.y), -1.0));
  vec3 far = sky_from_eye * view;
  vec3 seen = flags.w != 0 ? texelFetch(starry, ivec2(gl_FragCoord.xy), 0).rgb
                           : textureLod(sky, vec3(far.xy, -far.z), 0.0).rgb;
  vec3 light = max(lighting.y * seen, vec3(0.0));
  light = clamp(flags.x != 0 ? light : toned(light), 0.0, 1.0);
  float angle = acos(clamp(-view.z, -1.0, 1.0));
  light *= 1.0 - vignette.x * smoothstep(vignette.y, vignette.y + 0.25, angle);
  light *= lighting.x;
  vec3 direction = room_from_eye * view;
  if (flags.y != 0) {
    light = mix(light, frame_light, rest_frame(direction, length(fwidth(view))));
  }
  vec2 spot = on_panel(0, direction);
  if (panel_rows[0].z > 0.0 && max(abs(spot.x), abs(spot.y)) < 1.0) {
    float row = (0.5 - 0.5 * spot.y - panel_rows[0].x) / panel_rows[0].y;
    vec4 caption = row >= 0.0 && row <= 1.0 ? textureLod(captions, vec2(0.5 + 0.5 * spot.x, row), 0.0) : vec4(0.0);
    light = light * (1.0 - panel_rows[0].z * caption.a) + panel_rows[0].z * caption.rgb;
  }
  spot = on_panel(1, direction);
  if (panel_rows[1].z > 0.0 && max(abs(spot.x), abs(spot.y)) < 1.0) {
    vec4 text = textureLod(words, vec2(0.5 + 0.5 * spot.x, 0.5 - 0.5 * spot.y), 0.0);
    light = light * (1.0 - text.a) + decoded(text.rgb / max(text.a, 1e-3)) * text.a;
  }
  light = clamp(light, 0.0, 1.0);
  colour = vec4(flags.z != 0 ? encoded(light) : light, 1.0);
}
)";

}  // namespace ergodome
