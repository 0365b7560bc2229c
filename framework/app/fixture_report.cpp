// SPDX-License-Identifier: BSD-3-Clause
#include "app/fixture_report.h"

#include "core/files.h"
#include "resource/xml.h"

#include <algorithm>
#include <cstdio>

namespace terrane {

namespace {

using Status = FixtureResult::Status;

std::string seconds(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
}

std::string attribute(const char* name, const std::string& value) {
    return std::string(" ") + name + "=\"" + asXml(value) + "\"";
}

// What a terminal may show and XML may not.
std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](unsigned char c) { return c < 0x20 && c != '\n' && c != '\t'; }, '?');
    return text;
}

std::size_t count(const std::vector<FixtureCase>& cases, Status status) {
    return static_cast<std::size_t>(std::count_if(
        cases.begin(), cases.end(), [&](const auto& c) { return c.result.status == status; }));
}

std::string caseOf(const FixtureCase& c) {
    const std::filesystem::path folder = shownPath(c.folder);
    std::string text = "  <testcase" + attribute("classname", folder.parent_path().string()) +
                       attribute("name", folder.filename().string()) +
                       attribute("time", seconds(c.seconds));
    const std::string report = asXml(printable(c.result.report));
    const std::string first = report.substr(0, report.find('\n'));
    if (c.result.status == Status::failed)
        return text + ">\n    <failure message=\"" + first + "\">" + report +
               "</failure>\n  </testcase>\n";
    if (c.result.status == Status::skipped)
        return text + ">\n    <skipped message=\"" + first + "\"/>\n  </testcase>\n";
    if (report.empty()) return text + "/>\n";
    return text + ">\n    <system-out>" + report + "</system-out>\n  </testcase>\n";
}

} // namespace

std::string junitReport(const std::vector<FixtureCase>& cases) {
    double total = 0;
    std::string body;
    for (const FixtureCase& c : cases) {
        total += c.seconds;
        body += caseOf(c);
    }
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"terrane\"" +
           attribute("tests", std::to_string(cases.size())) +
           attribute("failures", std::to_string(count(cases, Status::failed))) +
           attribute("skipped", std::to_string(count(cases, Status::skipped))) +
           attribute("time", seconds(total)) + ">\n" + body + "</testsuite>\n";
}

} // namespace terrane
