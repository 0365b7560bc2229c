// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "archive_folder.h"
#include "core/files.h"

#include <cstdlib>
#include <string>
#include <sys/wait.h>

namespace terrane::test {

/// The terrane program, run as people do, with a folder for archives.
class TerraneProgram : public ArchiveFolder {
public:
    struct Result {
        int status = -1;
        std::string out, err;
    };

    /// @param words a shell's command line; %  stands for this folder
    Result run(std::string words, const std::string& input = {}) {
        for (std::size_t at; (at = words.find('%')) != std::string::npos;)
            words.replace(at, 1, path().string());
        write("input", input);
        const std::string command = std::string(TERRANE_PROGRAM) + " " + words + " < " +
                                    (*this / "input").string() + " > " + (*this / "out").string() +
                                    " 2> " + (*this / "err").string();
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(*this / "out").value_or(""),
                readFile(*this / "err").value_or("")};
    }
};

} // namespace terrane::test
