// The ground of the hills: placed by the vertex stage, coloured by the fragment stage. Terrane sets
// `deformation` for each square of the terrain, and the two samplers to its tiles.

#include "textureTile.glsl"

uniform struct {
    vec4 offset;        // the square's lower left corner, its size (metres), its level
    vec4 camera;        // the camera, in sizes of the square from that corner; its height in metres
    vec2 blending;      // where this level's detail starts and ends to fade in
    mat4 localToScreen;
} deformation;

uniform samplerTile heightSampler; // heights: of this level, of the level before, to display
uniform samplerTile normalSampler; // normals (x, y): of this level, of the level before

#ifdef _VERTEX_
layout(location = 0) in vec3 vertex; // of the grid: xy in [0,1] over the square, z = 1
out vec3 point;                      // metres
out vec2 uv;
out float blend; // 0: this level, 1: the level before

void main() {
    uv = clamp(vertex.xy, 0.0, 1.0);
    vec3 height = textureTile(heightSampler, uv).xyz;
    vec2 way = abs(deformation.camera.xy - uv);
    float distance = max(max(way.x, way.y), deformation.camera.z);
    blend = clamp((distance - deformation.blending.x) / deformation.blending.y, 0.0, 1.0);

    float part = tilePart(heightSampler); // less than 1 while a coarser tile stands in
    float z = part < 1.0 ? height.z : mix(height.z, height.y, blend);
    point = vec3(uv * deformation.offset.z + deformation.offset.xy, z);
    // The edge of the grid hangs down a little, which hides gaps between squares.
    vec3 skirt = (vertex - vec3(uv, 1.0)) * deformation.offset.z / vec3(1.0, 1.0, part);
    gl_Position = deformation.localToScreen * vec4(point + skirt, 1.0);
}
#endif

#ifdef _FRAGMENT_
uniform vec3 sun; // towards it
uniform vec3 sky; // its colour

in vec3 point;
in vec2 uv;
in float blend;
layout(location = 0) out vec4 colour;

void main() {
    vec4 n = textureTile(normalSampler, uv) * 2.0 - 1.0;
    vec2 slope = tilePart(normalSampler) < 1.0 ? n.xy : mix(n.xy, n.zw, blend);
    vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));

    // Meadows, drier on the heights, earth where it is steep, and water.
    float height = smoothstep(0.0, 400.0, point.z);
    vec3 meadow = mix(vec3(0.24, 0.33, 0.14), vec3(0.46, 0.44, 0.24), height);
    vec3 ground = mix(vec3(0.38, 0.33, 0.27), meadow, smoothstep(0.80, 0.92, normal.z));

    ground = mix(vec3(0.10, 0.20, 0.26), ground, smoothstep(0.0, 1.0, point.z));

    float lit = max(dot(normal, normalize(sun)), 0.0);
    vec3 light = vec3(1.25, 1.15, 1.0) * lit + 0.45 * sky * (0.5 + 0.5 * normal.z);

    vec3 eye = vec3(deformation.camera.xy * deformation.offset.z + deformation.offset.xy,
                    deformation.camera.w);
    float air = 1.0 - exp(-length(point - eye) / 25000.0);
    colour = vec4(mix(ground * light, sky, air), 1.0);
}
#endif
