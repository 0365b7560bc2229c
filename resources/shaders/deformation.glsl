// How the vertices of a quad's mesh get to the screen. drawTerrain sets this uniform for each quad;
// fields that a shader does not use cost nothing. (terrain reference 2.1)

uniform struct {
    vec2 blending;             // s+1, s-1 with the split distance s
    mat4 localToScreen;        // deformed space to clip space
    vec4 offset;               // lower left corner of the quad, its size, its level
    vec4 camera;               // relative to the quad, in sizes of the quad; its height
    mat3 tileToTangent;        // (u,v,1) to metres in the tangent plane below the camera
    mat4 screenQuadCorners;    // columns: the quad's corners at height 0, in clip space
    mat4 screenQuadVerticals;  // columns: upward unit vectors there, in clip space
    vec4 screenQuadCornerNorms; // spheres: distance of the flat quad's corners to the centre
    mat3 tangentFrameToWorld;  // spheres: east, north, up at the quad, in world space
    float radius;              // spheres and cylinders
} deformation;

// How far a vertex has moved from the quad's own surface (0) to its parent's (1).
// @param uv in [0,1]^2 of the quad
float deformationBlend(vec2 uv) {
    vec2 d = abs(deformation.camera.xy - uv);
    float distance = max(max(d.x, d.y), deformation.camera.z);
    return clamp((distance - deformation.blending.x) / deformation.blending.y, 0.0, 1.0);
}

// Height of a vertex from an elevation tile's (zf, zc, zm).
float deformationHeight(vec2 uv, vec3 elevation) {
    return mix(elevation.z, elevation.y, deformationBlend(uv));
}

// Clip coordinates of a vertex of a flat terrain.
vec4 deformFlat(vec2 uv, float height) {
    vec2 p = uv * deformation.offset.z + deformation.offset.xy;
    return deformation.localToScreen * vec4(p, height, 1.0);
}

// Clip coordinates of a vertex of a sphere. The corners are transformed in double precision and
// interpolated here, since floats can't tell neighbouring vertices of a planet apart.
vec4 deformSphere(vec2 uv, float height) {
    vec4 uvUV = vec4(uv, vec2(1.0) - uv);
    vec4 alpha = uvUV.zxzx * uvUV.wwyy;
    vec4 norms = deformation.screenQuadCornerNorms;
    vec4 alphaPrime = alpha * norms / dot(alpha, norms);

    // The corners' unit vectors, interpolated, are shorter than 1 by 1-k, k = |P|/(alpha.norms). As
    // a difference of two large numbers that would be off by a metre on Earth; as a sum over the
    // corners it is as exact as the quad is small.
    float R = deformation.radius;
    float l = deformation.offset.z;
    vec2 p = uv * l + deformation.offset.xy;
    float normP = length(vec3(p, R));
    float difference = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 toCorner = l * (vec2(i % 2, i / 2) - uv);
        difference += alpha[i] * dot(toCorner, 2.0 * p + toCorner) / (norms[i] + normP);
    }
    float oneMinusK = difference / dot(alpha, norms);
    float heightPrime = (height + R * oneMinusK) / (1.0 - oneMinusK);
    return (deformation.screenQuadCorners + heightPrime * deformation.screenQuadVerticals) *
           alphaPrime;
}
