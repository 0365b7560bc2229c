// The relief of the mountains. The built-in upsampling does the rest: it asks for the heights of the
// root tile, which holds whole ranges, and for how much noise the finer levels add to a place: little
// in valleys, much on slopes and ridges.

#include "upsample.glsl"

#ifdef _FRAGMENT_

// Ridged gradient noise, damped where it is steep already, as erosion leaves it.

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

float rootElevation(vec2 place) {
    vec2 p = place + 4600.0 * vec2(gradientNoise(place / 29000.0 + 7.3).x,
                                     gradientNoise(place / 29000.0 - 3.1).x);
    mat2 turn = mat2(0.8, 0.6, -0.6, 0.8);
    vec2 q = p / 15500.0, slope = vec2(0.0);
    float height = 0.0, amplitude = 1.0, above = 1.0;
    for (int i = 0; i < 4; ++i) {
        vec3 n = gradientNoise(q);
        float ridge = max(1.0 - 2.1 * abs(n.x), 0.0);
        ridge *= ridge;
        slope += 0.35 * n.yz;
        // Side ridges start high on the main ones.
        height += amplitude * above * ridge / (1.0 + dot(slope, slope));
        above = clamp(1.6 * ridge, 0.12, 1.0);
        amplitude *= 0.56;
        q = turn * q * 2.03 + 5.2;
    }
    float massif = smoothstep(-0.55, 0.35, gradientNoise(p / 47000.0 + 1.7).x);
    // Hills that end in the plain around, which the sky shader paints.
    vec2 inside = 50000.0 - abs(place);
    float whole = smoothstep(500.0, 8000.0, min(inside.x, inside.y));
    return 120.0 + 3300.0 * height * mix(0.3, 1.0, massif) * whole;
}

float noiseFactor(mat3 z, float metres) {
    vec2 slope = vec2(z[1][2] - z[1][0], z[2][1] - z[0][1]) / (2.0 * metres);
    float crest = (4.0 * z[1][1] - z[0][1] - z[2][1] - z[1][0] - z[1][2]) / (4.0 * metres);
    float steep = smoothstep(0.06, 0.75, length(slope));
    return clamp(0.12 + 1.1 * steep + 1.2 * crest, 0.08, 1.5);
}

#endif
