// SPDX-License-Identifier: BSD-3-Clause
// The programs of the graphics processor: particles as discs that are shaded like spheres.

export const VERTEX_SHADER = `#version 300 es
precision highp float;
precision highp int;
layout(location = 0) in float share_x;
layout(location = 1) in float share_y;
layout(location = 2) in float share_z;
layout(location = 3) in float shown;   // as stored
layout(location = 4) in float sieved;  // as stored
layout(location = 5) in float body;
uniform vec3 lower, size;
uniform mat4 view, projection;
uniform vec3 mirrors, planes;
uniform int rings;
uniform vec4 section;
uniform vec2 sieve;       // accepted stored values
uniform vec2 field;       // of the first and the last stored value
uniform float steps;      // the last stored value
uniform bool codes;       // stored values stand for words
uniform vec2 range;       // of the colours
uniform bool logarithmic;
uniform float height, enlarged, widest;
uniform vec2 depths;
uniform int every;
uniform highp sampler2D bodies;  // radius, visible
out float colour_share;
out float far_share;
flat out vec4 number;

vec3 copied(vec3 x, int k) {
  for (int axis = 0; axis < 3; ++axis) {
    if (mirrors[axis] == 0.0) continue;
    if ((k & 1) == 1) x[axis] = 2.0 * planes[axis] - x[axis];
    k >>= 1;
  }
  if (rings > 0) {
    float angle = 6.283185307179586 * float(k) / float(rings);
    x.z = x.y * sin(angle);
    x.y *= cos(angle);
  }
  return x;
}

void main() {
  vec3 own = lower + size * vec3(share_x, share_y, share_z);
  vec3 x = copied(own, gl_InstanceID);
  int number_of_body = int(body);
  vec2 of_body = texelFetch(bodies, ivec2(number_of_body & 255, number_of_body >> 8), 0).rg;
  bool hidden = of_body.g == 0.0 || dot(section.xyz, x) > section.w || sieved < sieve.x || sieved > sieve.y;
  // Copies about an axis touch one another as far as that does not blow them up.
  float radius = of_body.r;
  if (rings > 0) radius = clamp(3.2 * own.y / float(rings), radius, 3.0 * radius);
  vec4 eye = view * vec4(x, 1.0);
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : projection * eye;
  gl_PointSize = clamp(height * projection[1][1] * enlarged * radius / max(-eye.z, 1e-30), 1.0, widest);
  float value = field.x + (field.y - field.x) * shown / steps;
  if (codes) {
    colour_share = (mod(shown, 256.0) + 0.5) / 256.0;
  } else if (shown > steps) {
    colour_share = -1.0;
  } else if (logarithmic) {
    colour_share = clamp(log(max(value, range.x) / range.x) / log(range.y / range.x), 0.0, 1.0);
  } else {
    colour_share = clamp((value - range.x) / max(range.y - range.x, 1e-30), 0.0, 1.0);
  }
  far_share = clamp((-eye.z - depths.x) / (depths.y - depths.x), 0.0, 1.0);
  int k = gl_VertexID * every + 1;
  number = vec4(ivec4(k, k >> 8, k >> 16, gl_InstanceID) & 255) / 255.0;
}`;

export const FRAGMENT_SHADER = `#version 300 es
precision highp float;
in float colour_share;
in float far_share;
flat in vec4 number;
uniform sampler2D colours;
uniform bool picking;
uniform vec3 background;
out vec4 colour;

void main() {
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(place, place);
  if (squared > 1.0) discard;
  if (picking) {
    colour = number;
    return;
  }
  vec3 own = colour_share < 0.0 ? vec3(0.5) : texture(colours, vec2(colour_share, 0.5)).rgb;
  // Light from the eye's upper left; the distance fades a little into the background.
  vec3 normal = vec3(place.x, -place.y, sqrt(1.0 - squared));
  float light = 0.45 + 0.55 * max(dot(normal, normalize(vec3(-0.4, 0.5, 1.0))), 0.0);
  vec3 lit = own * light;
  // On a dark page the dark end of the colours, matter at rest, would be black on black: it is lifted towards grey, and
  // the rim of each disc is lit.
  float dark = 1.0 - dot(background, vec3(0.299, 0.587, 0.114));
  float missing = 1.0 - max(max(lit.r, lit.g), lit.b);
  lit += dark * (0.3 * missing + 0.25 * squared * squared) * vec3(0.75);
  colour = vec4(mix(lit, background, 0.35 * far_share), 1.0);
}`;
