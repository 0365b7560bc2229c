// The relief of the planet. The built-in upsampling does the rest: it asks for the heights of the
// root tiles, which hold continents and mountain belts, and for how much noise the finer levels add
// to a place: much in the mountains, little in plains and under water.
//
// Six faces of a cube make the planet. For no seam to show where they meet, both sides compute the
// same heights there, from the same point of the sphere; and since noise vanishes in the corners of
// the cube, the land lies flat there, too.

#include "upsample.glsl"

#ifdef _FRAGMENT_

uniform mat3 faceToPlanet;

// Three random numbers in [-1,1] for each cell (pcg3d of Jarzynski and Olano, 2020).
vec3 gradient(ivec3 cell) {
    uvec3 v = uvec3(cell) * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return vec3(v >> 8u) / 8388608.0 - 1.0;
}

float gradientNoise(vec3 p) {
    ivec3 cell = ivec3(floor(p));
    vec3 f = fract(p);
    vec3 u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    vec4 low, high;
    for (int i = 0; i < 4; ++i) {
        ivec3 corner = ivec3(i % 2, i / 2, 0);
        low[i] = dot(gradient(cell + corner), f - vec3(corner));
        corner.z = 1;
        high[i] = dot(gradient(cell + corner), f - vec3(corner));
    }
    vec4 z = mix(low, high, u.z);
    vec2 y = mix(z.xy, z.zw, u.y);
    return mix(y.x, y.y, u.x);
}

float octaves(vec3 p, int count) {
    float sum = 0.0, amplitude = 1.0;
    for (int i = 0; i < count; ++i) {
        sum += amplitude * gradientNoise(p);
        amplitude *= 0.55;
        p = 2.03 * p + 11.7;
    }
    return sum;
}

// Metres; p on the unit sphere.
float worldElevation(vec3 p) {
    vec3 bent = p + 0.22 * vec3(octaves(2.3 * p + 3.1, 2), octaves(2.3 * p - 5.2, 2),
                                octaves(2.3 * p + 9.4, 2));
    float continent = octaves(1.35 * bent + 7.9, 5) - 0.06;
    float sea = -4360.0 + 4300.0 * smoothstep(-0.30, -0.02, continent);
    float plain = 60.0 + 900.0 * max(continent, 0.0);
    float ground = mix(sea, plain, smoothstep(-0.05, 0.03, continent));
    // Belts of mountains, where plates have met.
    float belt = 1.0 - 2.6 * abs(octaves(1.9 * bent - 4.4, 3));
    float ridges = 1.0 - 1.7 * abs(gradientNoise(9.0 * bent + 2.2));
    float mountains = smoothstep(0.25, 1.0, belt) * (0.45 + 0.55 * max(ridges, 0.0));
    return ground + 4600.0 * mountains * smoothstep(-0.10, 0.16, continent);
}

float rootElevation(vec2 place) {
    float R = 0.5 * (tileWSDF.x - 5.0) * tileWSDF.y;
    // The borders of a tile lie on the next side of the cube.
    vec2 beyond = max(abs(place) - R, 0.0);
    vec3 p = vec3(clamp(place, -R, R), R - max(beyond.x, beyond.y)) / R;
    vec3 size = abs(p);
    float least = min(min(size.x, size.y), size.z);
    float flatness = smoothstep(0.80, 0.95, least); // 1 within two texels of a corner
    float h = worldElevation(normalize(faceToPlanet * p));
    if (flatness == 0.0) return h;
    float corner = worldElevation(normalize(faceToPlanet * sign(p)));
    return mix(h, clamp(corner, -3000.0, 300.0), flatness);
}

float noiseFactor(mat3 z, float metres) {
    vec2 slope = vec2(z[1][2] - z[1][0], z[2][1] - z[0][1]) / (2.0 * metres);
    float crest = z[1][1] - 0.25 * (z[0][1] + z[2][1] + (z[1][0] + z[1][2]));
    float steep = smoothstep(0.05, 0.7, length(slope));
    float high = smoothstep(100.0, 2400.0, z[1][1]);
    // Regions are rough where they are high, hillsides where they are steep already.
    float region = 0.35 + 0.75 * high;
    float hillside = 0.10 + 0.16 * high + 0.75 * steep + clamp(1.4 * crest / metres, -0.1, 0.4);
    return mix(hillside, region, smoothstep(400.0, 5000.0, metres));
}

#endif
