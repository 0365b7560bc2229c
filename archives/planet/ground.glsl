// Land and sea: heights and normals of the tiles, coloured by height, slope and climate. The sea is
// no surface of its own: where the ground is below 0, heights to display are 0, and the shader
// paints water. So there are no two surfaces that could fight for a pixel.

#include "deformation.glsl"
#include "textureTile.glsl"

uniform samplerTile elevationSampler; // heights: of this level, of the level before, to display
uniform samplerTile normalSampler;    // normals (x, y): of this level, of the level before

uniform mat4 screenToCamera;
uniform mat4 cameraToWorld;
uniform mat4 faceToWorld;

#ifdef _VERTEX_
// From air.glsl.
void throughAir(vec3 eye, vec3 way, int steps, out vec3 light, out vec3 left);

layout(location = 0) in vec3 vertex; // of the skirted grid: xy in [0,1] over the quad, z = 1
out vec2 uv;
out vec3 way;    // from the camera, metres along the axes of the world
out float blend; // 0: this level, 1: the level before
out vec3 airLight, airLeft;

void main() {
    uv = clamp(vertex.xy, 0.0, 1.0);
    vec3 zfc = textureTile(elevationSampler, uv).xyz;
    blend = deformationBlend(uv);
    float part = tilePart(elevationSampler);
    float z = part < 1.0 ? zfc.z : mix(zfc.z, zfc.y, blend);
    // The skirt hides gaps between quads: those that rounding leaves, and those between the levels
    // of two faces that meet at an edge which the camera is above neither side of.
    float skirt = (vertex.z - 1.0) * deformation.offset.z / part;
    gl_Position = deformSphere(vertex.xy, z + skirt);

    vec3 p = vec3(gl_Position.x * screenToCamera[0][0], gl_Position.y * screenToCamera[1][1],
                  -gl_Position.w);
    way = mat3(cameraToWorld) * p;
    int steps = int(clamp(log2(length(way) / 1000.0), 1.0, 6.0));
    throughAir(cameraToWorld[3].xyz, way, steps, airLight, airLeft);
}
#endif

#ifdef _FRAGMENT_
// From air.glsl.
vec3 sunDirection();
vec3 sunlightAt(float height, float cosine);
vec3 skylightAt(float cosine);
vec3 developed(vec3 light);

in vec2 uv;
in vec3 way;
in float blend;
in vec3 airLight, airLeft;
layout(location = 0) out vec4 colour;

float hash(ivec3 cell) {
    uvec3 v = uvec3(cell) * uvec3(0x8da6b343u, 0xd8163841u, 0xcb1ab31fu);
    uint h = v.x ^ v.y ^ v.z;
    h = (h ^ h >> 15u) * 0x2c1b3c6du;
    h = (h ^ h >> 12u) * 0x297a2d39u;
    return float((h ^ h >> 15u) >> 8u) / 16777216.0;
}

// Smooth noise in [0,1].
float noise(vec3 p) {
    ivec3 i = ivec3(floor(p));
    vec3 f = p - floor(p);
    f = f * f * (3.0 - 2.0 * f);
    ivec2 x = ivec2(0, 1);
    vec4 z = mix(vec4(hash(i), hash(i + x.yxx), hash(i + x.xyx), hash(i + x.yyx)),
                 vec4(hash(i + x.xxy), hash(i + x.yxy), hash(i + x.xyy), hash(i + x.yyy)), f.z);
    vec2 y = mix(z.xy, z.zw, f.y);
    return mix(y.x, y.y, f.x);
}

// Random, at a corner of the 2^level by 2^level cells of a face. Faces that meet share the corners
// on their common edge, as points of the cube.
float corner(ivec2 cell, int level) {
    int edge = 1 << level;
    ivec3 onFace = ivec3(2 * cell - edge, edge);
    mat4 m = faceToWorld; // turns by right angles
    ivec3 onCube = ivec3(round(m[0].xyz)) * onFace.x + ivec3(round(m[1].xyz)) * onFace.y +
                   ivec3(round(m[2].xyz)) * onFace.z;
    return hash(onCube);
}

