// One tile of normals from the elevations of the same quad, and with four channels what its
// parent shows there. x and y in the tangent frame at the quad's centre. (terrain reference 2.6)
// Shaders drawn in software run both sides of a condition, so that what only spheres need costs
// flat terrains, too: there is little of it, and it does without the quad's corners.

uniform vec3 tileSDF; // width of tiles in texels, texels per mesh cell, format: 0 = two signed
                      // normals, 1 = two unsigned, 2 = one signed, 3 = one unsigned

uniform sampler2DArray elevationSampler;
uniform vec4 elevationOSL; // the quad: lower left corner, texel size, layer

uniform sampler2DArray normalSampler;
uniform vec4 normalOSL; // the parent's normals; negative if not wanted

uniform mat3 worldToTangentFrame;  // spheres: rows are east, north, up
uniform mat3 parentToTangentFrame; // spheres
uniform vec4 deform;               // lower left corner, size, radius; radius 0 when flat

#ifdef _VERTEX_

layout(location = 0) in vec4 vertex;

void main() {
    gl_Position = vertex;
}

#endif

#ifdef _FRAGMENT_

layout(location = 0) out vec4 data;

float elevation(ivec2 texel) {
    ivec2 first = ivec2(elevationOSL.xy / elevationOSL.z);
    return texelFetch(elevationSampler, ivec3(first + texel, int(elevationOSL.w)), 0).z;
}

// Along a row or a column of the grid over a sphere, from a texel's neighbour on one side to that on
// the other: the difference of their points, of these heights. `at` is the texel on the cube of half
// an edge of 1, `back` and `ahead` lead to the neighbours. Of points r u with unit vectors u it is
// (u1 - u0) (r1 + r0) / 2 + (u1 + u0) (r1 - r0) / 2, and u1 - u0 comes from the way between them: so
// the normals of the smallest quads are good even in floats.
vec3 across(vec3 at, vec3 back, vec3 ahead, float h0, float h1) {
    vec3 p0 = at + back, p1 = at + ahead, way = ahead - back;
    float l0 = length(p0), l1 = length(p1);
    vec3 turn = (way - p0 * (dot(way, p0 + p1) / (l0 * (l0 + l1)))) / l1;
    vec3 up = 0.5 * (p0 / l0 + p1 / l1);
    return turn * (deform.w + 0.5 * (h0 + h1)) + up * (h1 - h0);
}

// Texels beyond the edge of a face are those of the next face of the cube, where rows and columns go
// on around the edge: both faces see the same ground, and light shows no seam.
vec3 stepTo(vec3 ahead, bool atEdge) {
    return atEdge ? vec3(0.0, 0.0, -1.0) : ahead;
}

vec3 normalOnSphere(ivec2 texel, vec4 h) {
    float R = deform.w, size = deform.z;
    int last = int(tileSDF.x) - 1;
    float s = size / (float(last) * R);
    vec3 at = vec3(deform.xy / R + vec2(texel) * s, 1.0);
    bvec2 low = lessThan(deform.xy + R, vec2(0.25 * size));
    bvec2 high = greaterThan(deform.xy + 1.25 * size, vec2(R));
    vec3 west = stepTo(vec3(-1, 0, 0), low.x && texel.x == 0);
    vec3 east = stepTo(vec3(1, 0, 0), high.x && texel.x == last);
    vec3 south = stepTo(vec3(0, -1, 0), low.y && texel.y == 0);
    vec3 north = stepTo(vec3(0, 1, 0), high.y && texel.y == last);
    return worldToTangentFrame * cross(across(at, s * west, s * east, h.x, h.y),
                                       across(at, s * south, s * north, h.z, h.w));
}

vec2 decoded(vec2 n) {
    return tileSDF.z == 1.0 ? 2.0 * n - 1.0 : n;
}

vec2 parentNormal(ivec2 texel) {
    ivec2 first = ivec2(normalOSL.xy / normalOSL.z);
    return decoded(texelFetch(normalSampler, ivec3(first + texel, int(normalOSL.w)), 0).xy);
}

// What the parent shows here, between its texels; the two are chosen as for coarse elevations. Not
// between the vertices of its mesh: its shading is finer than that, and cells would show.
vec2 coarseNormal(ivec2 texel) {
    ivec2 v0 = texel / 2, v1 = (texel + 1) / 2;
    vec2 n = 0.5 * (parentNormal(ivec2(v1.x, v0.y)) + parentNormal(ivec2(v0.x, v1.y)));
    if (deform.w == 0.0) return n;
    float z = sqrt(max(1.0 - dot(n, n), 0.0));
    return (parentToTangentFrame * vec3(n, z)).xy;
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 h = vec4(elevation(texel - ivec2(1, 0)), elevation(texel + ivec2(1, 0)),
                  elevation(texel - ivec2(0, 1)), elevation(texel + ivec2(0, 1)));
    vec3 flatNormal = vec3(h.x - h.y, h.z - h.w, 2.0 * deform.z / (tileSDF.x - 1.0));
    vec3 normal = normalize(deform.w == 0.0 ? flatNormal : normalOnSphere(texel, h));
    vec2 coarse = normalOSL.x < 0.0 ? normal.xy : coarseNormal(texel);
    data = vec4(normal.xy, tileSDF.z < 2.0 ? coarse : vec2(0.0));
    if (tileSDF.z == 1.0 || tileSDF.z == 3.0) data = 0.5 * data + 0.5;
}

#endif
