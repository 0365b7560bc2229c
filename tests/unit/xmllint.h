// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/files.h"
#include "temporary_folder.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace terrane::test {

/// The judge of XML schemas: the program of libxml2, which reads XML by the letter.
class Xmllint {
public:
    static bool installed() { return std::system("xmllint --version > /dev/null 2>&1") == 0; }

    struct Verdict {
        bool valid = false;
        std::set<int> lines; ///< where it finds a fault
        std::string report;
    };

    /// @param option "--schema" or "--relaxng"
    /// @return what it says of each file
    static std::map<std::string, Verdict> validate(const std::string& option,
                                                   const std::filesystem::path& schema,
                                                   const std::vector<std::string>& files) {
        const TemporaryFolder folder;
        const std::string output = (folder / "output").string();
        std::string command = "xmllint --noout " + option + " '" + schema.string() + "'";
        for (const std::string& file : files)
            command += " '" + file + "'";
        [[maybe_unused]] const int status =
            std::system((command + " > '" + output + "' 2>&1").c_str());
        std::map<std::string, Verdict> verdicts;
        std::istringstream lines(readFile(output).value_or(""));
        for (std::string line; std::getline(lines, line);)
            read(line, verdicts);
        return verdicts;
    }

private:
    // "FILE validates", or "FILE:LINE: what is wrong".
    static void read(const std::string& line, std::map<std::string, Verdict>& verdicts) {
        constexpr std::string_view good = " validates";
        if (line.ends_with(good)) {
            verdicts[line.substr(0, line.size() - good.size())].valid = true;
            return;
        }
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) return;
        const int number = std::atoi(line.c_str() + colon + 1);
        if (number <= 0) return;
        Verdict& verdict = verdicts[line.substr(0, colon)];
        verdict.lines.insert(number);
        verdict.report += line + "\n";
    }
};

} // namespace terrane::test
