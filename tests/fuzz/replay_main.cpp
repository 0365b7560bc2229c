// SPDX-License-Identifier: BSD-3-Clause
// The short form of a fuzz run, for every compiler: replays the files of a corpus folder, cut at
// many places and with bytes changed by a generator of fixed seed, so that each run does the same.
#include "core/files.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kCuts = 200;         // of a file, at most
constexpr std::size_t kMutations = 500;    // of a file, at most
constexpr std::size_t kOfAllFiles = 5'000; // of each kind: some seconds under sanitizers

void run(const std::string& bytes) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

// Bytes that mean something in one of the formats.
std::string mutated(std::string bytes, const std::vector<std::string>& corpus,
                    std::mt19937& random) {
    using namespace std::string_literals; // keeps the zero byte
    static const std::string special = "<>\"'/&;=!-[]?#.,+$ \n\r\t\0\xff"
                                       "019"s;
    const auto at = [&](const std::string& text) {
        return text.empty() ? 0 : random() % (text.size() + 1);
    };
    for (int changes = 1 + static_cast<int>(random() % 4); changes > 0; --changes) {
        const std::size_t i = at(bytes);
        switch (random() % 4) {
        case 0:
            if (i < bytes.size()) bytes[i] = special[random() % special.size()];
            break;
        case 1:
            bytes.erase(i, random() % 20);
            break;
        case 2:
            bytes.insert(i, 1, special[random() % special.size()]);
            break;
        default: {
            const std::string& other = corpus[random() % corpus.size()];
            bytes.insert(i, other.substr(at(other), random() % 40));
        }
        }
    }
    return bytes;
}

} // namespace

int main(int count, char** words) {
    std::vector<std::filesystem::path> paths;
    for (int i = 1; i < count; ++i) {
        std::error_code error;
        if (std::filesystem::is_regular_file(words[i], error)) paths.emplace_back(words[i]);
        for (const auto& entry : std::filesystem::directory_iterator(words[i], error))
            paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> corpus;
    for (const auto& path : paths) {
        if (auto bytes = terrane::readFile(path)) corpus.push_back(std::move(*bytes));
    }
    if (corpus.empty()) {
        std::fprintf(stderr, "usage: %s CORPUS...\n", words[0]);
        return 2;
    }
    const std::size_t share = 1 + kOfAllFiles / corpus.size();
    const std::size_t cuts = std::min(kCuts, share), mutations = std::min(kMutations, share);
    std::mt19937 random(1);
    for (const std::string& bytes : corpus) {
        run(bytes);
        const std::size_t step = std::max<std::size_t>(1, bytes.size() / cuts);
        for (std::size_t length = 0; length < bytes.size(); length += step)
            run(bytes.substr(0, length));
        for (std::size_t i = 0; i < mutations; ++i)
            run(mutated(bytes, corpus, random));
    }
    std::printf("%zu files of the corpus, %zu mutations each\n", corpus.size(), mutations);
    return 0;
}
