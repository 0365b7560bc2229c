// Makes an elevation tile (zf, zc, zm) out of its parent and of noise. As the built-in
// upsampleShader, but for two things that make mountains: the root tile holds whole ranges, and the
// noise of the other levels is weak in valleys and strong on slopes and ridges.

uniform vec4 tileWSDF;                    // tile width, metres a texel, texels a mesh cell, flip
uniform sampler2DArray coarseLevelSampler; // tiles of the level before
uniform vec4 coarseLevelOSL;              // where the parent lies in its tile; x = -1: no parent
uniform sampler2DArray noiseSampler;
uniform vec4 noiseUVLH;                   // rotation, layer, amplitude (metres)

#ifdef _VERTEX_
layout(location = 0) in vec4 vertex;
out vec2 st;

void main() {
    st = (vertex.xy * 0.5 + 0.5) * tileWSDF.x;
    gl_Position = vertex;
}
#endif

#ifdef _FRAGMENT_
in vec2 st; // texel
layout(location = 0) out vec4 elevations;

// ---- Ranges: ridged gradient noise, damped where it is steep already, as erosion leaves it.

vec2 gradient(vec2 cell) {
    float a = 6.2831853 * fract(sin(dot(cell, vec2(127.1, 311.7))) * 43758.547);
    return vec2(cos(a), sin(a));
}

// Noise in about [-0.7,0.7] and its derivatives, in (value, d/dx, d/dy).
vec3 gradientNoise(vec2 p) {
    vec2 i = floor(p), f = p - i;
    vec2 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    vec2 du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    vec2 ga = gradient(i), gb = gradient(i + vec2(1, 0));
    vec2 gc = gradient(i + vec2(0, 1)), gd = gradient(i + vec2(1, 1));
    float va = dot(ga, f), vb = dot(gb, f - vec2(1, 0));
    float vc = dot(gc, f - vec2(0, 1)), vd = dot(gd, f - vec2(1, 1));
    float k = va - vb - vc + vd;
    float value = va + u.x * (vb - va) + u.y * (vc - va) + u.x * u.y * k;
    vec2 slope = ga + u.x * (gb - ga) + u.y * (gc - ga) + u.x * u.y * (ga - gb - gc + gd) +
                 du * (u.yx * k + vec2(vb, vc) - va);
    return vec3(value, slope);
}

float ranges(vec2 p) {
    vec2 bend = vec2(gradientNoise(p / 31000.0 + 7.3).x, gradientNoise(p / 31000.0 - 3.1).x);
    p += 5200.0 * bend;
    float height = 0.0, amplitude = 1.0;
    vec2 slope = vec2(0.0);
    mat2 turn = mat2(0.8, 0.6, -0.6, 0.8);
    vec2 q = p / 17000.0;
    for (int i = 0; i < 4; ++i) {
        vec3 n = gradientNoise(q);
        float ridge = 1.0 - 2.0 * abs(n.x);
        slope += n.yz * sign(n.x) * 0.5;
        height += amplitude * ridge * ridge / (1.0 + dot(slope, slope));
        amplitude *= 0.52;
        q = turn * q * 2.03;
    }
    float massif = smoothstep(-0.42, 0.48, gradientNoise(p / 44000.0 + 1.7).x);
    return -60.0 + 2700.0 * height * mix(0.16, 1.0, massif);
}

// ---- Upsampling: a texel between those of the parent is interpolated with weights (-1,9,9,-1)/16.

float parent(vec2 texel) {
    vec2 uv = (texel + 0.5) * coarseLevelOSL.z + coarseLevelOSL.xy;
    return texture(coarseLevelSampler, vec3(uv, coarseLevelOSL.w)).x;
}

vec4 weights(bool between) {
    return between ? vec4(-1.0, 9.0, 9.0, -1.0) / 16.0 : vec4(0.0, 1.0, 0.0, 0.0);
}

vec4 parentRow(vec2 p) {
    return vec4(parent(p), parent(p + vec2(1, 0)), parent(p + vec2(2, 0)), parent(p + vec2(3, 0)));
}

// How much noise a place bears: little where the parent is flat and low, much where it is steep or
// a crest.
float roughness(mat4 z, float metres) {
    vec2 slope = vec2(z[1][2] - z[1][0], z[2][1] - z[0][1]) / (4.0 * metres);
    float crest = z[1][1] - 0.25 * (z[0][1] + z[2][1] + z[1][0] + z[1][2]);
    float steep = smoothstep(0.06, 0.75, length(slope));
    return clamp(0.16 + 1.25 * steep + 0.9 * crest / metres, 0.1, 1.6);
}

// Height of the level before, on the triangles that the mesh shows it with: the mean of the two ends
// of the edge that a vertex of this level halves.
float coarse() {
    vec2 cell = floor(st - 2.0) / (2.0 * tileWSDF.z);
    vec4 uv = vec4(floor(cell + vec2(0.5, 0.0)), floor(cell + vec2(0.0, 0.5))) * tileWSDF.z + 2.5;
    uv = uv * coarseLevelOSL.z + coarseLevelOSL.xyxy;
    return 0.5 * (texture(coarseLevelSampler, vec3(uv.xy, coarseLevelOSL.w)).z +
                  texture(coarseLevelSampler, vec3(uv.zw, coarseLevelOSL.w)).z);
}

void main() {
    vec2 texel = floor(st);
    vec2 uv = (texel + 0.5) / tileWSDF.x;
    vec4 uvs = vec4(uv, 1.0 - uv);
    vec2 turned = vec2(uvs[int(noiseUVLH.x)], uvs[int(noiseUVLH.y)]);
    float noise = noiseUVLH.w * texture(noiseSampler, vec3(turned, noiseUVLH.z)).x;

    float zf, zc;
    if (coarseLevelOSL.x == -1.0) {
        vec2 half_ = vec2(0.5 * (tileWSDF.x - 5.0));
        zf = ranges((texel - 2.0 - half_) * tileWSDF.y);
        zc = zf;
    } else {
        vec2 p = floor(texel * 0.5);
        mat4 z = mat4(parentRow(p), parentRow(p + vec2(0, 1)), parentRow(p + vec2(0, 2)),
                      parentRow(p + vec2(0, 3)));
        vec2 odd = mod(texel, 2.0);
        zf = dot(z * weights(odd.y == 1.0), weights(odd.x == 1.0));
        zf += noise * roughness(z, 2.0 * tileWSDF.y);
        zc = coarse();
    }
    elevations = vec4(zf, zc, zf, 0.0);
}
#endif
