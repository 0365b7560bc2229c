// Applies what the layers of an elevation producer drew over the elevations (zf, zc, zm, w): w = 0
// keeps zm, w >= 1 restores the raw elevation zf, in between they are mixed.
// (terrain reference 2.5)

uniform sampler2D coarseLevelSampler;

#ifdef _VERTEX_

layout(location = 0) in vec4 vertex;

void main() {
    gl_Position = vertex;
}

#endif

#ifdef _FRAGMENT_

layout(location = 0) out vec4 data;

void main() {
    data = texelFetch(coarseLevelSampler, ivec2(gl_FragCoord.xy), 0);
    data.z = mix(data.z, data.x, min(data.w, 1.0));
}

#endif
