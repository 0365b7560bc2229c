// SPDX-License-Identifier: BSD-3-Clause
#include "program_fixture.h"

namespace terrane {

namespace {

struct BinaryFixture : ProgramFixture {
    const char* const text =
        "uniform vec4 u; uniform B { float b; }; layout(location = 0) out vec4 "
        "c;\nvoid main() { c = u + vec4(b); }\n";

    std::shared_ptr<Program> link(std::optional<ProgramBinary> binary) {
        ProgramSource source{.name = "p;", .modules = {compile(fragment(text))}};
        source.place = {file("p.xml", "<archive/>"), 0};
        source.binary = std::move(binary);
        return Program::link(*bindings, std::move(source), diagnostics);
    }
    void draws(Program& program) {
        program.find("u").set(glm::vec4(1, 2, 3, 4));
        program.find("b").set(10.0F);
        CHECK(draw(program) == glm::vec4(11, 12, 13, 14));
    }
};

} // namespace

TEST_CASE_FIXTURE(BinaryFixture,
                  "A program made from its binary works, and its uniforms can be set") {
    const auto linked = link(std::nullopt);
    REQUIRE(linked);
    const auto binary = linked->binary();
    if (!binary) {
        MESSAGE("skipped: the driver keeps no program binaries");
        return;
    }
    const auto loaded = link(binary);
    REQUIRE(loaded);
    CHECK(told() == "");
    draws(*loaded);
}

TEST_CASE_FIXTURE(BinaryFixture, "Modules are linked when the driver refuses the binary") {
    const auto real = link(std::nullopt)->binary();
    std::vector<ProgramBinary> damaged{{0, "x"}, {0x1234, std::string(1000, 'x')}, {0, ""}};
    if (real) {
        damaged.push_back({real->format, ""});
        damaged.push_back({real->format, "not what it was"});
        damaged.push_back({real->format, real->bytes.substr(0, real->bytes.size() / 2)});
        damaged.push_back({real->format + 1, real->bytes});
    }
    for (const ProgramBinary& binary : damaged) {
        CAPTURE(binary.format);
        CAPTURE(binary.bytes.size());
        const auto program = link(binary);
        REQUIRE(program);
        CHECK(told() == "p.xml:1:1 program-binary\n");
        draws(*program);
    }
}

} // namespace terrane
