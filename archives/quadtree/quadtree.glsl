// Draws the quads of a flat terrain, coloured by level, with their outlines.

uniform struct {
    vec4 offset;        // lower left corner, size (metres), level
    mat4 localToScreen;
} deformation;

#ifdef _VERTEX_
layout(location = 0) in vec3 vertex; // xy in [0,1] over the quad
out vec2 uv;

void main() {
    uv = vertex.xy;
    vec2 p = vertex.xy * deformation.offset.z + deformation.offset.xy;
    gl_Position = deformation.localToScreen * vec4(p, 0.0, 1.0);
}
#endif

#ifdef _FRAGMENT_
in vec2 uv;
layout(location = 0) out vec4 colour;

// A hue for each level; neighbouring levels differ clearly.
vec3 levelColour(float level) {
    vec3 hue = fract(vec3(0.0, 1.0 / 3.0, 2.0 / 3.0) + level * 0.382);
    return mix(vec3(0.35), vec3(1.0), abs(hue * 2.0 - 1.0));
}

void main() {
    vec2 toEdge = min(uv, 1.0 - uv) / fwidth(uv); // pixels
    float line = 1.0 - smoothstep(0.5, 1.5, min(toEdge.x, toEdge.y));
    colour = vec4(mix(levelColour(deformation.offset.w), vec3(0.05), line), 1.0);
}
#endif
