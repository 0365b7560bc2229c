// The sky, drawn behind everything else as one quad at the far end of the depth range.

uniform mat4 screenToCamera;
uniform mat4 cameraToWorld;

#ifdef _VERTEX_
layout(location = 0) in vec4 vertex;
out vec3 direction;

void main() {
    vec4 p = screenToCamera * vec4(vertex.xy, 1.0, 1.0);
    direction = mat3(cameraToWorld) * (p.xyz * sign(p.w));
    gl_Position = vec4(vertex.xy, 0.9999999, 1.0);
}
#endif

#ifdef _FRAGMENT_
// From air.glsl.
vec3 sunDirection();
void throughAir(vec3 eye, vec3 way, int steps, out vec3 light, out vec3 left);
vec3 developed(vec3 light);

in vec3 direction;
layout(location = 0) out vec4 colour;

// A star in some of the cells that a direction falls into.
float stars(vec3 d) {
    vec3 p = d * 160.0;
    vec3 cell = floor(p);
    vec3 q = fract(cell * vec3(0.1031, 0.1030, 0.0973));
    q += dot(q, q.yxz + 33.33);
    vec3 random = fract((q.xxy + q.yxx) * q.zyx);
    float brightness = smoothstep(0.975, 1.0, random.x);
    vec3 offset = fract(p) - 0.3 - 0.4 * random.yzx;
    return brightness * exp(-60.0 * dot(offset, offset));
}

void main() {
    vec3 d = normalize(direction);
    vec3 light, left;
    throughAir(cameraToWorld[3].xyz, d * 1e8, 10, light, left);
    float disc = smoothstep(0.99994, 0.99997, dot(d, sunDirection()));
    // A bright sky outshines the stars.
    float dark = exp(-30.0 * max(light.r, max(light.g, light.b)));
    colour = vec4(developed(light + left * (disc * 60.0 + 0.5 * dark * stars(d))), 1.0);
}
#endif
