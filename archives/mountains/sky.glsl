// The sky, and the plain around the mountains, drawn behind everything else as one quad at the far
// end of the depth range.

uniform mat4 screenToCamera;
uniform mat4 cameraToWorld;

#ifdef _VERTEX_
layout(location = 0) in vec4 vertex;
out vec3 direction;

void main() {
    vec4 p = screenToCamera * vec4(vertex.xy, 1.0, 1.0);
    direction = mat3(cameraToWorld) * p.xyz;
    gl_Position = vec4(vertex.xy, 0.9999999, 1.0);
}
#endif

#ifdef _FRAGMENT_
// From weather.glsl.
vec3 sunDirection();
vec3 sunlight();
vec3 skylight(vec3 normal);
vec3 plain();
vec3 skyColour(vec3 direction);
vec3 throughAir(vec3 colour, vec3 eye, vec3 point);
vec3 developed(vec3 light);

in vec3 direction;
layout(location = 0) out vec4 colour;

void main() {
    vec3 d = normalize(direction), eye = cameraToWorld[3].xyz;
    float disc = smoothstep(0.99985, 0.99993, dot(d, sunDirection()));
    vec3 light = skyColour(d) + disc * sunlight() * 4.0;
    if (d.z < 0.0) {
        const float kPlain = 120.0; // metres; where the relief ends
        vec3 point = eye + d * (max(eye.z - kPlain, 1.0) / -d.z);
        vec3 up = vec3(0.0, 0.0, 1.0);
        vec3 grass = plain() * (sunlight() * sunDirection().z + skylight(up));
        light = throughAir(grass, eye, point);
    }
    colour = vec4(developed(light), 1.0);
}
#endif
