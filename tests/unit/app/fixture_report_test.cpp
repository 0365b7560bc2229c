// SPDX-License-Identifier: BSD-3-Clause
#include "app/fixture_report.h"

#include <doctest/doctest.h>

using namespace terrane;

TEST_CASE("results are written as build servers read them") {
    using Status = FixtureResult::Status;
    CHECK(junitReport({{"tests/a/good", {Status::passed, ""}, 0.5},
                       {"tests/a/\"odd\"", {Status::failed, "script:1: <frames>\n\x1b[1m\n"}, 1},
                       {"tests/b", {Status::skipped, "needs dem.dat\n"}, 0}}) ==
          R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="terrane" tests="3" failures="1" skipped="1" time="1.500">
  <testcase classname="tests/a" name="good" time="0.500"/>
  <testcase classname="tests/a" name="&quot;odd&quot;" time="1.000">
    <failure message="script:1: &lt;frames&gt;">script:1: &lt;frames&gt;
?[1m
</failure>
  </testcase>
  <testcase classname="tests" name="b" time="0.000">
    <skipped message="needs dem.dat"/>
  </testcase>
</testsuite>
)");
}
