// SPDX-License-Identifier: BSD-3-Clause
#include "crack_finder.h"

namespace terrane {

namespace {

enum class Kind : unsigned char { terrain, gap, sky };

/// What each pixel is; terrain all around.
class Map {
public:
    Map(const Image& picture, const Colour& background)
        : width_(picture.width)
        , height_(picture.height)
        , kinds_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
        for (int y = height_ - 1; y >= 0; --y) {
            for (int x = 0; x < width_; ++x) {
                const unsigned char* p = picture.row(y) + 3 * x;
                if (Colour{p[0], p[1], p[2]} == background)
                    kinds_[index(x, y)] = isBelowSky(x, y) ? Kind::sky : Kind::gap;
            }
        }
    }

    Kind at(int x, int y) const { return inside(x, y) ? kinds_[index(x, y)] : Kind::terrain; }

    bool isCrack(int x, int y) const {
        constexpr std::array<std::array<int, 2>, 4> kDirections{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
        for (const auto& [dx, dy] : kDirections) {
            if (terrainNear(x, y, dx, dy) && terrainNear(x, y, -dx, -dy)) return true;
        }
        return false;
    }

private:
    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    bool isBelowSky(int x, int y) const {
        if (y == height_ - 1) return true;
        return at(x, y + 1) == Kind::sky || at(x - 1, y + 1) == Kind::sky ||
               at(x + 1, y + 1) == Kind::sky;
    }
    bool terrainNear(int x, int y, int dx, int dy) const {
        return at(x + dx, y + dy) == Kind::terrain || at(x + 2 * dx, y + 2 * dy) == Kind::terrain;
    }

    int width_, height_;
    std::vector<Kind> kinds_;
};

} // namespace

Gaps findGaps(const Image& picture, const Colour& background) {
    const Map map(picture, background);
    Gaps gaps;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const Kind kind = map.at(x, y);
            gaps.sky += kind == Kind::sky;
            if (kind != Kind::gap) continue;
            ++gaps.holes;
            if (map.isCrack(x, y)) gaps.cracks.push_back({x, y});
        }
    }
    return gaps;
}

} // namespace terrane
