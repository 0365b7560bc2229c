// Draws a texture, or the part of it that is chosen by `rescale`, over a rectangle of the target.
// (terrain reference 2.10)

uniform sampler2D sourceSampler;
uniform vec4 rescale; // centre and half size of the rectangle in [-1,1]^2
uniform vec3 correct; // texture coordinates are correct.xy + (0..1)*correct.z

#ifdef _VERTEX_

layout(location = 0) in vec4 vertex;
out vec2 uv;

void main() {
    uv = correct.xy + (vertex.xy * 0.5 + 0.5) * correct.z;
    gl_Position = vec4(rescale.xy + vertex.xy * rescale.zw, 0.0, 1.0);
}

#endif

#ifdef _FRAGMENT_

in vec2 uv;
layout(location = 0) out vec4 data;

void main() {
    data = texture(sourceSampler, uv);
}

#endif
