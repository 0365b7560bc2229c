// Sun and air, which ground and sky share, so that they fade into one another. A module of
// functions: other modules of the same program declare those they call.

#if defined(_VERTEX_) || defined(_FRAGMENT_)

uniform vec3 sun; // direction to the sun, in the world

const float kRadius = 6360000.0;
const float kTop = 80000.0;  // metres; there is no air above
const float kScale = 8000.0; // metres; up there air is 2.718 times thinner
// What a metre of air at sea level scatters: molecules, of blue light most, and haze.
const vec3 kMolecules = vec3(5.8e-6, 13.5e-6, 33.1e-6);
const float kHaze = 3.0e-6;
const float kSunlight = 22.0;

vec3 sunDirection() { return normalize(sun); }

// How much air, in metres of that at sea level, is between a height and space, towards a zenith
// angle: Chapman's function as approximated by Schueler (GPU Pro 3, 2012).
float airAbove(float height, float cosine) {
    float X = kRadius / kScale, h = max(height, 0.0) / kScale, x = X + h;
    float c = sqrt(1.5707963 * x);
    if (cosine >= 0.0) return kScale * exp(-h) * c / (c * cosine + 1.0);
    float lowest = x * sqrt(max(1.0 - cosine * cosine, 0.0));
    float through = 2.0 * sqrt(1.5707963 * lowest) * exp(min(X - lowest, 40.0));
    return kScale * (through - exp(-h) * c / (1.0 - c * cosine));
}

// What arrives from the sun at a height, on a surface that faces it.
vec3 sunlightAt(float height, float cosine) {
    return kSunlight * exp(-(kMolecules + kHaze) * airAbove(height, cosine));
}

// What the whole sky sheds on level ground; some of it even after sunset.
vec3 skylightAt(float cosine) {
    return vec3(0.55, 0.85, 1.35) * smoothstep(-0.20, 0.45, cosine) + vec3(0.06, 0.08, 0.13);
}

// Air on the way from the eye, seen from the planet's centre, to eye + way.
// @param steps of the integration
// @param light set to what the air scatters towards the eye
// @param left set to how much of the light from the far end arrives
void throughAir(vec3 eye, vec3 way, int steps, out vec3 light, out vec3 left) {
    light = vec3(0.0);
    left = vec3(1.0);
    float distance = length(way);
    vec3 direction = way / distance;
    // The part of the way that is in air.
    float nearest = -dot(eye, direction);
    vec3 offAxis = eye + nearest * direction;
    float top = kRadius + kTop;
    float half2 = top * top - dot(offAxis, offAxis);
    if (half2 <= 0.0) return;
    float first = max(nearest - sqrt(half2), 0.0);
    float range = min(nearest + sqrt(half2), distance) - first;
    if (range <= 0.0) return;

    vec3 start = eye + first * direction;
    float rise = length(start + range * direction) - length(start);
    float bias = clamp(rise / (2.0 * kScale), -1.0, 1.0); // steps are shorter in denser air
    vec3 extinction = kMolecules + kHaze, scattered = vec3(0.0);
    float passed = 0.0;
    for (int i = 0; i < steps; ++i) {
        float t = (float(i) + 0.5) / float(steps);
        vec3 p = start + range * (t + bias * (t * t - t)) * direction;
        float r = length(p);
        float air = exp(-max(r - kRadius, 0.0) / kScale) * range *
                    (1.0 + bias * (2.0 * t - 1.0)) / float(steps);
        float fromSun = airAbove(r - kRadius, dot(p, sunDirection()) / r);
        scattered += air * exp(-extinction * (passed + 0.5 * air + fromSun));
        passed += air;
    }
    left = exp(-extinction * passed);
    // Molecules scatter forwards and backwards, haze mostly forwards (Henyey and Greenstein).
    float c = dot(direction, sunDirection());
    float molecules = 0.0597 * (1.0 + c * c);
    float haze = 0.0796 * (1.0 - 0.58) / pow(1.58 - 1.52 * c, 1.5);
    light = kSunlight * scattered * (kMolecules * molecules + kHaze * haze);
}

// From light to what a screen shows.
vec3 developed(vec3 light) {
    vec3 x = light * 0.30;
    x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return pow(clamp(x, 0.0, 1.0), vec3(1.0 / 2.2));
}

#endif
