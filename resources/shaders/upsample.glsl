// One tile of elevations (zf, zc, zm): upsamples the parent tile, adds residuals and noise.
// (terrain reference 2.4)
//
// zf  elevation, the sum of all levels
// zc  elevation of the parent's mesh here, for the transition between levels
// zm  elevation to show; layers may change it, and 0 is the level of the sea
//
// Options: NO_CLAMP     zm below the sea is the ground, too
//          SLOPE_NOISE  noise of positive amplitude depends on slope and curvature; that of
//                       negative amplitude stays the same everywhere
//          CUSTOM_RELIEF  another file, which includes this one, defines rootElevation and
//                       noiseFactor

uniform vec4 tileWSDF; // width of tiles in texels, metres per texel, texels per mesh cell, flip?

uniform sampler2DArray coarseLevelSampler; // elevations
uniform vec4 coarseLevelOSL;               // the parent: lower left corner, texel size, layer;
                                           // negative for the root
uniform sampler2D residualSampler;         // texel by texel
uniform vec4 residualOSH;                  // offset, scale; w: 1 if there are residuals, else 0

uniform sampler2DArray noiseSampler; // see noiseUVLH
uniform vec4 noiseUVLH; // which of (u, v, 1-u, 1-v) to take for u and for v; layer; amplitude

#ifdef _VERTEX_

layout(location = 0) in vec4 vertex;

void main() {
    gl_Position = vertex;
}

#endif

#ifdef _FRAGMENT_

layout(location = 0) out vec4 data;

// Samples of the parent are fetched, not filtered: filters have few bits, elevations need many.

vec4 parent(ivec2 texel) {
    ivec2 size = textureSize(coarseLevelSampler, 0).xy;
    ivec2 first = ivec2(coarseLevelOSL.xy / coarseLevelOSL.z + 0.5);
    ivec2 inside = clamp(first + texel, ivec2(0), size - 1);
    return texelFetch(coarseLevelSampler, ivec3(inside, int(coarseLevelOSL.w)), 0);
}

// Even texels lie on the second of four parent texels; odd ones half way between the middle two,
// on the cubic through all four: weights (-1, 9, 9, -1)/16. Written as the mean of these two and a
// small correction, since rounding errors add up from level to level.
float between(vec4 z, int texel) {
    float middle = 0.5 * (z[1] + z[2]);
    return texel % 2 == 0 ? z[1] : middle + 0.125 * (middle - 0.5 * (z[0] + z[3]));
}

// Parent elevations: rows of four. Gathering four at once takes half of the time of fetches when
// drawn in software. Between four centres nothing is near to another choice of texels.
mat4 parentBlock(ivec2 texel) {
    mat4 z;
#if __VERSION__ >= 400
    vec2 first = floor(coarseLevelOSL.xy / coarseLevelOSL.z + 0.5) + vec2(texel / 2);
    for (int j = 0; j < 4; j += 2) {
        for (int i = 0; i < 4; i += 2) {
            vec2 corner = (first + vec2(i + 1, j + 1)) * coarseLevelOSL.z;
            vec4 g = textureGather(coarseLevelSampler, vec3(corner, coarseLevelOSL.w));
            z[j][i] = g.w;
            z[j][i + 1] = g.z;
            z[j + 1][i] = g.x;
            z[j + 1][i + 1] = g.y;
        }
    }
#else
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            z[j][i] = parent(texel / 2 + ivec2(i, j)).x;
#endif
    return z;
}

// The mean of the parent texels around a texel: the same from all sides.
float around(mat4 z, ivec2 texel) {
    int i = 1 + texel.x % 2, j = 1 + texel.y % 2;
    return 0.25 * ((z[1][1] + z[j][i]) + (z[1][i] + z[j][1]));
}

float upsampled(mat4 z, ivec2 texel) {
    vec4 column;
    for (int j = 0; j < 4; ++j)
        column[j] = between(z[j], texel.x);
    return between(column, texel.y);
}

// The parent's elevations around a texel, a parent texel apart: from all sides the same.
vec3 around(vec4 z, int texel) {
    return texel % 2 == 0 ? z.xyz : 0.5 * (z.xyz + z.yzw);
}

