// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/terrain/noise_image.h"

#include "plugins/terrain/noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace terrane {

namespace {

// Seeds of the terrain reference 2.9.
constexpr std::uint32_t kCentreSeed = 1234567;

// Bits of an edge code, in the order in which the edges are filled.
enum Edge { bottom, right, top, left };

std::uint32_t edgeSeed(int code, Edge edge) {
    return (code >> edge & 1) != 0 ? 5647381 : 7654321;
}

// One layer being filled. Writing a pair gives two texels the same next random value: a texel and
// the one that lies opposite with regard to the middle of the edge.
template <class T, class Draw>
class Layer {
public:
    Layer(NoiseImage<T>& image, int layer, Draw draw)
        : image_(image)
        , layer_(layer)
        , draw_(draw) {}

    void single(NoiseRandom& random, int h, int v) { pair(random, h, v, h, v); }
    void pair(NoiseRandom& random, int h, int v, int h2, int v2) {
        for (int c = 0; c < image_.channels; ++c) {
            const T value = draw_(random);
            image_.values[image_.index(h, v, layer_, c)] = value;
            image_.values[image_.index(h2, v2, layer_, c)] = value;
        }
    }

private:
    NoiseImage<T>& image_;
    int layer_;
    Draw draw_;
};

// The tile edge runs through the texels 2 and w-3, so these are mirrored along the edge, and the
// two rows on either side are mirrored through its middle.
template <class L>
void fillElevationLayer(L& layer, int w, int code, NoiseRandom& centre) {
    const int first = 5;
    const int last = w - 6;
    const int middle = w / 2;

    NoiseRandom random(edgeSeed(code, bottom));
    for (int h = first; h <= middle; ++h)
        layer.pair(random, h, 2, w - 1 - h, 2);
    for (int v : {3, 4})
        for (int h = first; h <= last; ++h)
            layer.pair(random, h, v, w - 1 - h, 4 - v);

    random = NoiseRandom(edgeSeed(code, right));
    for (int v = first; v <= middle; ++v)
        layer.pair(random, w - 3, v, w - 3, w - 1 - v);
    for (int h : {w - 4, w - 5})
        for (int v = first; v <= last; ++v)
            layer.pair(random, h, v, 2 * w - 6 - h, w - 1 - v);

    random = NoiseRandom(edgeSeed(code, top));
    for (int h = first; h <= middle; ++h)
        layer.pair(random, h, w - 3, w - 1 - h, w - 3);
    for (int v : {w - 2, w - 1})
        for (int h = first; h <= last; ++h)
            layer.pair(random, h, v, w - 1 - h, 2 * w - 6 - v);

    random = NoiseRandom(edgeSeed(code, left));
    for (int v = first; v <= middle; ++v)
        layer.pair(random, 2, v, 2, w - 1 - v);
    for (int h : {1, 0})
        for (int v = first; v <= last; ++v)
            layer.pair(random, h, v, 4 - h, w - 1 - v);

    for (int v = first; v <= last; ++v)
        for (int h = first; h <= last; ++h)
            layer.single(centre, h, v);
}

// The tile edge runs between the texels 1 and 2, and w-3 and w-2.
template <class L>
void fillOrthoLayer(L& layer, int w, int code, NoiseRandom& centre) {
    const int first = 4;
    const int last = w - 5;

    NoiseRandom random(edgeSeed(code, bottom));
    for (int v : {2, 3})
        for (int h = first; h <= last; ++h)
            layer.pair(random, h, v, w - 1 - h, 3 - v);

    random = NoiseRandom(edgeSeed(code, right));
    for (int h : {w - 3, w - 4})
        for (int v = first; v <= last; ++v)
            layer.pair(random, h, v, 2 * w - 5 - h, w - 1 - v);

    random = NoiseRandom(edgeSeed(code, top));
    for (int v : {w - 2, w - 1})
        for (int h = first; h <= last; ++h)
            layer.pair(random, h, v, w - 1 - h, 2 * w - 5 - v);

    random = NoiseRandom(edgeSeed(code, left));
    for (int h : {1, 0})
        for (int v = first; v <= last; ++v)
            layer.pair(random, h, v, 3 - h, w - 1 - v);

    for (int v = first; v <= last; ++v)
        for (int h = first; h <= last; ++h)
            layer.single(centre, h, v);
}

template <class T>
NoiseImage<T> blankImage(int width, int channels, T value) {
    NoiseImage<T> image{width, channels, {}};
    image.values.assign(image.index(0, 0, kNoiseLayers), value);
    return image;
}

} // namespace

NoiseImage<float> makeElevationNoise(int width) {
    assert(width >= 5 && width % 2 == 1 && "makeElevationNoise: width must be odd, at least 5");
    NoiseImage<float> image = blankImage(width, 1, 0.0f);
    NoiseRandom centre(kCentreSeed);
    for (int i = 0; i < kNoiseLayers; ++i) {
        Layer layer(image, i, [](NoiseRandom& random) { return 2 * random.nextReal() - 1; });
        fillElevationLayer(layer, width, kNoiseLayerCodes[i], centre);
    }
    return image;
}

NoiseImage<std::uint8_t> makeOrthoNoise(int width) {
    assert(width >= 4 && "makeOrthoNoise: width must be at least 4");
    NoiseImage<std::uint8_t> image = blankImage(width, 4, std::uint8_t{128});
    NoiseRandom centre(kCentreSeed);
    for (int i = 0; i < kNoiseLayers; ++i) {
        Layer layer(image, i, [](NoiseRandom& random) {
            return static_cast<std::uint8_t>(random.nextReal() * 255);
        });
        fillOrthoLayer(layer, width, kNoiseLayerCodes[i], centre);
    }
    return image;
}

} // namespace terrane
