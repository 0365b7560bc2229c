// The light, which ground and sky share, so that they fade into one another. A module of functions:
// other modules of the same program declare those they call.

#ifdef _FRAGMENT_

uniform vec3 sun;   // direction to the sun
uniform float haze; // share of light that one metre of air at height 0 scatters away

vec3 sunDirection() { return normalize(sun); }
vec3 sunlight() { return vec3(1.0, 0.92, 0.80) * 2.6; }

// Light from the sky on a surface: from above more than from the side.
vec3 skylight(vec3 normal) { return vec3(0.26, 0.34, 0.50) * (0.65 + 0.35 * normal.z); }

// The plain around the mountains: what of the light it reflects.
vec3 plain() { return vec3(0.085, 0.098, 0.034); }

// Colour of the air in a direction, from the horizon up.
vec3 skyColour(vec3 direction) {
    float up = max(direction.z, 0.0);
    vec3 zenith = vec3(0.11, 0.25, 0.56);
    vec3 horizon = vec3(0.60, 0.70, 0.84);
    vec3 colour = mix(horizon, zenith, 1.0 - exp(-4.2 * up));
    float towards = max(dot(direction, sunDirection()), 0.0);
    colour += vec3(1.0, 0.72, 0.42) * (0.28 * pow(towards, 6.0) + 0.5 * pow(towards, 90.0));
    return colour;
}

// What is left of a colour at a distance, and the air's own light in front of it. The air thins
// with height: half of the haze lies below 2.2 km.
vec3 throughAir(vec3 colour, vec3 eye, vec3 point) {
    vec3 way = point - eye;
    float distance = length(way);
    const float thin = 1.0 / 3200.0;
    float density = exp(-max(eye.z, 0.0) * thin);
    float slope = way.z * thin;
    float mean = abs(slope) < 1e-3 ? 1.0 : (1.0 - exp(-slope)) / slope;
    // Blue light is scattered first.
    vec3 depth = haze * distance * density * mean * vec3(0.8, 1.0, 1.3);
    vec3 air = skyColour(normalize(vec3(way.xy, max(way.z, 0.0))));
    return mix(air, colour, exp(-depth));
}

// From light to what a screen shows.
vec3 developed(vec3 light) {
    vec3 x = light * 0.95;
    x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return pow(clamp(x, 0.0, 1.0), vec3(1.0 / 2.2));
}

#endif
