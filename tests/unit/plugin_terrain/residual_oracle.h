// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace terrane::test {

/// Reads a residual file and rebuilds its elevations in double precision, as a judge of the
/// producers: shares no code with them, decodes tiles with zlib alone (terrain reference 4.1).
class ResidualOracle {
public:
    struct Raw {
        int width = 0;
        std::vector<std::int16_t> values; ///< row by row from the bottom
    };

    explicit ResidualOracle(std::string bytes);

    int minLevel() const { return integer(0); }
    int maxLevel() const { return integer(4); }
    int tileSize() const { return integer(8); }
    int size(int level) const; ///< of the tiles of a level, without borders
    int side(int level) const; ///< tiles along the edge of a level

    Raw tile(int level, int tx, int ty) const;

    /// A tile of the file with everything above it added up, metres.
    const std::vector<double>& elevations(int level, int tx, int ty);
    /// The same of a quad when the root quad shows level `delta` of the file.
    std::vector<double> quad(int delta, int level, int tx, int ty);

private:
    int integer(std::size_t offset) const;

    std::string bytes_;
    std::map<std::array<int, 3>, std::vector<double>> elevations_;
};

/// The bytes of a file in the folder TERRANE_TEST_DATA; empty, with a message, when it is missing.
std::string testData(const std::string& name);

} // namespace terrane::test