mat3 surroundings(mat4 z, ivec2 texel) {
    mat4x3 rows;
    for (int j = 0; j < 4; ++j)
        rows[j] = around(z[j], texel.x);
    return texel.y % 2 == 0 ? mat3(rows[0], rows[1], rows[2])
                            : mat3(0.5 * (rows[0] + rows[1]), 0.5 * (rows[1] + rows[2]),
                                   0.5 * (rows[2] + rows[3]));
}

#ifdef CUSTOM_RELIEF
// What is added to the root tile at a place, metres from the centre of the terrain.
float rootElevation(vec2 place);
// What the amplitude of noise is multiplied with, given the parent's elevations around a place, rows
// from the south, and the metres between them. On a planet it must be the same for turned rows and
// columns, or there are seams where its faces meet.
float noiseFactor(mat3 z, float d);
#elif defined SLOPE_NOISE
float noiseFactor(mat3 z, float d) {
    float slopeX = (z[1][2] - z[1][0]) / (2.0 * d);
    float slopeY = (z[2][1] - z[0][1]) / (2.0 * d);
    float curvature = (z[1][2] + z[1][0] + (z[2][1] + z[0][1]) - 4.0 * z[1][1]) / d;
    float slope = length(vec2(slopeX, slopeY));
    return max(clamp(4.0 * curvature, 0.0, 1.5), clamp(2.0 * slope - 0.5, 0.1, 4.0));
}
#endif

float noise(ivec2 texel) {
    ivec4 uvs = ivec4(texel, ivec2(int(tileWSDF.x) - 1) - texel);
    ivec2 uv = ivec2(uvs[int(noiseUVLH.x)], uvs[int(noiseUVLH.y)]);
    return texelFetch(noiseSampler, ivec3(uv, int(noiseUVLH.z)), 0).x;
}

// Exact: halves are, and so much is far from the next integer. Drawn in software, integers divide
// one by one.
ivec2 floorDivide(ivec2 a, int b) {
    return ivec2(floor((vec2(a) + 0.5) / float(b)));
}

// Vertices of the parent's mesh, counted from the quad's corner.
float parentVertex(int x, int y) {
    int g = int(tileWSDF.z);
    return parent(2 + g * ivec2(x, y)).z;
}

// On the edges of the parent's triangles, whose diagonals run from north-west to south-east: the
// mean of the two vertices around the texel.
float coarseElevation(ivec2 texel) {
    int g = int(tileWSDF.z);
    ivec2 ij = texel - 2;
    ivec2 v0 = floorDivide(ij, 2 * g), v1 = floorDivide(ij + g, 2 * g);
    int x0 = v0.x, x1 = v1.x, y0 = v0.y, y1 = v1.y;
    float falling = 0.5 * (parentVertex(x1, y0) + parentVertex(x0, y1));
    // In the middle of a cell, if the mesh turns its diagonals towards the ridges.
    bool middle = ij.x - 2 * g * x0 == g && ij.y - 2 * g * y0 == g;
    if (tileWSDF.w == 0.0 || !middle) return falling;
    float rising = 0.5 * (parentVertex(x0, y0) + parentVertex(x1, y1));
    return max(falling, rising);
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    bool root = coarseLevelOSL.x < 0.0;
    float amplitude = abs(noiseUVLH.w);
    // The elevation is the sum of these. Against rounding errors, too, all that is small is added up
    // before it meets the large one.
    float base = 0.0, detail = 0.0;
    if (!root) {
        mat4 z = parentBlock(texel);
        base = around(z, texel);
        detail = upsampled(z - base, texel);
#if defined CUSTOM_RELIEF || defined SLOPE_NOISE
        if (noiseUVLH.w > 0.0) amplitude *= noiseFactor(surroundings(z, texel), 2.0 * tileWSDF.y);
#endif
    }
#ifdef CUSTOM_RELIEF
    if (root) base = rootElevation((vec2(texel) - 0.5 * (tileWSDF.x - 1.0)) * tileWSDF.y);
#endif
    if (residualOSH.w != 0.0) detail += residualOSH.w * texelFetch(residualSampler, texel, 0).x;
    if (amplitude != 0.0) detail += amplitude * noise(texel);
    float zf = base + detail;
    float zc = root ? zf : coarseElevation(texel);
#ifdef NO_CLAMP
    float zm = zf;
#else
    float zm = max(zf, 0.0);
#endif
    data = vec4(zf, zc, zm, 0.0);
}

#endif
