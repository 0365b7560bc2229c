// Light on bare ground: as little as a terrain can be drawn with.

#include "deformation.glsl"
#include "textureTile.glsl"

uniform samplerTile elevationSampler; // heights: of this level, of the level before, to display
uniform samplerTile normalSampler;    // normals (x, y)

#ifdef _VERTEX_
layout(location = 0) in vec3 vertex;
out vec2 uv;

void main() {
    uv = vertex.xy;
    float height = deformationHeight(uv, textureTile(elevationSampler, uv).xyz);
#ifdef SPHERE
    gl_Position = deformSphere(uv, height);
#else
    gl_Position = deformFlat(uv, height);
#endif
}
#endif

#ifdef _FRAGMENT_
in vec2 uv;
layout(location = 0) out vec4 colour;

void main() {
    vec2 slope = textureTile(normalSampler, uv).xy * 2.0 - 1.0;
    vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));
    float light = 0.2 + 0.8 * max(dot(normal, normalize(vec3(0.55, -0.6, 0.5))), 0.0);
    colour = vec4(vec3(light), 1.0);
}
#endif
