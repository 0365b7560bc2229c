// The sky, drawn behind everything else as one quad at the far end of the depth range.

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
vec3 skyColour(vec3 direction);
vec3 developed(vec3 light);

in vec3 direction;
layout(location = 0) out vec4 colour;

void main() {
    vec3 d = normalize(direction);
    float disc = smoothstep(0.99985, 0.99993, dot(d, sunDirection()));
    colour = vec4(developed(skyColour(d) + disc * sunlight() * 4.0), 1.0);
}
#endif
