// SPDX-License-Identifier: BSD-3-Clause
#include "virtual_display.h"

#include <csignal>
#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>

namespace terrane::test {

namespace {

/// The header of an X window dump is made of big-endian words (XWDFile.h).
std::size_t word(const std::string& dump, std::size_t index) {
    std::size_t value = 0;
    for (std::size_t i = 4 * index; i < 4 * index + 4; ++i)
        value = value << 8 | static_cast<unsigned char>(dump.at(i));
    return value;
}

} // namespace

VirtualDisplay::VirtualDisplay() {
    int ends[2];
    if (pipe(ends) != 0) return;
    server_ = fork();
    if (server_ == 0) {
        const std::string end = std::to_string(ends[1]);
        close(ends[0]);
        execlp("Xvfb", "Xvfb", "-displayfd", end.c_str(), "-screen", "0", "640x480x24", "-fbdir",
               folder_.path().c_str(), "-nolisten", "tcp", "-noreset", nullptr);
        _exit(127);
    }
    close(ends[1]);
    // The server writes its number when it is ready; its end tells that there is none.
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';)
        number += c;
    close(ends[0]);
    if (!number.empty()) environment_.emplace("DISPLAY", ":" + number);
}

VirtualDisplay::~VirtualDisplay() {
    if (server_ < 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

Image VirtualDisplay::screen(int width, int height) const {
    const std::string dump = readFile(folder_ / "Xvfb_screen0").value_or("");
    const std::size_t bytesPerLine = word(dump, 12), colours = word(dump, 19);
    const std::size_t first = word(dump, 0) + 12 * colours;
    Image image = makeImage(width, height, 3);
    for (int y = 0; y < height; ++y) {
        const char* from = dump.data() + first + std::size_t(y) * bytesPerLine;
        REQUIRE(std::size_t(from - dump.data()) + 4 * std::size_t(width) <= dump.size());
        auto* to = image.bytes.data() + std::size_t(height - 1 - y) * std::size_t(width) * 3;
        for (int x = 0; x < width; ++x, from += 4) { // blue, green, red, nothing
            for (const int channel : {2, 1, 0})
                *to++ = static_cast<std::remove_reference_t<decltype(*to)>>(from[channel]);
        }
    }
    return image;
}

bool VirtualDisplay::act(const std::string& words) {
    return std::system(("xdotool " + words + " > /dev/null 2>&1").c_str()) == 0;
}

} // namespace terrane::test