// Noise in [0,1] on a grid of 2^level cells a face, and how it changes in a cell along x and y.
// Counted in integers, since metres on a planet leave no digits for stones; where they are too many,
// they start again.
vec3 grain(int level) {
    int depth = level - int(deformation.offset.w);
    ivec2 tile = ivec2(round((deformation.offset.xy + deformation.radius) / deformation.offset.z));
    vec2 p = uv * exp2(float(depth));
    ivec2 first = tile << max(depth, 0);
    if (depth < 0) {
        first = tile >> -depth;
        p += vec2(tile - (first << -depth)) * exp2(float(depth));
    }
    ivec2 i = first + ivec2(floor(p));
    vec2 t = fract(p), f = t * t * (3.0 - 2.0 * t), df = 6.0 * t * (1.0 - t);
    ivec2 x = ivec2(0, 1);
    vec2 low = vec2(corner(i, level), corner(i + x.yx, level));
    vec2 high = vec2(corner(i + x.xy, level), corner(i + x.yy, level));
    vec2 row = mix(low, high, f.y);
    return vec3(mix(row.x, row.y, f.x), (row.y - row.x) * df.x,
                dot(high - low, vec2(1.0 - f.x, f.x)) * df.y);
}

// How much ground a pixel shows, metres: the edge of a square of that area.
float pixelSize() { return sqrt(length(cross(dFdx(way), dFdy(way)))); }

// What of a pattern pixels can show: 1 of patches that are larger, 0 of smaller ones.
float shown(float size) { return clamp(1.5 - 2.4 * pixelSize() / size, 0.0, 1.0); }

// Tussocks and stones of several sizes: how bright they are, in about [-0.5,0.5], and their slopes
// along x and y.
vec3 stones() {
    vec3 sum = vec3(0.0);
    for (int level = 18; level < 33; level += 2) {
        float cell = 2.0 * deformation.radius / exp2(float(level));
        float part = shown(cell);
        if (part <= 0.0) continue;
        float relief = 0.05 * float(level - 16); // the tiles have that of larger things
        sum += part * vec3(0.5, relief, relief) * (grain(level) - vec3(0.5, 0.0, 0.0));
    }
    return sum;
}

struct Place {
    vec3 up;        // on the unit sphere
    float height;   // metres
    float slope;    // cosine of the steepness
    float patchy;   // random, in [-0.5,0.5]
    float cold;     // 0 at the equator's beaches, 1 where snow stays
    float dry;
};

Place placeAt(vec3 up, float height, float slope) {
    Place p = Place(up, height, slope, 0.0, 0.0, 0.0);
    float wide = noise(up * 14.0) - 0.5;
    p.patchy = 0.45 * (noise(up * 90.0) - 0.5) + 0.35 * (noise(up * 700.0) - 0.5) * shown(9000.0) +
               0.3 * (noise(up * 9000.0) - 0.5) * shown(700.0);
    float latitude = abs(up.z);
    p.cold = 1.12 * pow(latitude, 2.2) + max(height, 0.0) / 5200.0 + 0.10 * wide + 0.10 * p.patchy;
    // Deserts lie along the tropics.
    float tropic = (latitude - 0.38) / 0.17;
    p.dry = exp(-tropic * tropic) + 0.9 * wide + 0.3 * p.patchy;
    return p;
}

