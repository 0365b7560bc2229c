// The ground: heights and normals of the tiles, coloured by height and slope.

#include "textureTile.glsl"

uniform struct {
    vec4 offset;        // lower left corner of the quad, its size (metres), its level
    vec4 camera;        // camera relative to the quad, in quad sizes; its height in metres
    vec2 blending;      // where this level's detail starts and ends to fade in
    mat4 localToScreen;
} deformation;

uniform samplerTile elevationSampler; // heights: of this level, of the level before, to display
uniform samplerTile normalSampler;    // normals (x, y): of this level, of the level before

#ifdef _VERTEX_
layout(location = 0) in vec3 vertex; // of the skirted grid: xy in [0,1] over the quad, z = 1
out vec3 point;  // metres
out vec2 uv;
out float blend; // 0: this level, 1: the level before

void main() {
    uv = clamp(vertex.xy, 0.0, 1.0);
    vec3 zfc = textureTile(elevationSampler, uv).xyz;
    vec2 way = abs(deformation.camera.xy - uv);
    float distance = max(max(way.x, way.y), deformation.camera.z);
    blend = clamp((distance - deformation.blending.x) / deformation.blending.y, 0.0, 1.0);

    float part = tilePart(elevationSampler);
    float z = part < 1.0 ? zfc.z : mix(zfc.z, zfc.y, blend);
    point = vec3(uv * deformation.offset.z + deformation.offset.xy, z);
    // The skirt, slightly outside and below, hides gaps between quads: those that rounding leaves,
    // and those between tiles of different levels when some are missing.
    vec3 skirt = (vertex - vec3(uv, 1.0)) * deformation.offset.z / vec3(1.0, 1.0, part);
    gl_Position = deformation.localToScreen * vec4(point + skirt, 1.0);
}
#endif

#ifdef _FRAGMENT_
// From weather.glsl.
vec3 sunDirection();
vec3 sunlight();
vec3 skylight(vec3 normal);
vec3 plain();
vec3 throughAir(vec3 colour, vec3 eye, vec3 point);
vec3 developed(vec3 light);

uniform float snowLine; // metres
uniform float treeLine; // metres

in vec3 point;
in vec2 uv;
in float blend;
layout(location = 0) out vec4 colour;

float hash(vec2 p) {
    vec3 q = fract(vec3(p.xyx) * 0.1031);
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}

// Smooth noise in [0,1].
float noise(vec2 p) {
    vec2 i = floor(p), f = p - i;
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x),
               mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}

// Patches of several sizes, in [0,1].
float patches(vec2 p) {
    return 0.5 * noise(p / 900.0) + 0.3 * noise(p / 210.0) + 0.2 * noise(p / 47.0);
}

// Tussocks and stones, as far as pixels can show them.
float grain(vec2 p, float distance) {
    float fine = 0.6 * noise(p / 11.0) + 0.4 * noise(p / 4.3);
    return 1.0 + 0.9 * (fine - 0.5) * exp(-distance / 3500.0);
}

vec3 surface(vec3 p, vec3 n) {
    float patchy = patches(p.xy) - 0.5;
    float height = p.z + 500.0 * patchy;

    vec3 meadow = mix(vec3(0.075, 0.105, 0.030), vec3(0.150, 0.140, 0.052), noise(p.xy / 130.0));
    vec3 forest = vec3(0.026, 0.048, 0.018) * (0.8 + 0.5 * noise(p.xy / 23.0));
    vec3 rock = mix(vec3(0.150, 0.132, 0.118), vec3(0.235, 0.215, 0.195),
                    noise(vec2(p.z / 31.0, dot(p.xy, vec2(0.004)))));
    vec3 scree = vec3(0.225, 0.205, 0.180);
    vec3 snow = vec3(0.84, 0.88, 0.94);

    float wooded = smoothstep(treeLine, treeLine - 500.0, height) * smoothstep(0.78, 0.88, n.z);
    vec3 c = mix(meadow, forest, wooded * smoothstep(-0.12, 0.06, patchy));
    vec2 inside = 50000.0 - abs(p.xy);
    c = mix(plain(), c, smoothstep(0.0, 4000.0, min(inside.x, inside.y) + 2500.0 * patchy));
    c = mix(c, scree, smoothstep(treeLine - 100.0, treeLine + 500.0, height));
    c = mix(c, rock, smoothstep(0.86, 0.70, n.z + 0.12 * patchy));
    // Snow lies where it is high and not too steep.
    float snowy = smoothstep(snowLine - 250.0, snowLine + 350.0, height);
    return mix(c, snow, snowy * smoothstep(0.52, 0.74, n.z + 0.2 * patchy));
}

void main() {
    vec4 n = textureTile(normalSampler, uv) * 2.0 - 1.0;
    vec2 slope = tilePart(normalSampler) < 1.0 ? n.xy : mix(n.xy, n.zw, blend);
    vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));

    vec3 eye = vec3(deformation.camera.xy * deformation.offset.z + deformation.offset.xy,
                    deformation.camera.w);
    float lit = max(dot(normal, sunDirection()), 0.0);
    vec3 light = sunlight() * lit + skylight(normal);
    vec3 reflected = surface(point, normal) * grain(point.xy, length(point - eye)) * light;
    colour = vec4(developed(throughAir(reflected, eye, point)), 1.0);
}
#endif
