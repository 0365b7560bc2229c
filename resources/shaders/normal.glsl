// One tile of normals from the elevations of the same quad, and with four channels what its
// parent shows there. x and y in the tangent frame at the quad's centre. (terrain reference 2.6)

uniform vec3 tileSDF; // width of tiles in texels, texels per mesh cell, format: 0 = two signed
                      // normals, 1 = two unsigned, 2 = one signed, 3 = one unsigned

uniform sampler2DArray elevationSampler;
uniform vec4 elevationOSL; // the quad: lower left corner, texel size, layer

uniform sampler2DArray normalSampler;
uniform vec4 normalOSL; // the parent's normals; negative if not wanted

uniform mat4 patchCorners;         // spheres: the quad's corners relative to their mean
uniform mat4 patchVerticals;       // spheres: upward unit vectors at the corners
uniform vec4 patchCornerNorms;     // spheres: distance of the flat quad's corners to the centre
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

// Where a texel is on a sphere, relative to some point below or above the quad. The corners' unit
// vectors v, interpolated with weights a to u, are shorter than 1 by 1-k, where
// k^2 = |u|^2 = 1 - sum a_i a_j |v_i - v_j|^2: so computed, the curvature of the smallest quad is
// there even in floats. Of heights only differences to h0 count, for the same reason.
vec3 onSphere(vec2 uv, float h, float h0) {
    float R = deform.w;
    vec4 uvUV = vec4(uv, vec2(1.0) - uv);
    vec4 alpha = uvUV.zxzx * uvUV.wwyy;
    vec4 a = alpha * patchCornerNorms / dot(alpha, patchCornerNorms);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            vec3 edge = (patchCorners[i] - patchCorners[j]).xyz / R;
            sum += a[i] * a[j] * dot(edge, edge);
        }
    }
    float k = sqrt(1.0 - sum);
    float oneMinusK = sum / (1.0 + k);
    float height = (h - h0 + (R + h0) * oneMinusK) / k;
    return (1.0 + h0 / R) * (patchCorners * a).xyz + height * (patchVerticals * a).xyz;
}

// Texels beyond the edge of a face are those of the next face of the cube, where rows and columns go
// on around the edge: the place (R+s, y) stands for (R, y, R-s). This is where to find that on the
// plane of the face, so that both faces see the same ground, and light shows no seam.
vec2 aroundCube(vec2 uv) {
    float R = deform.w, size = deform.z;
    vec2 low = vec2(lessThan(deform.xy + R, vec2(0.25 * size))) * max(-uv, 0.0);
    vec2 high = vec2(greaterThan(deform.xy + 1.25 * size, vec2(R))) * max(uv - 1.0, 0.0);
    vec2 s = (low + high) * size / R;
    vec2 along = (deform.xy + uv * size) / R;
    if (s.x > 0.0) uv += s.x / (1.0 - s.x) * vec2(along.x > 0.0 ? s.x : -s.x, along.y) * R / size;
    if (s.y > 0.0) uv += s.y / (1.0 - s.y) * vec2(along.x, along.y > 0.0 ? s.y : -s.y) * R / size;
    return uv;
}

vec3 position(ivec2 texel, float h0) {
    float h = elevation(texel);
    vec2 uv = vec2(texel) / (tileSDF.x - 1.0);
    return deform.w == 0.0 ? vec3(uv * deform.z, h - h0) : onSphere(aroundCube(uv), h, h0);
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
    float h0 = elevation(texel);
    vec3 east = position(texel + ivec2(1, 0), h0) - position(texel - ivec2(1, 0), h0);
    vec3 north = position(texel + ivec2(0, 1), h0) - position(texel - ivec2(0, 1), h0);
    vec3 normal = normalize(worldToTangentFrame * cross(east, north));
    vec2 coarse = normalOSL.x < 0.0 ? normal.xy : coarseNormal(texel);
    data = vec4(normal.xy, tileSDF.z < 2.0 ? coarse : vec2(0.0));
    if (tileSDF.z == 1.0 || tileSDF.z == 3.0) data = 0.5 * data + 0.5;
}

#endif