vec3 land(Place p, float stones) {
    vec3 desert = mix(vec3(0.31, 0.205, 0.10), vec3(0.22, 0.12, 0.058), 0.5 + p.patchy);
    vec3 steppe = mix(vec3(0.165, 0.145, 0.062), vec3(0.115, 0.115, 0.045), 0.5 + p.patchy);
    vec3 forest = mix(vec3(0.018, 0.043, 0.012), vec3(0.042, 0.068, 0.020), 0.5 + p.patchy);
    vec3 tundra = vec3(0.115, 0.108, 0.078);
    vec3 rock = mix(vec3(0.125, 0.112, 0.102), vec3(0.200, 0.183, 0.168), 0.5 + p.patchy);
    vec3 c = mix(forest, steppe, smoothstep(0.15, 0.45, p.dry));
    c = mix(c, desert, smoothstep(0.45, 0.75, p.dry));
    c = mix(c, tundra, smoothstep(0.52, 0.72, p.cold));
    c = mix(c, vec3(0.30, 0.26, 0.18), 1.0 - smoothstep(2.0, 12.0, p.height + 8.0 * p.patchy)); // beach
    c = mix(c, rock, 1.0 - smoothstep(0.74, 0.90, p.slope + 0.15 * p.patchy));
    c *= max(1.0 + stones, 0.0);
    float snow = smoothstep(0.76, 0.90, p.cold) * smoothstep(0.50, 0.72, p.slope + 0.1 * p.patchy);
    return mix(c, vec3(0.80, 0.84, 0.90), snow);
}

// Waves of several sizes that stand still: which way the water faces.
vec3 waves(vec3 up) {
    vec2 slope = vec2(0.0);
    for (int level = 20; level < 29; level += 2) {
        float part = shown(2.0 * deformation.radius / exp2(float(level)));
        if (part > 0.0) slope += part * grain(level).yz;
    }
    return normalize(up - 0.07 * (mat2x3(deformation.tangentFrameToWorld) * slope));
}

// What water reflects of the light above it: the sun's path, wide as the waves are steep, and sky.
vec3 sea(Place p, vec3 toEye, vec3 sunlight, vec3 skylight, float depth) {
    vec3 deep = vec3(0.006, 0.022, 0.050), shallow = vec3(0.030, 0.105, 0.110);
    vec3 body = mix(deep, shallow, exp(-depth / 45.0));
    vec3 wave = waves(p.up);
    float facing = max(dot(wave, toEye), 0.0);
    float fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0) * 0.7;
    vec3 halfway = normalize(toEye + sunDirection());
    float tilt = dot(wave, halfway);
    float glitter = 0.9 * exp((1.0 - 1.0 / max(tilt * tilt, 1e-3)) / 0.025);
    vec3 c = body * (sunlight * max(dot(wave, sunDirection()), 0.0) / 3.14 + skylight);
    return c + fresnel * (skylight * 0.9) + 0.06 * glitter * sunlight;
}

void main() {
    vec4 n = textureTile(normalSampler, uv) * 2.0 - 1.0;
    vec2 slope = tilePart(normalSampler) < 1.0 ? n.xy : mix(n.xy, n.zw, blend);
    vec3 normal = vec3(slope, sqrt(max(0.0, 1.0 - dot(slope, slope))));
    normal = deformation.tangentFrameToWorld * normal;

    vec3 up = normalize(cameraToWorld[3].xyz + way);
    float height = textureTile(elevationSampler, uv).x;
    float sunHeight = dot(up, sunDirection());
    vec3 sunlight = sunlightAt(height, sunHeight);
    vec3 skylight = skylightAt(sunHeight);
    Place place = placeAt(up, height, dot(up, normal));

    vec3 light;
    if (height < 0.0) {
        light = sea(place, -normalize(way), sunlight, skylight, -height);
        float ice = smoothstep(0.86, 0.97, place.cold);
        vec3 white = vec3(0.70, 0.76, 0.82) * (sunlight * max(sunHeight, 0.0) / 3.14 + skylight);
        light = mix(light, white, ice);
    } else {
        vec3 stones = stones();
        vec3 rough = normalize(normal - mat2x3(deformation.tangentFrameToWorld) * stones.yz);
        float lit = max(dot(rough, sunDirection()), 0.0);
        light = land(place, stones.x) * (sunlight * lit / 3.14 + skylight * (0.6 + 0.4 * place.slope));
    }
    colour = vec4(developed(light * airLeft + airLight), 1.0);
}
#endif
